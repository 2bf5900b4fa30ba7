//! Options that need another one, or would go unheard, are refused in every company.
use std::path::Path;

use crate::support::Bench;

/// A pair of the examples, briefly under its record.
fn bench() -> Bench {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let case = std::fs::read_to_string(root.join("examples/three_storey_pair/case.toml")).unwrap();
    let case = case.replace("../../ground_motions", "MOTIONS");
    Bench::with(&case.replace("duration = \"31 s\"", "duration = \"2 s\""))
}

const STUDY: &str =
    "case = \"case.toml\"\n[[variable]]\npath = \"gap.0.width\"\nvalues = [\"10 mm\", \"20 mm\"]\n";

/// What an option needs is asked for, although a third option of the call excludes it.
#[test]
fn options_without_what_they_need_are_refused() {
    let bench = bench();
    bench.write("study.toml", STUDY);
    let record = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../ground_motions/el_centro_1940_ns.csv"
    );
    let law = "jankowski_2005 -p stiffness=2.75e9 -p restitution=0.65";
    for (arguments, needed) in [
        (
            format!("impact {law} --velocity-right 0.1 --height 5m"),
            "--drop",
        ),
        (
            format!("impact {law} --velocity-right 0.1 --gravity 9.8"),
            "--drop",
        ),
        (format!("impact {law} --table --shift 1"), "--against"),
        (format!("impact {law} --table --threshold 5%"), "--against"),
        (
            format!("motion spectrum {record} --fourier --second-file nowhere.csv"),
            "--rotated",
        ),
        (
            format!("motion spectrum {record} --damping 0.05 --smoothing 40"),
            "--fourier",
        ),
        ("gap case.toml --points 0 --pages new".to_owned(), "--list"),
        ("gap case.toml --merge all --into new".to_owned(), "--shard"),
        ("sweep study.toml --show 1 --shards 4".to_owned(), "--plan"),
        (
            "sweep study.toml --shard 1/1 --into all --time 2h".to_owned(),
            "--plan",
        ),
    ] {
        let words = ["is not given, which one option here needs", needed];
        bench.refused(&arguments, &words);
    }
    assert!(!bench.folder().join("all").exists() && !bench.folder().join("new").exists());
    // What one option takes the place of is not asked for.
    for arguments in [
        "gap --list",
        "impact --all --example",
        "hysteresis bilinear --cycles 10mm --steps 50",
        "sweep study.toml --plan --shards 2",
    ] {
        bench.text(arguments);
    }
}

/// Values that another one would decide over are refused, and so is what nothing moves.
#[test]
fn options_that_would_go_unheard_are_refused() {
    let bench = bench();
    bench.refused(
        "hysteresis bilinear --steps 30",
        &["nothing moves the element of law bilinear"],
    );
    bench.refused(
        "hysteresis bilinear --cycles 10mm --points 9",
        &["required arguments were not provided", "--dissipation"],
    );
    bench.write(
        "rows.csv",
        "deformation_mm,force_kN\n1,1\n2,2\n3,2.5\n4,3\n5,3.5\n6,4\n",
    );
    for option in ["--steps 30", "--period 2s", "--rate 10mm/s"] {
        bench.refused(
            &format!("hysteresis iwan_six_parameter --fit backbone rows.csv {option}"),
            &["nothing moves the element", "which a fit does not ask for"],
        );
    }
    bench.write("history.csv", "deformation_mm\n0\n10\n-10\n10\n");
    bench.refused(
        "hysteresis bilinear --history history.csv --steps 30",
        &["--steps does not go with --history"],
    );
    let code = "--set code=\"asce_7_2010\"";
    for (arguments, words) in [
        (
            format!("{code} --set country=\"Italy\""),
            "`code` and `country` are both given",
        ),
        (
            format!("{code} --country Italy"),
            "`code` and `country` are both given",
        ),
        (
            "--set \"code\"=\"asce_7_2010\" --code ntc_2018".to_owned(),
            "--set code and --code are both given",
        ),
        (
            "--set importance=1.5 --set \"importance\"=1".to_owned(),
            "importance",
        ),
        (
            format!("{code} --code ntc_2018"),
            "--set code and --code are both given",
        ),
        (
            "--code ntc --set date=\"2018-03-22\" --date 2021-01-01".to_owned(),
            "--set date and --date are both given",
        ),
    ] {
        bench.refused(&format!("gap case.toml --points 0 {arguments}"), &[words]);
    }
    for name in ["new.toml", "new.TOML"] {
        bench.refused(
            &format!("run case.toml -o {name}"),
            &["has the name of a file in TOML", "another ending"],
        );
        assert!(!bench.folder().join(name).exists());
    }
    bench.refused(
        "merge nowhere --check",
        &["nowhere does not exist", "name results of shards"],
    );
    let result = "run case.toml -o result.h5";
    bench.text(result);
    bench.refused(
        "check result.h5",
        &[
            "the file is in HDF5, as results are",
            "`pounding report` shows a result",
        ],
    );
}
