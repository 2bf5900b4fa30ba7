//! The page that computes, and the solver in it, against the command line.
//!
//! What the solver answers is asked for natively, and under Node from the module that pages hold:
//! `POUNDING_NODE` names the program, or it is looked for as `node`. Without it, or in a build
//! without the module, tests of the module say that they were skipped.
#![allow(clippy::print_stderr)]

use std::path::{Path, PathBuf};
use std::process::Command;

use pounding_explorer::{Answer, Explorer};
use serde_json::{Value, json};

use crate::support::{Bench, run, text};

pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Most that a page may weigh (bytes).
const MOST: u64 = 4_000_000;
const RECORD: &str = "../../ground_motions/el_centro_1940_ns.csv";

/// Whether this program has the module.
pub fn has_module() -> bool {
    let module = pounding_explorer_page::has_module();
    if let Err(reason) = &module {
        eprintln!("skipped: {reason}");
    }
    module.is_ok()
}

/// The bytes that belong to a request.
fn bytes_of(request: &Value) -> Vec<u8> {
    match (&request["$bytes"], &request["$text"]) {
        (Value::String(path), _) => std::fs::read(path).unwrap(),
        (_, Value::String(text)) => text.as_bytes().to_vec(),
        _ => Vec::new(),
    }
}

/// The answers of the solver, as it is compiled for this machine.
pub fn natively(requests: &[Value]) -> Vec<Value> {
    let mut explorer = Explorer::default();
    let answer = |request: &Value| {
        let mut plain = request.as_object().unwrap().clone();
        plain.retain(|key, _| !key.starts_with('$'));
        read(&explorer.answer(&Value::Object(plain).to_string(), &bytes_of(request)))
    };
    requests.iter().map(answer).collect()
}

/// An answer, its columns as lists.
fn read(answer: &Answer) -> Value {
    let mut object: Value = serde_json::from_str(&answer.text()).unwrap();
    let column = |name: String| {
        let numbers = answer.column(&name).unwrap();
        (name, json!(numbers))
    };
    object["columns"] = answer.column_names().into_iter().map(column).collect();
    object
}

/// The answers of the module in a page, under Node; `None` where there is none.
fn under_node(requests: &[Value]) -> Option<Vec<Value>> {
    if !has_module() {
        return None;
    }
    let node = std::env::var_os("POUNDING_NODE").unwrap_or_else(|| "node".into());
    let bench = Bench::with("");
    let case = root().join("examples/three_storey_pair/case.toml");
    let [page, list] = ["page.html", "requests.json"].map(|name| bench.folder().join(name));
    text(
        "explore",
        &format!("{} -o {}", case.display(), page.display()),
    );
    std::fs::write(&list, serde_json::to_vec(requests).unwrap()).unwrap();
    let output = Command::new(node)
        .arg(root().join("tests/javascript/ask.js"))
        .args([page, list])
        .output();
    let Ok(output) = output else {
        eprintln!("skipped: no Node, the module was not asked");
        return None;
    };
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{told}");
    Some(serde_json::from_slice(&output.stdout).unwrap())
}

/// The requests that open the README's pair, and these.
pub fn of_the_pair(requests: Vec<Value>) -> Vec<Value> {
    let file = root().join("ground_motions/el_centro_1940_ns.csv");
    let case = root().join("examples/three_storey_pair/case.toml");
    let open = [
        json!({ "do": "file", "name": RECORD, "$bytes": file }),
        json!({ "do": "open", "name": "case.toml", "$bytes": case }),
    ];
    open.into_iter().chain(requests).collect()
}

/// Asserts that two objects are the same, their numbers to the last bit: JavaScript writes `1.0`
/// as `1`, and `-0` as `0`.
fn same(one: &Value, other: &Value, place: &str) {
    match (one, other) {
        (Value::Object(a), Value::Object(b)) => {
            assert!(a.keys().eq(b.keys()), "{place}");
            for (key, value) in a {
                same(value, &b[key], &format!("{place}/{key}"));
            }
        }
        (Value::Array(a), Value::Array(b)) => {
            assert_eq!(a.len(), b.len(), "{place}");
            for (i, (a, b)) in a.iter().zip(b).enumerate() {
                same(a, b, &format!("{place}/{i}"));
            }
        }
        (Value::Number(a), Value::Number(b)) => {
            assert_eq!(a.as_f64(), b.as_f64(), "{place}");
        }
        _ => assert_eq!(one, other, "{place}"),
    }
}

/// Settings of the README's pair: gaps, masses, stiffnesses, scales, and laws of every kind.
fn settings() -> Vec<Value> {
    let entry = |path: &str, value: Value| json!([{ "path": path, "value": value }]);
    let model = |name: &str, more: Value| {
        let mut keys = vec![json!(["model", name])];
        keys.extend(more.as_array().unwrap().clone());
        json!([{ "gap": "gap.0", "keys": keys }])
    };
    vec![
        json!([]),
        entry("gap.0.width", json!("118 mm")),
        entry("gap.0.width", json!("60 mm")),
        entry("gap.0.width", json!("5 mm")),
        entry("ground_motion.scale", json!(1.5)),
        entry("building.0.mass", json!(["30 t", "25 t", "20 t"])),
        entry("building.1.stiffness", json!([1.0e9, 1.0e9, "1000 MN/m"])),
        json!([
            { "path": "gap.0.stiffness", "value": 1.0e9 },
            { "path": "gap.0.damping_ratio", "value": 0.2 },
        ]),
        // One parameter in the place of another.
        json!([
            { "absent": "gap.0.damping_ratio" },
            { "path": "gap.0.restitution", "value": 0.6 },
        ]),
        model("linear_elastic", json!([["stiffness", 9.35e7]])),
        model(
            "anagnostopoulos_2004",
            json!([["stiffness", 9.35e7], ["restitution", 0.65]]),
        ),
        model("stereomechanical", json!([["restitution", 0.65]])),
        // Powers, exponentials and logarithms.
        model(
            "muthukumar_2003",
            json!([["stiffness", 2.75e9], ["restitution", 0.65]]),
        ),
        model(
            "exact_hunt_crossley",
            json!([["stiffness", 2.75e9], ["restitution", 0.65]]),
        ),
    ]
}

