//! The page of a result says what the run said.
use std::path::{Path, PathBuf};

use crate::support::part_files::no_part_file;
use crate::support::{Bench, edit, run, text};
use pounding_files::checksum::append;
use serde_json::Value;

fn example(name: &str) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let path: PathBuf = root.join("examples").join(name).join("case.toml");
    path.display().to_string()
}

/// Four figures of a number, as the page has them.
fn figures(x: f64) -> String {
    let decimals = (3 - x.abs().log10().floor() as i32).max(0) as usize;
    format!("{x:.decimals$}")
}

#[test]
fn three_storey_pair() {
    let folder = tempfile::tempdir().unwrap();
    let result = folder.path().join("pair.h5").display().to_string();
    let told = text(
        "run",
        &format!("{} -o {result} --json", example("three_storey_pair")),
    );
    let told: Value = serde_json::from_str(&told).unwrap();
    let said = text("report", &result);
    assert!(said.contains("2 buildings, 1 gap, 45 impacts"), "{said}");
    let page = std::fs::read_to_string(folder.path().join("pair.html")).unwrap();
    // Numbers in sentences as plain text.
    let parts = page.split("<data ").enumerate();
    let plain = parts.map(|(i, part)| match i {
        0 => part,
        _ => part.split_once('>').unwrap().1,
    });
    let html = plain.collect::<String>().replace("</data>", "");
    assert!(html.contains("closes 45 times</strong> at 3 of 3 levels"));
    let peak = |value: &Value| value["peak"].as_f64().unwrap();
    for building in told["buildings"].as_array().unwrap() {
        for storey in building["storeys"].as_array().unwrap() {
            let displacement = figures(1e3 * peak(&storey["displacement"]));
            let shear = figures(1e-3 * peak(&storey["storey_shear"]));
            let acceleration = figures(peak(&storey["acceleration_absolute"]));
            for value in [displacement, shear, acceleration] {
                assert!(html.contains(&format!("<td>{value}</td>")), "{value}");
            }
        }
    }
    let force = peak(&told["gaps"][0]["levels"][2]["peak_force"]);
    // The restitution of a level is that of the run.
    for level in told["gaps"][0]["levels"].as_array().unwrap() {
        let restitution = level["achieved_restitution"].as_f64().unwrap();
        let cell = format!("<td>{}</td>", figures(restitution));
        assert!(html.contains(&cell), "{cell}");
    }
    let hardest = format!("hits with {} kN at level 3", figures(1e-3 * force));
    assert!(html.contains(&hardest), "{hardest}");
    // The page of the same file is the same, wherever it goes.
    let other = folder.path().join("other.html");
    text("report", &format!("{result} -o {}", other.display()));
    assert_eq!(std::fs::read_to_string(other).unwrap(), page);
    no_part_file(folder.path());
}

/// Yielding storeys, links, rows, a wall, velocity jumps: every kind of result has a page.
#[test]
fn every_kind_of_result() {
    let folder = tempfile::tempdir().unwrap();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let mut seen = 0;
    for entry in std::fs::read_dir(root).unwrap() {
        let case = entry.unwrap().path().join("case.toml");
        if !case.exists() {
            continue;
        }
        let result = folder.path().join("a.h5").display().to_string();
        text("run", &format!("{} -o {result}", case.display()));
        text("report", &result);
        let html = std::fs::read_to_string(folder.path().join("a.html")).unwrap();
        assert!(html.ends_with("</html>\n"));
        let (html, _) = html.split_once("<script").unwrap();
        assert!(
            !html.contains("NaN") && !html.contains(">inf"),
            "{}",
            case.display()
        );
        seen += 1;
    }
    assert!(seen >= 8, "{seen}");
}

