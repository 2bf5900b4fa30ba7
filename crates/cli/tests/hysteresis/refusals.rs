//! `pounding hysteresis` with bad input: refused with the reason, a remedy and the exit code.

use crate::support;
use std::path::Path;

/// Exit code 2, nothing on standard output, and these words.
fn refused(arguments: &str, wanted: &[&str]) {
    fails(arguments, 2, wanted);
}

fn fails(arguments: &str, code: i32, wanted: &[&str]) {
    let output = support::run("hysteresis", arguments);
    let message = String::from_utf8_lossy(&output.stderr).replace(['│', '\n'], " ");
    let message = message.split_whitespace().collect::<Vec<_>>().join(" ");
    assert_eq!(output.status.code(), Some(code), "{arguments}: {message}");
    assert!(output.stdout.is_empty());
    for part in wanted {
        assert!(message.contains(part), "\"{part}\" is not in: {message}");
    }
}

#[test]
fn parameters_outside_their_range_are_refused_with_the_reason() {
    refused(
        "iwan_six_parameter --set phi_1=1mm --set phi_2=0.5mm --cycles 1mm",
        &["phi_1 = 0.001 m to phi_2 = 0.0005 m", "below phi_2"],
    );
    refused(
        "iwan_six_parameter --set phi_1=0.1mm --cycles 1mm",
        &[
            "from phi_1 = 0.0001 m to phi_2 = 0.0001 m",
            "from the example of the descriptor are",
        ],
    );
    for exponent in ["-1", "-1.5"] {
        refused(
            &format!("iwan_six_parameter --set exponent={exponent} --set density=1 --cycles 1mm"),
            &[
                &format!("exponent = {exponent} is outside (-1, inf)"),
                "above -1",
            ],
        );
    }
    for law in [
        "bilinear",
        "elastic_perfectly_plastic",
        "takeda",
        "bouc_wen",
    ] {
        refused(
            &format!("{law} --set yield_force=0"),
            &["yield_force = 0 is outside (0, inf)", "Force at which"],
        );
    }
    // A fall as steep as the elastic rise.
    refused(
        "bilinear --set hardening_ratio=-1 --cycles 1mm",
        &[
            "hardening_ratio = -1 is outside (-1, 1)",
            "no stable answer",
        ],
    );
    refused(
        "takeda --set hardening_ratio=-0.1 --cycles 1mm",
        &["hardening_ratio = -0.1 is outside [0, 1)", "zero force"],
    );
}

#[test]
fn texts_and_units_are_checked() {
    refused(
        "bilinear --set yield_force=3MN/m --cycles 1mm",
        &["`yield_force` of law bilinear must be a force (N), but \"3MN/m\" is a stiffness"],
    );
    refused(
        "iwan_six_parameter --set density=2e6N/m^1.5 --cycles 1mm",
        &["must be a contact stiffness (N/m^1.7)", "(N/m^1.5)"],
    );
    refused(
        "viscous_damper --set damping=3e5N*s^0.5/m^0.5 --cycles 1mm",
        &["`damping` of law viscous_damper must be a dashpot coefficient (N s/m)"],
    );
    refused(
        "iwan_six_parameter --set exponent=-0.5 --cycles 1mm",
        &["needs density", "the example's belongs to another exponent"],
    );
    refused(
        "bilinear --set yield_force --cycles 1mm",
        &["not KEY=VALUE"],
    );
    refused(
        "bilinear --set yield=3kN --cycles 1mm",
        &[
            "no parameter \"yield\"",
            "stiffness, yield_force, hardening_ratio",
        ],
    );
    refused(
        "bilinear --set yield_force=1kN --set yield_force=2kN --cycles 1mm",
        &["yield_force is given twice"],
    );
    refused(
        "billinear",
        &[
            "unknown hysteresis law \"billinear\"",
            "did you mean \"bilinear\"?",
        ],
    );
}

#[test]
fn motions_that_make_no_sense_are_refused() {
    refused(
        "bilinear --set yield_force=1kN",
        &["nothing moves", "--cycles"],
    );
    refused("bilinear --cycles 0mm", &["--cycles", "greater than zero"]);
    refused(
        "bilinear --cycles 5kN",
        &["must be a length (m)", "a force (N)"],
    );
    refused("bilinear --dissipation 1mm", &["wants two amplitudes"]);
    refused("bilinear --dissipation 2mm,1mm", &["wants two amplitudes"]);
    refused(
        "bilinear --cycles 1mm --period 0s",
        &["--period", "greater than zero"],
    );
    // A viscous damper in one step of half a cycle does not move: no force.
    for steps in ["0", "1", "19"] {
        refused(
            &format!("bilinear --cycles 1mm --steps {steps}"),
            &["--steps"],
        );
    }
    refused("--cycles 1mm", &["LAW"]);
    refused(
        "bilinear --cycles 1mm --csv a.svg --svg a.svg",
        &["name the same file"],
    );
    refused("bilinear --cycles 1mm --history a.csv", &["--history"]);
}