/// `pounding run --json` of the case that the page would give away.
fn told(case: &Value) -> Value {
    let motions = root().join("ground_motions").display().to_string();
    let bench = Bench::with(
        &case
            .as_str()
            .unwrap()
            .replace("../../ground_motions", &motions),
    );
    bench.json("run case.toml --no-output")
}

/// The same as the command line to the last bit, natively and in the module: all numbers, those of
/// the motion too.
#[test]
fn settings_are_those_of_run() {
    let settings = settings();
    let runs = settings
        .iter()
        .map(|changes| json!({ "do": "run", "changes": changes, "frames": 50 }));
    let requests = of_the_pair(runs.collect());
    let ours = natively(&requests);
    let module = under_node(&requests);
    let mut impacts = Vec::new();
    for (number, changes) in settings.iter().enumerate() {
        let answer = &ours[number + 2];
        assert!(
            answer["faults"].is_null(),
            "{changes}: {}",
            answer["faults"]
        );
        let run = told(&answer["case"]);
        assert_eq!(answer["summary"], run, "{changes}");
        let levels = run["gaps"][0]["levels"].as_array().unwrap();
        let count: u64 = levels.iter().map(|l| l["impacts"].as_u64().unwrap()).sum();
        impacts.push(count);
        let closes = answer["columns"]["impact_t_close"].as_array().unwrap();
        assert_eq!(closes.len() as u64, count);
        if let Some(module) = &module {
            let theirs = &module[number + 2];
            same(&theirs["summary"], &run, &changes.to_string());
            same(&theirs["columns"], &answer["columns"], &changes.to_string());
            assert_eq!(module[number + 2]["case"], answer["case"]);
        }
    }
    // The README: 45 impacts at 20 mm, none at 118 mm, where the demand is 117.2 mm.
    assert_eq!(impacts[..2], [45, 0]);
    let demand = ours[3]["demand"][0][2]["peak"].as_f64().unwrap();
    assert_eq!(format!("{:.1}", 1e3 * demand), "117.2");
}

/// Cases of the examples in which matrices are multiplied (dashpots, plan, columns, soil) have the bits of the command line in the
/// module too, which knows no fused multiply-add.
#[test]
fn coupled_structures_are_those_of_run() {
    let folders = [
        "blast_beside_a_tower",
        "pair_that_turns",
        "slab_hits_column",
        "soil_pair",
    ];
    for folder in folders {
        let case = root().join(format!("examples/{folder}/case.toml"));
        let files = std::fs::read_dir(case.parent().unwrap()).unwrap();
        let own = files
            .map(|f| f.unwrap().path())
            .filter(|f| f.extension().is_some_and(|e| e == "csv"))
            .map(|f| {
                (
                    f.file_name().unwrap().to_str().unwrap().to_owned(),
                    f.clone(),
                )
            });
        let motions = root().join("ground_motions").read_dir().unwrap();
        let motions = motions.map(|f| f.unwrap().path()).map(|f| {
            let name = f.file_name().unwrap().to_str().unwrap().to_owned();
            (format!("../../ground_motions/{name}"), f)
        });
        let files = own.chain(motions);
        let mut requests: Vec<Value> = files
            .map(|(name, file)| json!({ "do": "file", "name": name, "$bytes": file }))
            .collect();
        requests.push(json!({ "do": "open", "name": "case.toml", "$bytes": case }));
        requests.push(json!({ "do": "run", "changes": [], "frames": 0 }));
        let ours = natively(&requests).pop().unwrap();
        assert!(ours["faults"].is_null(), "{folder}: {}", ours["faults"]);
        assert!(ours["summary"]["buildings"].is_array(), "{folder}");
        if let Some(mut module) = under_node(&requests) {
            same(&module.pop().unwrap()["summary"], &ours["summary"], folder);
        }
    }
}

/// Widths by demand, codes and rules are those of `pounding gap`, runs of a sweep too, and other
/// models are calibrated as by `compare`.
#[test]
fn widths_are_those_of_gap() {
    let requests = of_the_pair(vec![
        json!({ "do": "widths", "changes": [] }),
        json!({ "do": "sweep", "changes": [], "gap": 0, "widths": [0.03, 0.06] }),
        json!({ "do": "calibrate", "changes": [], "gap": 0, "model": "anagnostopoulos_2004" }),
    ]);
    let answers = natively(&requests);
    let case = root().join("examples/three_storey_pair/case.toml");
    let case = case.display();
    let gap = run(
        "gap",
        &format!("{case} --from 30mm --to 60mm --points 2 --json"),
    );
    let gap: Value = serde_json::from_slice(&gap.stdout).unwrap();
    let [ours, theirs] = [&answers[2]["gaps"][0], &gap["gaps"][0]];
    assert_eq!(ours["demand"], theirs["demand"][0]);
    let widest = |levels: &Value| -> Option<f64> {
        let levels = levels.as_array().into_iter().flatten();
        let widths = levels.filter_map(|l| l.as_f64().or(l["width"].as_f64()));
        widths.reduce(f64::max)
    };
    let provisions = theirs["provisions"].as_array().unwrap();
    let codes = ours["codes"].as_array().unwrap();
    assert_eq!(codes.len(), provisions.len());
    let mut known = 0;
    for (code, provision) in codes.iter().zip(provisions) {
        assert_eq!(code["name"], provision["name"]);
        assert_eq!(
            code["width"].as_f64(),
            widest(&provision["records"][0]["levels"]),
            "{provision}"
        );
        known += usize::from(code["width"].is_f64());
    }
    assert!(known > 15, "{known}");
    for (rule, theirs) in (ours["combinations"].as_array().unwrap().iter())
        .zip(theirs["combinations"].as_array().unwrap())
    {
        assert_eq!(rule["name"], theirs["rule"]);
        assert_eq!(rule["width"].as_f64(), widest(&theirs["width"][0]));
    }
    for (i, run) in gap["sweep"]["runs"].as_array().unwrap().iter().enumerate() {
        let columns = &answers[3]["columns"];
        let run = &run[0];
        assert_eq!(columns["impacts"][i].as_f64(), run["impacts"].as_f64());
        assert_eq!(columns["peak_force"][i], run["peak_force"]);
        assert_eq!(columns["impact_energy"][i], run["impact_energy"]);
        let light = run["amplification"][0].as_array().unwrap().iter();
        let light = light.filter_map(|s| s["displacement"].as_f64());
        assert_eq!(
            columns["displacement_0"][i].as_f64(),
            light.reduce(f64::max)
        );
    }
    let compare = text(
        "compare",
        &format!("{case} --models anagnostopoulos_2004 --json"),
    );
    let compare: Value = serde_json::from_str(&compare).unwrap();
    let parameters = &compare["models"][0]["gaps"][0]["parameters"];
    for key in &answers[4]["keys"].as_array().unwrap()[1..] {
        let theirs = parameters[key[0].as_str().unwrap()].as_f64().unwrap();
        // Five digits are written.
        assert!(
            (key[1].as_f64().unwrap() / theirs - 1.0).abs() < 5e-5,
            "{key} {parameters}"
        );
    }
}

