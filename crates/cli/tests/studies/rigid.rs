//! Rigid impacts in studies: jumps of the velocity, during which there is no acceleration.

use super::Bench;

const JUMPS: &str = "rigid impacts are jumps of the velocity, which floor accelerations leave out";

/// Two records and a limit on an acceleration, at gaps of velocity jumps.
fn bench(limit: &str) -> Bench {
    let bench = Bench::new(&format!(
        "case = \"case.toml\"\n[[variable]]\nrecords = [\"MOTIONS/el_centro_1940_ns.csv\", \"MOTIONS/kobe_1995_jma_ns.csv\"]\n[[variable]]\nintensity = \"peak_ground_acceleration\"\nvalues = [\"0.02 g\", \"0.5 g\", \"1 g\"]\n[ida]\n{limit}"
    ));
    let case = std::fs::read_to_string(bench.path("case.toml")).unwrap();
    let compliant = "model = \"jankowski_2005\"\nstiffness = \"2.75e9 N/m^1.5\"\n";
    assert!(case.contains(compliant));
    let rigid = case.replace(compliant, "model = \"stereomechanical\"\n");
    std::fs::write(bench.path("case.toml"), rigid).unwrap();
    bench
}

#[test]
fn an_analysis_leaves_out_accelerations_of_rigid_impacts() {
    let bench = bench("");
    let text = bench.text("ida study.toml -o out.h5 --report page.html");
    assert!(text.contains(JUMPS), "{text}");
    let said = "which accelerations leave out: without peak_acceleration_absolute: light, peak_acceleration_absolute: heavy";
    assert!(text.contains(said), "{text}");
    assert!(
        text.contains("no contact force: without peak_force: light-heavy"),
        "{text}"
    );
    let page = String::from_utf8(bench.bytes("page.html")).unwrap();
    assert!(page.contains(said), "{page}");
    let told: serde_json::Value =
        serde_json::from_str(&bench.text("ida study.toml -o out.h5 --resume --json")).unwrap();
    assert_eq!(told["remarks"].as_array().unwrap().len(), 2);
    let demands = told["levels"][0]["demands"].as_array().unwrap();
    let named = |name: &str| demands.iter().any(|d| d["name"] == name);
    assert!(named("peak_drift_ratio: light") && !named("peak_acceleration_absolute: light"));
}

#[test]
fn a_limit_on_accelerations_of_rigid_impacts_is_refused() {
    let bench = bench(
        "[[ida.limit]]\nname = \"strong\"\ndemand = \"acceleration_absolute\"\nexceeds = \"2 g\"\n",
    );
    let said = bench.complaint("ida study.toml -o out.h5", 3);
    assert!(
        said.contains("strong: rigid impacts are jumps of the velocity"),
        "{said}"
    );
    assert!(said.contains("drift_ratio"), "{said}");
}

/// What no run can have is refused before the first of them, with its place.
#[test]
fn a_limit_on_forces_of_rigid_impacts_is_refused_before_runs() {
    let bench = bench(
        "[[ida.limit]]\nname = \"hard\"\ndemand = \"contact_force\"\nlevel = 2\nexceeds = 1e6\n",
    );
    let said = bench.complaint("ida study.toml -o out.h5", 2);
    for part in [
        "rigid impacts have no contact force",
        "demand = \"impulse\"",
        "study.toml:10:10",
    ] {
        assert!(said.contains(part), "{said}");
    }
}

/// The number stays in the result, and the warning beside it; also where a variable brings the
/// model in, and not where it takes the place of one.
#[test]
fn a_sweep_warns_of_accelerations_of_rigid_impacts() {
    let bench = bench("");
    let variable = |model: &str| {
        format!(
            "case = \"case.toml\"\n[[variable]]\nname = \"m\"\npath = \"gap.0.model\"\nvalues = [{{ model = \"hertz_1882\", stiffness = 1e9 }}{model}]\n"
        )
    };
    bench.study(
        "case = \"case.toml\"\n[[variable]]\npath = \"gap.0.width\"\nvalues = [0.02, 0.03]\n",
    );
    assert!(bench.text("sweep study.toml -o a.h5").contains(JUMPS));
    bench.study(&variable(""));
    assert!(!bench.text("sweep study.toml -o b.h5").contains(JUMPS));
    bench.study(&variable(
        ", { model = \"stereomechanical\", restitution = 0.6 }",
    ));
    assert!(bench.text("sweep study.toml -o c.h5").contains(JUMPS));
}