/// Gaps stand on the page in the order of the case, as the run prints them: 1-2 before 10-11 and
/// behind 2-3 all the same.
#[test]
fn gaps_of_a_row() {
    let bench = Bench::with("");
    let mut case = String::new();
    for i in 1..=12 {
        case.push_str(&format!(
            "[[building]]\nname = \"{i}\"\nstoreys = 1\nmass = \"{} t\"\nstiffness = \"20 MN/m\"\n\
             height = \"3 m\"\ndamping = {{ stiffness_proportional = 0.05 }}\n",
            20 + i
        ));
    }
    for i in 1..12 {
        case.push_str(&format!(
            "[[gap]]\nbetween = [\"{i}\", \"{}\"]\nwidth = \"20 mm\"\n\
             model = \"anagnostopoulos_2004\"\nstiffness = \"90 MN/m\"\nrestitution = 0.65\n",
            i + 1
        ));
    }
    case.push_str(
        "[ground_motion]\nfile = \"MOTIONS/el_centro_1940_ns.csv\"\n[analysis]\nduration = \"1 s\"\n",
    );
    bench.write("case.toml", &case);
    let told = bench.json("run case.toml -o row.h5");
    bench.text("report row.h5");
    let page = bench.read("row.html");
    let gaps = told["gaps"].as_array().unwrap().iter();
    let places = gaps.map(|gap| {
        let heading = format!(">Gap {}</h2>", gap["name"].as_str().unwrap());
        page.find(&heading).unwrap()
    });
    let places: Vec<usize> = places.collect();
    assert!(places.len() == 11 && places.is_sorted(), "{places:?}");
}

/// The page of a sweep over these variables of an example, under a name of its own.
fn page_of_sweep(folder: &Path, name: &str, of: &str, variables: &str) -> String {
    let study = folder.join(format!("{name}.toml"));
    std::fs::write(&study, format!("case = {:?}\n\n{variables}", example(of))).unwrap();
    let page = folder.join(format!("{name}.html"));
    let result = folder.join(format!("{name}.h5"));
    let [study, result, output] = [study, result, page.clone()].map(|p| p.display().to_string());
    text("sweep", &format!("{study} -o {result} --report {output}"));
    std::fs::read_to_string(page).unwrap()
}

/// The page of a sweep says what rigid impacts do not have, and only theirs.
#[test]
fn sweeps_of_rigid_impacts() {
    let folder = tempfile::tempdir().unwrap();
    let variable = "[[variable]]\npath = \"gap.0.width\"\nvalues = [\"20 mm\", \"300 mm\"]\n";
    for (name, rigid) in [("rigid_impacts", true), ("three_storey_pair", false)] {
        let html = page_of_sweep(folder.path(), name, name, variable);
        assert_eq!(
            html.contains("They have no contact force."),
            rigid,
            "{name}"
        );
    }
}

/// Rigid impacts have no force: zero of a level that nothing hits is not that of a run, alone or beside a model that
/// has one. A curve of one point is a dot, and one is said as one.
#[test]
fn sweeps_of_what_has_no_force() {
    let folder = tempfile::tempdir().unwrap();
    let page_of = |name: &str, variables: &str| {
        page_of_sweep(folder.path(), name, "three_storey_pair", variables)
    };
    // At 95 mm the roof alone is hit.
    let widths = "[[variable]]\npath = \"gap.0.width\"\nvalues = [\"90 mm\", \"95 mm\"]\n";
    let rigid = "{ model = \"stereomechanical\", restitution = 0.6 }";
    let compliant =
        "{ model = \"jankowski_2005\", stiffness = \"2.75e9 N/m^1.5\", restitution = 0.65 }";
    let model = |values: &str| {
        format!(
            "{widths}[[variable]]\npath = \"gap.0.model\"\nname = \"model\"\nvalues = [{values}]\n"
        )
    };
    let alone = page_of("alone", &model(rigid));
    assert!(alone.contains("They have no contact force."));
    assert!(!alone.contains("contact force is at most"), "{alone}");
    let mixed = page_of("mixed", &model(&format!("{compliant}, {rigid}")));
    assert!(mixed.contains("; rigid impacts have none."));
    let force = |html: &str| {
        let panel = html
            .split_once("maximum contact force, maximum of a run")
            .unwrap()
            .1;
        let panel = panel.split("maximum displacement").next().unwrap();
        panel.matches("<polyline").count()
    };
    let both = page_of("compliant", &model(compliant));
    // Of one run at each width, with the force of the compliant one alone, all shares are that one.
    assert_eq!(force(&mixed), force(&both));
    let one = page_of(
        "one",
        "[[variable]]\npath = \"gap.0.width\"\nvalues = [\"100 mm\"]\n",
    );
    assert!(one.contains(">1 value<"), "{one}");
}