/// The README's pair with a building on its left, as stiff as the heavy one and as near to it as is
/// said (mm).
fn row_of_three(left: f64) -> String {
    let case =
        std::fs::read_to_string(root().join("examples/three_storey_pair/case.toml")).unwrap();
    let first = "[[building]]\nname = \"first\"\nstoreys = 3\nmass = \"1000 t\"\nstiffness = \"1800 MN/m\"\nheight = \"3 m\"\ndamping = { stiffness_proportional = 0.05 }\n\n";
    let gap = format!(
        "[[gap]]\nname = \"first, light\"\nbetween = [\"first\", \"light\"]\nwidth = \"{left} mm\"\nmodel = \"stereomechanical\"\nrestitution = 0.65\n\n"
    );
    case.replacen("[[building]]", &format!("{first}[[building]]"), 1)
        .replacen("[[gap]]", &format!("{gap}[[gap]]"), 1)
        .replacen("31 s", "8 s", 1)
}

/// What a sweep says of a gap in a row is what `run` says of that gap at these widths, whatever
/// happens in the others. Velocity jumps have no force, also where a contact lasts in between.
#[test]
fn sweeps_of_a_row_are_of_their_gap() {
    let widths = [0.0, 0.03, 0.4];
    let mut requests = of_the_pair(vec![
        json!({ "do": "open", "name": "case.toml", "$text": row_of_three(20.0) }),
    ]);
    for gap in [0, 1] {
        requests.push(json!({ "do": "sweep", "changes": [], "gap": gap, "widths": widths }));
        requests.extend(widths.map(|width| {
            let change = json!({ "path": format!("gap.{gap}.width"), "value": width });
            json!({ "do": "run", "changes": [change], "frames": 0 })
        }));
    }
    let answers = natively(&requests);
    let mut counts = Vec::new();
    for (gap, of_gap) in answers[3..].chunks(4).enumerate() {
        let columns = &of_gap[0]["columns"];
        for (i, run) in of_gap[1..].iter().enumerate() {
            let levels = run["summary"]["gaps"][gap]["levels"].as_array().unwrap();
            let sum = |of: &str| -> f64 { levels.iter().filter_map(|l| l[of].as_f64()).sum() };
            let forces = levels
                .iter()
                .filter_map(|l| l["peak_force"]["peak"].as_f64());
            assert_eq!(columns["impacts"][i].as_f64(), Some(sum("impacts")));
            assert_eq!(
                columns["impact_energy"][i].as_f64(),
                Some(sum("energy_dissipated"))
            );
            let jumps = gap == 0 && sum("impacts") > 0.0;
            let force = forces.reduce(f64::max).filter(|_| !jumps);
            assert_eq!(columns["peak_force"][i].as_f64(), force, "{gap} {i}");
            counts.push(sum("impacts"));
        }
    }
    // The other gap of the row goes on as it was.
    assert!(
        counts[1] > 0.0 && counts[2] == 0.0 && counts[5] == 0.0,
        "{counts:?}"
    );
    if let Some(module) = under_node(&requests) {
        for (ours, theirs) in answers.iter().zip(&module).skip(3) {
            same(&theirs["columns"], &ours["columns"], "columns");
        }
    }
}

/// What a page of a case says to expressions of JavaScript, once it has run the case and the widths
/// of its gap; `None` where nothing opens pages.
pub fn asked_of_page(case: &str, expressions: &[&str]) -> Option<Vec<Value>> {
    let bench = Bench::with(&case.replace("../../ground_motions", "MOTIONS"));
    asked_of(&bench, expressions)
}

/// The same of the case in a folder.
pub fn asked_of(bench: &Bench, expressions: &[&str]) -> Option<Vec<Value>> {
    let named = ["POUNDING_PYTHON", "POUNDING_CHROMIUM"].map(std::env::var_os);
    let [Some(python), Some(_)] = named else {
        eprintln!(
            "skipped: POUNDING_PYTHON or POUNDING_CHROMIUM names no program, no page was opened"
        );
        return None;
    };
    if !has_module() {
        return None;
    }
    bench.text("explore case.toml -o page.html");
    let output = Command::new(python)
        .arg(root().join("tests/python/ask_page.py"))
        .arg(bench.folder().join("page.html"))
        .args(expressions)
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{told}");
    Some(serde_json::from_slice(&output.stdout).unwrap())
}

/// The text of a part of the page.
pub fn part(name: &str) -> String {
    format!("document.querySelector('[data-part={name}]').textContent")
}

/// Chooses what the curves are of, and waits until they are drawn.
fn choose(quantity: &str) -> String {
    format!(
        "(async () => {{ const {{ dataset }} = document.documentElement;\
         const select = document.querySelector('[data-part=quantity]'); select.value = '{quantity}'; select.dispatchEvent(new Event('change'));\
         while (dataset.asked !== '0') await new Promise((next) => setTimeout(next, 50));\
         await new Promise((next) => requestAnimationFrame(next)); }})()"
    )
}