fn file(folder: &Path, text: &str) -> String {
    let path = folder.join("input.csv");
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

#[test]
fn damaged_histories_are_refused_at_their_line() {
    let folder = tempfile::tempdir().unwrap();
    let history = |law: &str, text: &str, wanted: &[&str]| {
        let path = file(folder.path(), text);
        refused(&format!("{law} --history {path}"), wanted);
    };
    history("bilinear", "", &["empty", "deformation_mm"]);
    history(
        "bilinear",
        "0\n1\n",
        &["units of the columns are not known"],
    );
    history(
        "bilinear",
        "x\n1\n",
        &["unit of the deformation column is not known"],
    );
    history("bilinear", "x_kN\n1\n", &["\"kN\", which is a force (N)"]);
    history(
        "bilinear",
        "x_mm\n1\nbad\n",
        &["\"bad\" is not a finite number", "input.csv:3"],
    );
    history("bilinear", "x_mm\n1,2\n", &["number of columns here is 2"]);
    history(
        "bilinear",
        "a_s,b_mm,c_mm\n",
        &["number of columns here is 3"],
    );
    history("bilinear", "x_mm\n0\n0\n", &["does not move"]);
    history(
        "viscous_damper",
        "x_mm\n0\n1\n",
        &["depends on the rate", "--rate"],
    );
    history(
        "bilinear",
        "t_s,x_mm\n0,0\n0,1\n",
        &["time does not increase", "input.csv:3"],
    );
    history(
        "maxwell",
        "t_s,x_mm\n0,5\n1,1\n",
        &["begins with a deformation"],
    );
    let path = file(folder.path(), "t_s,x_mm\n0,0\n1,1\n");
    refused(
        &format!("bilinear --history {path} --rate 1mm/s"),
        &["contradicts the times"],
    );
    refused(
        &format!("bilinear --history {path} --steps 50"),
        &["the ways between the rows of the file are divided without it"],
    );
    refused(
        &format!("bilinear --history {path} --period 1s"),
        &["--period does not go"],
    );
    refused(
        "bilinear --history nowhere.csv",
        &["cannot read nowhere.csv"],
    );
}

/// What must be greater than zero has an example of it.
#[test]
fn values_of_zero_and_below_are_refused_with_a_remedy() {
    for (arguments, remedy) in [
        ("bilinear --cycles 0mm", "--cycles \"10 mm,20 mm\""),
        ("bilinear --cycles 10mm,-20mm", "--cycles \"10 mm,20 mm\""),
        (
            "bilinear --dissipation 0mm,1mm",
            "--dissipation \"0.1 mm,10 mm\"",
        ),
        ("maxwell --cycles 1mm --period 0s", "--period \"1 s\""),
        ("maxwell --cycles 1mm --rate=-1m/s", "--rate \"20 mm/s\""),
    ] {
        refused(
            arguments,
            &["greater than zero", &format!("for example {remedy}")],
        );
    }
}

#[test]
fn curves_that_cannot_be_fitted_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = file(folder.path(), "a_mm,d_J\n1,1\n2,2\n3,3\n");
    let command = format!("iwan_six_parameter --fit {path}");
    refused(&command, &["3 rows of numbers above zero for 4 unknowns"]);
    refused(
        &format!("bilinear --fit {path}"),
        &["does not know law bilinear"],
    );
    let path = file(folder.path(), "a_mm,d_J\n1,1\n2,-1\n");
    refused(
        &format!("iwan_six_parameter --fit {path}"),
        &["greater than zero", "input.csv:3"],
    );
    // Cycles that dissipate nothing are no rows of numbers above zero.
    let path = file(folder.path(), "a_mm,d_J\n1,0\n2,0\n3,1\n");
    refused(
        &format!("iwan_six_parameter --fit {path}"),
        &[
            "1 row of numbers above zero for 4 unknowns, without 2 rows of cycles that dissipate nothing",
        ],
    );
    // Below a threshold alone a cycle dissipates nothing.
    let path = file(folder.path(), "a_mm,d_J\n1,0\n2,5\n3,0\n4,9\n");
    refused(
        &format!("iwan_six_parameter --fit {path}"),
        &[
            "this cycle dissipates nothing, but one of 2 mm does",
            "input.csv:4",
        ],
    );
    let path = file(folder.path(), "a_mm,d_s\n1,1\n");
    refused(
        &format!("iwan_six_parameter --fit {path}"),
        &["dissipation column is in \"s\""],
    );
    let path = file(folder.path(), "d_mm,f_kN\n0,0\n1,1\n3,2\n2,1.5\n");
    refused(
        &format!("iwan_six_parameter --fit {path}"),
        &["deformation does not grow", "input.csv:5"],
    );
    // The curve that is asked for is not that of the file.
    refused(
        &format!("iwan_six_parameter --fit dissipation {path}"),
        &[
            "asks for a dissipation",
            "in \"kN\", as of a backbone",
            "input.csv:1",
            "--fit backbone",
        ],
    );
    let energies = file(folder.path(), "a_mm,d_J\n1,1\n2,2\n3,3\n4,4\n");
    refused(
        &format!("iwan_six_parameter --fit backbone {energies}"),
        &["asks for a backbone", "in \"J\"", "deformation_mm,force_kN"],
    );
    let seconds = file(folder.path(), "a_mm,d_s\n1,1\n");
    refused(
        &format!("iwan_six_parameter --fit backbone {seconds}"),
        &["force column is in \"s\""],
    );
    refused(
        "iwan_six_parameter --fit backbone",
        &["names no file", "--fit backbone curve.csv"],
    );
    refused(
        &format!("iwan_six_parameter --fit spine {path}"),
        &["no curve \"spine\""],
    );
    let path = file(
        folder.path(),
        "d_mm,f_kN\n1,4\n2,3\n3,2\n4,1\n5,0.5\n6,0.1\n",
    );
    refused(
        &format!("iwan_six_parameter --fit backbone {path}"),
        &["force falls with the deformation", "first loading alone"],
    );
    // One that rises and falls, at the row to which it falls most.
    let path = file(
        folder.path(),
        "deformation_mm,force_kN\n1,10\n2,40\n3,70\n4,95\n5,100\n6,80\n7,50\n8,30\n9,20\n10,11\n",
    );
    refused(
        &format!("iwan_six_parameter --fit backbone {path}"),
        &[
            "input.csv:11",
            "force falls with the deformation, from 100000 N at 5 mm to 11000 N at 10 mm",
            "misses the data by 61 % (root mean square), and up to 10 % count as noise",
            "first loading alone",
        ],
    );
    let path = file(folder.path(), "d_mm,f_kN\n1,1\n2,2\n");
    refused(
        &format!("iwan_six_parameter --fit {path}"),
        &[
            "2 rows of numbers above zero for 5 unknowns",
            "such as slider_stiffness=0",
        ],
    );
    // A start of phi_1 from which nothing can set out.
    let path = file(
        folder.path(),
        "d_mm,f_kN\n1,1\n2,2\n3,2.5\n4,2.8\n5,3\n6,3.1\n",
    );
    for set in ["phi_1=1m", "phi_1=6mm --set phi_2=5mm"] {
        refused(
            &format!("iwan_six_parameter --fit {path} --set {set}"),
            &["the sliders slip from phi_1", "below phi_2"],
        );
    }
    // A density cannot be held.
    refused(
        &format!("iwan_six_parameter --fit {path} --set density=1e6"),
        &["`density`", "is fitted", "leave density out"],
    );
}