/// A figure is as wide as asked for, its text as large as at any width.
#[test]
fn figures_have_the_width_of_a_column() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).display().to_string();
    let case = example("three_storey_pair");
    for (name, option, width, points) in [
        ("page.svg", "", "190mm", 538.58),
        ("column.svg", "--figure-width 90mm", "90mm", 255.12),
    ] {
        text(
            "run",
            &format!("{case} --no-output --plot {} {option}", at(name)),
        );
        let svg = std::fs::read_to_string(at(name)).unwrap();
        let head = format!("width=\"{width}\" viewBox=\"0 0 {points:.2} ");
        assert!(
            svg.contains(&head) && svg.contains("font-size=\"8.5\""),
            "{name}"
        );
        // Nothing starts or ends outside.
        let places = svg
            .split("x=\"")
            .skip(1)
            .filter_map(|t| t.split('"').next());
        for x in places.filter_map(|x| x.parse::<f64>().ok()) {
            assert!((0.0..=points).contains(&x), "{name}: {x}");
        }
    }
    for wrong in ["9m", "90kN", "0", "wide"] {
        let output = run("run", &format!("{case} --no-output --figure-width={wrong}"));
        assert_eq!(output.status.code(), Some(2), "{wrong}");
    }
}

#[test]
fn refusals() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).display().to_string();
    let refused = |arguments: &str, code: i32, word: &str| {
        let output = run("report", arguments);
        let errors = String::from_utf8_lossy(&output.stderr).replace("\n  │ ", "");
        assert_eq!(output.status.code(), Some(code), "{errors}");
        assert!(errors.contains(word), "{errors}");
    };
    refused(&at("absent.h5"), 2, "cannot be read");
    std::fs::write(at("text.h5"), "no HDF5").unwrap();
    refused(&at("text.h5"), 2, "not HDF5");
    // Half of a result.
    let result = at("pair.h5");
    text(
        "run",
        &format!("{} -o {result}", example("three_storey_pair")),
    );
    let bytes = std::fs::read(&result).unwrap();
    std::fs::write(at("half.h5"), &bytes[..bytes.len() / 2]).unwrap();
    refused(&at("half.h5"), 2, "half.h5");
    assert!(!Path::new(&at("half.html")).exists());
    refused(&format!("{result} -o {result}"), 2, "take the place");
    let same = folder
        .path()
        .join(".")
        .join("pair.h5")
        .display()
        .to_string();
    refused(&format!("{result} -o {same}"), 2, "take the place");
    refused(
        &format!("{result} -o {}", at("absent/page.html")),
        4,
        "page.html",
    );
    assert_eq!(std::fs::read(&result).unwrap(), bytes);
}

/// Files that HDF5 can read, but whose parts do not belong together.
#[test]
fn parts_that_do_not_fit() {
    let folder = tempfile::tempdir().unwrap();
    let whole = folder.path().join("pair.h5");
    let case = example("three_storey_pair");
    text("run", &format!("{case} -o {}", whole.display()));
    let path = folder.path().join("a.h5");
    let refused = |change: &dyn Fn(&hdf5::File), word: &str| {
        std::fs::copy(&whole, &path).unwrap();
        edit(&path, change);
        // HDF5 has cut the checksum off.
        append(&path).unwrap();
        let output = run("report", &path.display().to_string());
        let errors = String::from_utf8_lossy(&output.stderr).replace("\n  │ ", " ");
        assert_eq!(output.status.code(), Some(2), "{errors}");
        assert!(errors.contains(word), "{errors}");
    };
    let levels = |f: &hdf5::File| {
        let gap = f.group("gap/light-heavy").unwrap();
        gap.unlink("width").unwrap();
        gap.new_dataset::<f64>().shape(0).create("width").unwrap();
    };
    refused(&levels, "do not have the same storeys or levels");
    let storeys = |f: &hdf5::File| {
        let peaks = f.group("building/light/peak").unwrap();
        peaks.unlink("displacement").unwrap();
        let two = peaks.new_dataset::<f64>().shape(2);
        let two = two.create("displacement").unwrap();
        two.write_raw(&[0.0; 2]).unwrap();
    };
    refused(&storeys, "do not have the same storeys or levels");
    let huge = |f: &hdf5::File| {
        f.unlink("time").unwrap();
        let time = f.new_dataset::<f64>().chunk(1024).shape(1_usize << 40);
        time.create("time").unwrap();
    };
    refused(&huge, "values are not in the file");
    refused(&|f| f.unlink("energy/viscous").unwrap(), "viscous");
    refused(&|f| f.delete_attr("title").unwrap(), "title");
}