/// The curve and the file of a gap in a row name it.
#[test]
fn page_names_the_gap_of_its_curve() {
    let heading = part("heading-sweep");
    let file = "(async () => { let given = null; const made = URL.createObjectURL.bind(URL); URL.createObjectURL = (blob) => { given = blob; return made(blob); };\
                document.querySelector('[data-part=sweep-csv]').click(); return (await given.text()).split('\\n'); })()";
    let choose = choose("amplification");
    let chart = part("sweep");
    let Some(told) = asked_of_page(
        &row_of_three(20.0),
        &["@print", &heading, &chart, file, &choose, &chart],
    ) else {
        return;
    };
    assert_eq!(told[0], "All widths of gap first, light");
    let chart = told[1].as_str().unwrap();
    assert!(
        chart.starts_with("impacts of gap first, light alone"),
        "{chart}"
    );
    assert!(chart.contains("width of gap first, light (mm)"), "{chart}");
    let lines = told[2].as_array().unwrap();
    let head = lines[0].as_str().unwrap();
    assert!(
        head.starts_with(
            "gap,model,width_m,building,displacement_amplification,impacts,peak_force_n,"
        ),
        "{head}"
    );
    let line = lines[1].as_str().unwrap();
    assert!(
        line.starts_with("\"first, light\",stereomechanical,"),
        "{line}"
    );
    let chart = told[4].as_str().unwrap();
    assert!(
        chart.starts_with("amplification of the displacement (-), largest of the whole row"),
        "{chart}"
    );
}

/// Of a gap whose widths differ by level the page shows the level with the least to spare, and all
/// of them, also on paper; its curves are of one width, so that the widths of the case have no line
/// among them.
#[test]
fn page_shows_the_governing_level() {
    let case =
        std::fs::read_to_string(root().join("examples/three_storey_pair/case.toml")).unwrap();
    let [equal, by_level] = ["\"20 mm\"", "[\"60 mm\", \"100 mm\", \"130 mm\"]"].map(|width| {
        case.replacen("\"20 mm\"", width, 1)
            .replacen("31 s", "12 s", 1)
    });
    let open = |text: &str| json!({ "do": "open", "name": "case.toml", "$text": text });
    let run = json!({ "do": "run", "changes": [], "frames": 0 });
    let answers = natively(&of_the_pair(vec![open(&equal), open(&by_level), run]));
    let width = |answer: &Value| answer["controls"][0].clone();
    assert_eq!(width(&answers[2])["kind"], "number");
    assert_eq!(width(&answers[3])["kind"], "fixed");
    assert_eq!(width(&answers[3])["value"], json!([0.06, 0.1, 0.13]));
    assert_eq!(answers[4]["levels"], json!([["1-1", "2-2", "3-3"]]));
    let result = |name: &str| {
        format!(
            "(({{ parentElement }}) => [...parentElement.children].slice(0, 2).map((e) => e.textContent))(document.querySelector('[data-result={name}]'))"
        )
    };
    let [demand, width] = ["demand", "width"].map(result);
    let levels = "[...document.querySelectorAll('[data-levels] tbody tr')].map((row) => row.checkVisibility() && [...row.children].map((e) => e.textContent))";
    let fixed = "(({ textContent, clientHeight }) => clientHeight > 0 && textContent)(document.querySelector('[data-fixed] .value'))";
    let [legend, remarks] = ["legend", "remarks"].map(part);
    let provided = "document.querySelectorAll('[data-part=sweep] .now').length";
    let expressions = [
        &demand, &width, "@print", levels, fixed, &remarks, &legend, provided,
    ];
    let Some(told) = asked_of_page(&by_level, &expressions) else {
        return;
    };
    assert_eq!(told[0], json!(["Gap demand at level 2-2", "91.82 mm"]));
    assert_eq!(told[1], json!(["Provided width at level 2-2", "100 mm"]));
    let rows = json!([
        ["1-1", "60", "49.46", "0"],
        ["2-2", "100", "91.82", "0"],
        ["3-3", "130", "117.2", "0"],
    ]);
    assert_eq!(told[2], rows);
    assert_eq!(told[3], "60, 100, 130 mm");
    assert!(
        told[4]
            .as_str()
            .unwrap()
            .contains("one width at all levels")
    );
    assert!(!told[5].as_str().unwrap().contains("provided"));
    assert_eq!(told[6], 0);
    let told = asked_of_page(&equal, &[&demand, &width, levels, &remarks, provided]).unwrap();
    assert_eq!(told[0], json!(["Gap demand", "117.2 mm"]));
    assert_eq!(told[1], json!(["Provided width", "20 mm"]));
    assert_eq!(
        [&told[2], &told[3], &told[4]],
        [&json!([]), &json!(""), &json!(1)]
    );
}

/// Widths that are asked for suffice as they are shown, at the last of four digits, also where that is a zero: the snap-back
/// of a demand of 61.8034 mm, and one that lies 2 micrometres below what is provided.
#[test]
fn page_rounds_demands_up_at_their_last_digit() {
    let folder = root().join("examples/snap_back");
    let case = std::fs::read_to_string(folder.join("case.toml")).unwrap();
    let case = case.replace("at_rest.csv", folder.join("at_rest.csv").to_str().unwrap());
    let digits = "JSON.stringify([20.002, 90.003, 99.003, 100.02, 999.02, 61.8034, 117.2, 0.00012344].map((x) => elements.shownAtLeast(x)))";
    let beside = "JSON.stringify([[20.002, 20.004], [20.004, 20.002], [61.8034, 80], [NaN, 20], [20, 20]].map((two) => elements.shownBeside(...two)))";
    let demand = "document.querySelector('[data-result=demand]').parentElement.textContent";
    let Some(told) = asked_of_page(&case, &[digits, beside, demand]) else {
        return;
    };
    let list = |value: &Value| serde_json::from_str::<Value>(value.as_str().unwrap()).unwrap();
    assert_eq!(
        list(&told[0]),
        json!([
            "20.01", "90.01", "99.01", "100.1", "999.1", "61.81", "117.2", "1.235e-4"
        ])
    );
    assert_eq!(
        list(&told[1]),
        json!([
            ["20.002", "20.004"],
            ["20.01", "20"],
            ["61.81", "80"],
            ["\u{2013}", "20"],
            ["20", "20"]
        ])
    );
    assert!(
        told[2].as_str().unwrap().contains("61.81 mm"),
        "{}",
        told[2]
    );
}