#[test]
fn output_that_cannot_be_written_is_told_apart() {
    fails(
        "bilinear --cycles 1mm --csv /nowhere/at/all.csv",
        4,
        &["cannot write"],
    );
}

/// Laws that are integrated along their path take deformations of a size that ends; all
/// refuse what overflows, instead of a dash for a number.
#[test]
fn deformations_that_cannot_be_followed_are_refused() {
    // The descriptors' examples yield at 10 mm.
    for law in ["bouc_wen", "baber_noori_1985"] {
        refused(
            &format!("{law} --set yield_force=2e5 --set stiffness=2e7 --cycles 5000m"),
            &[
                "a path of 25000 m in all is 2.5000e6 times the yield deformation",
                "check the unit",
            ],
        );
        refused(
            &format!("{law} --set yield_force=2e5 --set stiffness=2e7 --dissipation 1m,1e6m"),
            &["times the yield deformation", "check the unit"],
        );
    }
    // A sharp knee costs more: fifty times the exponent, a fiftieth of the way.
    let sharp = "bouc_wen --set exponent=100 --set yield_force=2e5 --set stiffness=2e7";
    refused(&format!("{sharp} --cycles 100m"), &["up to 40000 times"]);
    for allowed in [
        format!("{sharp} --cycles 50m"),
        "bouc_wen --cycles 100m".to_owned(),
    ] {
        let output = support::run("hysteresis", &allowed);
        assert_eq!(output.status.code(), Some(0), "{allowed}");
    }
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("far.csv");
    std::fs::write(&file, "deformation_m\n0\n1e300\n-1e300\n").unwrap();
    refused(
        &format!("bilinear --history {}", file.display()),
        &["overflow at a deformation of", "check the unit"],
    );
    refused("bilinear --cycles 1e200m", &["overflow", "check the unit"]);
    refused("bilinear --dissipation 1e160m,1e170m", &["overflow"]);
    let far = support::run("hysteresis", "bilinear --cycles 1e6m");
    assert_eq!(far.status.code(), Some(0));
}

#[cfg(unix)]
#[test]
fn a_device_is_not_read() {
    for option in ["history", "fit"] {
        refused(
            &format!("iwan_six_parameter --{option} /dev/zero"),
            &["cannot read /dev/zero", "no regular file"],
        );
    }
}

/// A decimal comma divides a number into two, of which the second has the unit.
#[test]
fn lists_with_units_in_part_are_refused() {
    for arguments in ["--cycles 12,5mm", "--dissipation 0,1mm,10mm"] {
        refused(
            &format!("bilinear {arguments}"),
            &["has no unit beside", "write decimal points"],
        );
    }
}