/// Where velocities jump the page says once that accelerations leave the jumps out, in the words of
/// the page of `run`, and shows no force of impacts: that of floors that stay in touch is none.
#[test]
fn page_of_rigid_impacts() {
    let rigid = std::fs::read_to_string(root().join("examples/three_storey_pair/case.toml"))
        .unwrap()
        .replacen("\"20 mm\"", "\"0 mm\"", 1)
        .replacen("jankowski_2005", "stereomechanical", 1)
        .replacen("stiffness = \"2.75e9 N/m^1.5\"\n", "", 1)
        .replacen("damping_ratio = 0.35", "restitution = 0.5", 1)
        .replacen("31 s", "6 s", 1);
    let open = json!({ "do": "open", "name": "case.toml", "$text": rigid });
    let run = |changes: Value| json!({ "do": "run", "changes": changes, "frames": 0 });
    let wide = json!([{ "path": "gap.0.width", "value": 1 }]);
    let answers = natively(&of_the_pair(vec![open, run(json!([])), run(wide)]));
    let said = answers[3]["jumps"][0].as_str().unwrap();
    assert_eq!(answers[4]["jumps"], json!([null]));
    let levels = answers[3]["summary"]["gaps"][0]["levels"]
        .as_array()
        .unwrap();
    let held = levels
        .iter()
        .filter_map(|l| l["peak_force"]["peak"].as_f64());
    let held = held.reduce(f64::max).unwrap();
    assert!(held > 0.0, "{levels:?}");
    let bench = Bench::with(&rigid.replace("../../ground_motions", "MOTIONS"));
    bench.text("run case.toml -o case.h5");
    bench.text("report case.h5 -o run.html");
    assert!(bench.read("run.html").contains(said), "{said}");
    let jumps = "[...document.querySelectorAll('[data-jumps]')].map((e) => e.textContent)";
    let force = "(({ parentElement }) => [...parentElement.children].slice(1).map((e) => e.textContent))(document.querySelector('[data-result=force]'))";
    let choose = choose("peak_force");
    // Heights of the curve over the axis.
    let curve = "document.querySelector('[data-part=sweep] .curve').getAttribute('d').match(/[ML][0-9.]+ [0-9.]+/g).map((place) => Number(place.split(' ')[1]))";
    let remarks = part("remarks");
    let Some(told) = asked_of_page(&rigid, &[jumps, force, &remarks, &choose, curve, &remarks])
    else {
        return;
    };
    assert_eq!(told[0], json!([said]));
    assert_eq!(told[1][0], "none: velocities jump");
    let note = told[1][1].as_str().unwrap();
    assert!(
        note.contains("held together by") && note.contains("kN at most"),
        "{note}"
    );
    assert_eq!(told[2], "");
    // Where nothing is hit there is no force, and nowhere else is a curve.
    let heights: Vec<f64> = serde_json::from_value(told[4].clone()).unwrap();
    assert!(
        heights.windows(2).all(|pair| pair[0] == pair[1]),
        "{heights:?}"
    );
    let told = told[5].as_str().unwrap();
    assert!(
        told.starts_with("With stereomechanical velocities jump"),
        "{told}"
    );
}

/// On paper masses and stiffnesses stand in a line, as they are moved, and the picture of the
/// buildings says its time and its factor.
#[test]
fn page_prints_the_values_of_the_case() {
    let case =
        std::fs::read_to_string(root().join("examples/three_storey_pair/case.toml")).unwrap();
    let case = case
        .replacen("\"25 t\"", "[\"25 t\", \"20 t\", \"15 t\"]", 1)
        .replacen("31 s", "6 s", 1);
    let shown = "[...document.querySelectorAll('[data-printed]')].map((e) => e.checkVisibility() && e.textContent)";
    let halve = "(() => { const slider = document.querySelector('[data-control=\"building.1.mass\"]'); slider.value = '250'; slider.dispatchEvent(new Event('input')); slider.dispatchEvent(new Event('change')); })()";
    let moved = "document.querySelector('[data-printed=\"building.1.mass\"]').textContent";
    let figure = "(({ innerText, clientHeight }) => clientHeight > 0 && innerText)(document.querySelector('figcaption'))";
    let choose = "(() => { document.querySelector('[data-part=play]').click(); const [bar, factor] = ['time', 'magnification'].map((name) => document.querySelector(`[data-part=${name}]`));\
                  bar.value = '2.5'; bar.dispatchEvent(new Event('input')); factor.value = '20'; factor.dispatchEvent(new Event('change')); })()";
    let expressions = [shown, choose, "@print", shown, figure, halve, moved];
    let Some(told) = asked_of_page(&case, &expressions) else {
        return;
    };
    assert_eq!(told[0], json!([false, false, false, false]));
    let values = [
        "mass (t), storeys from the bottom: 25, 20, 15",
        "stiffness (MN/m), each of 3 storeys: 3.46",
        "mass (t), each of 3 storeys: 1000",
        "stiffness (MN/m), each of 3 storeys: 2215",
    ];
    assert_eq!(told[2], json!(values));
    let figure = told[3].as_str().unwrap();
    assert!(figure.starts_with("Elevation at 2.500 s."), "{figure}");
    assert!(figure.contains("drawn 20 times as wide"), "{figure}");
    assert_eq!(told[5], "mass (t), each of 3 storeys: 500");
}

/// Where nothing moves no ratio is shown; large numbers keep their digits; and a case without gap
/// has no curves over widths.
#[test]
fn page_shows_no_digits_that_are_none() {
    let case =
        std::fs::read_to_string(root().join("examples/three_storey_pair/case.toml")).unwrap();
    let case = case.replacen("31 s", "6 s", 1);
    let (before, rest) = case.split_once("[[gap]]").unwrap();
    let (_, after) = rest.split_once("[ground_motion]").unwrap();
    let open = format!("{before}[ground_motion]{after}");
    let amplification = "document.querySelector('[data-result=amplification]').textContent";
    let ratios = "[...new Set([...document.querySelectorAll('[data-amplification]')].map((e) => e.textContent))]";
    let shear =
        "[...document.querySelectorAll('[data-part=storeys] tbody tr')][3].children[5].textContent";
    let peaks = "document.querySelector('[data-part=peaks-csv]').checkVisibility()";
    let charts = "['widths-section', 'impacts', 'sweep'].map((name) => document.querySelector(`[data-part=${name}]`).checkVisibility())";
    let expressions = [amplification, ratios, shear, charts, peaks];
    let Some(told) = asked_of_page(&open, &expressions) else {
        return;
    };
    assert_eq!(told[0], "1.00");
    // Four figures would be 20590.
    assert_eq!(told[2], "20591");
    assert_eq!(told[3], json!([false, false, false]));
    assert_eq!(told[4], true);
    let told = asked_of_page(&case, &expressions).unwrap();
    assert_eq!(told[3], json!([true, true, true]));
    let zeros: String = (0..100)
        .map(|i| format!("{},0\n", 0.02 * f64::from(i)))
        .collect();
    let still = Bench::with(&case.replace(RECORD, "still.csv"));
    still.write(
        "still.csv",
        &format!("# Unit: g\n# dt: 0.02 s\ntime_s,acceleration_g\n{zeros}"),
    );
    let told = asked_of(&still, &expressions).unwrap();
    assert_eq!([&told[0], &told[1]], [&json!("–"), &json!(["–"])]);
}

/// Four things are wrong in it: a unit, a ratio, the name of a model, and the record is missing.
const BROKEN_CASE: &str = "[[building]]\nname = \"a\"\nstoreys = 1\nmass = \"25 t\"\nstiffness = \"3 MN\"\nheight = \"3 m\"\ndamping = { ratio = 2 }\n[[gap]]\nbetween = [\"a\", \"wall\"]\nwidth = \"20 mm\"\nmodel = \"jankowsky_2005\"\n[ground_motion]\nfile = \"missing.csv\"\n";

/// A file of K-NET, made here: a sine of 2 Hz for 10 s.
fn k_net() -> String {
    let mut text = String::new();
    let values: Vec<f64> = (0..1000)
        .map(|i| 2.0e5 * (0.125_663_706 * f64::from(i)).sin())
        .collect();
    for (name, value) in [
        ("Origin Time", "2000/01/01 00:00:00"),
        ("Lat.", "40.0"),
        ("Long.", "140.0"),
        ("Depth. (km)", "10"),
        ("Mag.", "6.0"),
        ("Station Code", "XXX001"),
        ("Station Lat.", "40.1"),
        ("Station Long.", "140.1"),
        ("Station Height(m)", "5"),
        ("Record Time", "2000/01/01 00:00:20"),
        ("Sampling Freq(Hz)", "100Hz"),
        ("Duration Time(s)", "10.00"),
        ("Dir.", "N-S"),
        ("Scale Factor", "3920(gal)/6182761"),
        ("Max. Acc. (gal)", "126.804"),
        ("Last Correction", "2000/01/01 00:00:00"),
        ("Memo.", ""),
    ] {
        text.push_str(&format!("{name:<18}{value}\n"));
    }
    for row in values.chunks(8) {
        let row: Vec<String> = row.iter().map(|x| format!("{x:8.0}")).collect();
        text.push_str(&format!("{}\n", row.join(" ")));
    }
    text
}

/// A record that is dropped is run as the command line runs it; what is refused is refused with
/// the same words.
#[test]
fn files_of_the_reader() {
    let record = k_net();
    let use_it = |name: &str| json!({ "do": "run", "frames": 0, "changes": [{ "record": [["file", name]] }] });
    let broken_record = record.replace("/6182761", "/none");
    let broken_case = BROKEN_CASE;
    let requests = of_the_pair(vec![
        json!({ "do": "file", "name": "dropped.NS", "$text": record }),
        use_it("dropped.NS"),
        json!({ "do": "file", "name": "broken.NS", "$text": broken_record }),
        use_it("broken.NS"),
        json!({ "do": "open", "name": "case.toml", "$text": broken_case }),
        json!({ "do": "open", "name": "case.toml", "$text": "not a case" }),
        json!({ "do": "run", "changes": [], "frames": 0 }),
    ]);
    let answers = natively(&requests);
    if let Some(module) = under_node(&requests) {
        for (ours, theirs) in answers.iter().zip(&module) {
            assert_eq!(ours["faults"], theirs["faults"]);
        }
    }
    let bench = Bench::with("");
    bench.write("dropped.NS", &record);
    bench.write("broken.NS", &broken_record);
    bench.write("case.toml", answers[3]["case"].as_str().unwrap());
    assert_eq!(
        answers[3]["summary"],
        bench.json("run case.toml --no-output")
    );
    let refused = |answer: &Value, case: &str, at_least: usize| {
        bench.write("case.toml", case);
        let output = bench.output("run case.toml --no-output");
        assert_eq!(output.status.code(), Some(2));
        let plain = |text: &str| {
            let words: Vec<&str> = text.split_whitespace().collect();
            words.join(" ")
        };
        let told = String::from_utf8_lossy(&output.stderr).replace('│', " ");
        let told = plain(&told);
        let faults = answer["faults"].as_array().unwrap();
        assert!(faults.len() >= at_least, "{faults:?}");
        for fault in faults {
            for word in ["message", "help"] {
                let Some(word) = fault[word].as_str() else {
                    continue;
                };
                // A file is missing in other words on a disk.
                let word = plain(word).replace(
                    "this file was not given",
                    "No such file or directory (os error 2)",
                );
                assert!(told.contains(&word), "{word}\n{told}");
            }
        }
        // And nothing else was said.
        assert_eq!(faults.len(), told.matches('×').count(), "{told}");
    };
    let edited = answers[3]["case"].as_str().unwrap();
    let with_broken = edited.replace("dropped.NS", "broken.NS");
    refused(&answers[5], &with_broken, 1);
    refused(&answers[6], broken_case, 4);
    refused(&answers[7], "not a case", 1);
    // What was open stays open.
    assert_eq!(answers[8]["summary"]["gaps"][0]["levels"][2]["impacts"], 26);
}

/// A record of the Japan Meteorological Agency, made here: three components in one file.
fn jma() -> String {
    let mut text = "SITE CODE= 41000\n LAT.=  35.0000\n LON.= 135.0000\n SAMPLING RATE= 100Hz\n UNIT  = gal(cm/s/s)\n INITIAL TIME = 2000 01 01 00 00 00\nNS,EW,UD\n".to_owned();
    for i in 0..1000 {
        let [ns, ew, ud] = [1.0, 1.3, 1.7].map(|f| 80.0 * (0.125_663_706 * f * f64::from(i)).sin());
        text.push_str(&format!("{ns:.3},{ew:.3},{ud:.3}\n"));
    }
    text
}

/// Of a record with several components each can be chosen, and a case that names one says so.
#[test]
fn components_of_a_record() {
    let run = |component: Option<&str>| {
        let mut keys = vec![json!(["file", "jma.csv"])];
        keys.extend(component.map(|name| json!(["component", name])));
        json!({ "do": "run", "frames": 0, "changes": [{ "record": keys }] })
    };
    let east = json!([{ "record": [["file", "jma.csv"], ["component", "EW"]] }]);
    let requests = of_the_pair(vec![
        json!({ "do": "file", "name": "jma.csv", "$text": jma() }),
        json!({ "do": "file", "name": "dropped.NS", "$text": k_net() }),
        run(None),
        run(Some("NS")),
        run(Some("EW")),
        json!({ "do": "controls", "changes": east }),
    ]);
    let answers = natively(&requests);
    assert_eq!(answers[2]["components"], json!(["NS", "EW", "UD"]));
    assert_eq!(answers[3]["components"], json!([]));
    let refused = answers[4]["faults"][0]["message"].as_str().unwrap();
    assert!(
        refused.contains("NS") && refused.contains("EW"),
        "{refused}"
    );
    let bench = Bench::with("");
    bench.write("jma.csv", &jma());
    for answer in &answers[5..7] {
        bench.write("case.toml", answer["case"].as_str().unwrap());
        assert_eq!(answer["summary"], bench.json("run case.toml --no-output"));
    }
    assert_ne!(answers[5]["summary"], answers[6]["summary"]);
    let controls = answers[7]["controls"].as_array().unwrap();
    let component = controls.iter().find(|c| c["kind"] == "component").unwrap();
    assert_eq!(component["value"], "EW");
    if let Some(module) = under_node(&requests) {
        for (ours, theirs) in answers.iter().zip(&module) {
            same(&theirs["faults"], &ours["faults"], "faults");
            same(&theirs["components"], &ours["components"], "components");
        }
    }
}

/// Widths by rules of the reader are those of `pounding gap --rules`, and rules that cannot be
/// read are refused with the same words.
#[test]
fn rules_of_the_reader() {
    let [case, rules] =
        ["case.toml", "rules.toml"].map(|name| root().join("examples/gap_check").join(name));
    let text_of = |path: &Path| std::fs::read_to_string(path).unwrap();
    let wrong = text_of(&rules).replace("share * (u_left + u_right)", "share");
    // As deep as is allowed: the stack of a page is short.
    let deep = |sign: &str| {
        let (open, close) = (sign.repeat(31), ")".repeat(31));
        format!(
            "[[rule]]\nname = \"deep\"\nkind = \"between\"\nexpression = \"{open}u_left{close}\"\n"
        )
    };
    let take = |text: &str| json!({ "do": "rules", "name": "rules.toml", "$text": text });
    let widths = json!({ "do": "widths", "changes": [] });
    let record = "../../ground_motions/el_centro_1940_ns.csv";
    let requests = vec![
        json!({ "do": "file", "name": record, "$bytes": root().join("ground_motions/el_centro_1940_ns.csv") }),
        json!({ "do": "open", "name": "case.toml", "$bytes": case }),
        take(&text_of(&rules)),
        widths.clone(),
        take(&wrong),
        widths.clone(),
        take(&deep("(")),
        take(&deep("abs(")),
        take(""),
        widths,
    ];
    let answers = natively(&requests);
    assert_eq!(answers[2]["rules"], json!(["office_sum", "office_setback"]));
    // Exit code 1: the gap is too small by a rule.
    let check = run(
        "gap",
        &format!(
            "{} --rules {} --points 0 --json",
            case.display(),
            rules.display()
        ),
    );
    let check: Value = serde_json::from_slice(&check.stdout).unwrap();
    let own = |answer: &Value| -> Vec<(String, Value)> {
        let codes = answer["gaps"][0]["codes"].as_array().unwrap().iter();
        let own = codes.filter(|c| c["verification"].as_str().unwrap().starts_with("yours"));
        own.map(|c| (c["name"].as_str().unwrap().to_owned(), c["width"].clone()))
            .collect()
    };
    let found = own(&answers[3]);
    assert_eq!(found.len(), 2);
    for (name, width) in &found {
        let mut provisions = check["gaps"][0]["provisions"].as_array().unwrap().iter();
        let theirs = provisions.rfind(|p| p["name"] == name.as_str()).unwrap();
        let levels = theirs["records"][0]["levels"].as_array().unwrap();
        let widest = levels
            .iter()
            .filter_map(|l| l["width"].as_f64())
            .reduce(f64::max);
        assert_eq!(width.as_f64(), widest, "{name}");
        assert!(widest.is_some(), "{theirs}");
    }
    let bench = Bench::with("");
    bench.write("rules.toml", &wrong);
    let refused = bench.output(&format!(
        "gap {} --rules rules.toml --points 0",
        case.display()
    ));
    let plain = |text: &str| {
        text.replace('│', " ")
            .split_whitespace()
            .collect::<Vec<_>>()
            .join(" ")
    };
    let told = plain(&String::from_utf8_lossy(&refused.stderr));
    let message = answers[4]["faults"][0]["message"].as_str().unwrap();
    assert!(told.contains(&plain(message)), "{message}\n{told}");
    // What was taken before stays, until none are asked for.
    assert_eq!(own(&answers[5]), found);
    assert_eq!(own(&answers[9]), []);
    for answer in [&answers[6], &answers[7]] {
        assert_eq!(answer["rules"], json!(["deep"]));
    }
    if let Some(module) = under_node(&requests) {
        for (ours, theirs) in answers.iter().zip(&module).skip(2) {
            same(theirs, ours, "module");
        }
    }
}

/// What nobody meant is answered, and soon: no case makes the module ask for memory or time
/// without end.
#[test]
fn hostile_cases_are_answered() {
    let case =
        std::fs::read_to_string(root().join("examples/three_storey_pair/case.toml")).unwrap();
    let hostile = [
        case.replacen("storeys = 3", "storeys = 1000000000", 1),
        case.replacen("storeys = 3", "storeys = 4000", 1),
        case.replacen("duration = \"31 s\"", "duration = \"1e12 s\"", 1),
        case.replacen("output_step = \"0.01 s\"", "output_step = \"1e-12 s\"", 1),
        case.replacen("stiffness = \"3.46 MN/m\"", "stiffness = 1e300", 1),
        case.replacen("mass = \"25 t\"", "mass = 1e-300", 1),
        case.replacen(
            "[analysis]",
            "process = [{ resample = \"1e-12 s\" }]\n[analysis]",
            1,
        ),
        "a = ".repeat(100_000),
        "[".repeat(100_000),
        "[[building]]\n".repeat(50_000),
        "\u{0}".repeat(1000),
    ];
    let open = |text: &String| json!({ "do": "open", "name": "case.toml", "$text": text });
    let mut requests = of_the_pair(hostile.iter().map(open).collect());
    requests.push(json!({ "do": "run", "changes": [{ "path": "gap.0.width", "value": "118 mm" }], "frames": 1_000_000_000_u64 }));
    requests.push(
        json!({ "do": "run", "changes": [{ "path": "gap.7.width", "value": 1 }], "frames": 0 }),
    );
    requests.push(json!({ "do": "sweep", "changes": [], "gap": 3, "widths": [-1, 0, 1e300] }));
    requests.push(json!({ "do": "calibrate", "changes": [], "gap": 5, "model": "hertz_1882" }));
    requests.push(json!({ "do": "nothing" }));
    let answers = under_node(&requests).unwrap_or_else(|| natively(&requests));
    let refused = |answer: &Value| {
        let faults = answer["faults"].as_array();
        faults.is_some_and(|faults| !faults[0]["message"].as_str().unwrap().is_empty())
    };
    let accepted: Vec<usize> = (2..answers.len())
        .filter(|i| !refused(&answers[*i]))
        .collect();
    for i in &accepted {
        let shown: String = requests[*i].to_string().chars().take(90).collect();
        eprintln!("accepted: {shown}");
    }
    // A fine output step costs nothing here, and of frames there are as many as have a place.
    assert_eq!(accepted, [5, 2 + hostile.len()]);
}

/// The page in browsers: `tests/python/open_explorer.py` moves it from 20 mm to 118 mm, drops files
/// on it, runs the case that it gives away, and looks at it wide, narrow and dark.
#[test]
fn page_in_browsers() {
    let named = ["POUNDING_PYTHON", "POUNDING_CHROMIUM"].map(std::env::var_os);
    let [Some(python), Some(_)] = named else {
        eprintln!(
            "skipped: POUNDING_PYTHON or POUNDING_CHROMIUM names no program, no page was opened"
        );
        return;
    };
    if !has_module() {
        return;
    }
    let bench = Bench::with(BROKEN_CASE);
    bench.write("dropped.NS", &k_net());
    bench.write("jma.csv", &jma());
    // Another record under the name of the one that is dropped.
    std::fs::create_dir(bench.folder().join("other")).unwrap();
    bench.write("other/dropped.NS", &jma());
    let other = bench.folder().join("other/dropped.NS");
    let page = bench.folder().join("page.html");
    let case = root().join("examples/three_storey_pair/case.toml");
    text(
        "explore",
        &format!(
            "{} --records {} -o {}",
            case.display(),
            other.display(),
            page.display()
        ),
    );
    let output = Command::new(python)
        .arg(root().join("tests/python/open_explorer.py"))
        .arg(page)
        .arg(env!("CARGO_BIN_EXE_pounding"))
        .args(["dropped.NS", "case.toml", "jma.csv"].map(|name| bench.folder().join(name)))
        .arg(root().join("examples/gap_check/rules.toml"))
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{told}");
    eprintln!("{}", String::from_utf8_lossy(&output.stdout));
}

/// The page of a case: whole, small, and without an address in it.
#[test]
fn page_is_whole() {
    let bench = Bench::with(
        &std::fs::read_to_string(root().join("examples/three_storey_pair/case.toml"))
            .unwrap()
            .replace("../../ground_motions", "MOTIONS"),
    );
    let output = bench.output("explore case.toml -o page.html");
    let told = String::from_utf8_lossy(&output.stderr);
    if !has_module() {
        assert_eq!(output.status.code(), Some(3), "{told}");
        assert!(told.contains("holds no solver for pages"), "{told}");
        return;
    }
    assert_eq!(output.status.code(), Some(0), "{told}");
    let page = bench.folder().join("page.html");
    assert!(page.metadata().unwrap().len() < MOST);
    // The case names its record by the folder of the sources.
    let page = bench
        .read("page.html")
        .replace(&root().display().to_string(), "");
    assert!(!page.contains("https://") && !page.contains("/root/") && !page.contains(".cargo"));
    bench.text("explore case.toml");
    assert!(bench.folder().join("case.html").is_file());
    bench.write("case.toml", "title = 1\n");
    bench.refused("explore case.toml", &["`title` must be a text"]);
}

/// Two records of one file name are two records.
#[test]
fn records_of_one_name_are_kept_apart() {
    if !has_module() {
        return;
    }
    let bench = Bench::with(
        &std::fs::read_to_string(root().join("examples/three_storey_pair/case.toml"))
            .unwrap()
            .replace("../../ground_motions", "MOTIONS"),
    );
    for (folder, name) in [("a", "el_centro_1940_ns"), ("b", "kobe_1995_jma_ns")] {
        std::fs::create_dir(bench.folder().join(folder)).unwrap();
        let record = root().join(format!("ground_motions/{name}.csv"));
        std::fs::copy(record, bench.folder().join(format!("{folder}/x.csv"))).unwrap();
    }
    let output = bench.output("explore case.toml --records a/x.csv b/x.csv -o page.html");
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{told}");
    let page = bench.read("page.html");
    for name in ["\"x.csv\"", "\"x (2).csv\""] {
        assert_eq!(page.matches(name).count(), 1, "{name}");
    }
}
