//! What a page that computes does with input that cannot be run, or that it does not know, and what it
//! gives away of names that nobody meant.
use pounding_catalogue::wording::cell;
use serde_json::{Value, json};

use crate::explore::{asked_of, asked_of_page, natively, of_the_pair, part, root};
use crate::support::Bench;

/// The README's pair for so long.
fn pair(duration: &str) -> String {
    std::fs::read_to_string(root().join("examples/three_storey_pair/case.toml"))
        .unwrap()
        .replacen("31 s", duration, 1)
}

/// Types into a field, or chooses, and waits until this is true.
fn put(id: &str, value: &str, until: &str) -> String {
    format!(
        "(() => {{ const field = document.getElementById('control-{id}'); field.value = '{value}'; field.dispatchEvent(new Event('change'));\
         return {}; }})()",
        wait(until)
    )
}

/// Waits until this is true and all that was asked of the page is on it.
fn wait(until: &str) -> String {
    let done = format!("({until}) && document.documentElement.dataset.asked === '0'");
    format!(
        "(async () => {{ for (let i = 0; i < 600 && !({done}); i++) await new Promise((next) => setTimeout(next, 50)); }})()"
    )
}

/// Presses a button that gives a file; its text, or that the button is disabled.
fn file_of(button: &str) -> String {
    format!(
        "(async () => {{ const button = document.querySelector('[data-part={button}]'); if (button.disabled) return 'disabled';\
         const made = URL.createObjectURL; let given = null; URL.createObjectURL = (blob) => {{ given = blob; return made.call(URL, blob); }};\
         button.click(); for (let i = 0; i < 200 && !given; i++) await new Promise((next) => setTimeout(next, 50));\
         URL.createObjectURL = made; return given.text(); }})()"
    )
}

const FAULTS: &str = "[...document.querySelectorAll('.fault')].map((e) => e.textContent)";
const WRONG: &str = "document.querySelectorAll('.fault').length > 0";
const RIGHT: &str =
    "document.querySelectorAll('.fault').length === 0 && !document.querySelector('.stale')";
/// The model that is chosen, the one whose words stand below, and what is said of stale answers.
const CHOSEN: &str = "[document.getElementById('control-gap.0-model').value, document.querySelector('[data-part=controls] summary').textContent,\
                      document.querySelector('[data-part=stale]').checkVisibility() && document.querySelector('[data-part=stale]').textContent]";

/// A model that is chosen while something else is wrong is taken up as soon as that is corrected, and
/// until then the answers are of no input.
#[test]
fn a_model_is_taken_up_when_it_can_be() {
    let named = |model: &str| format!("{RIGHT} && ({CHOSEN})[1] === 'About {model}'");
    let wished = |model: &str| {
        format!("document.querySelector('[data-part=stale]').textContent.includes('{model}')")
    };
    let [hertz, linear] = ["hertz_1882", "exact_linear"];
    let case = file_of("case");
    let reset = "document.querySelector('[data-part=reset]').click()";
    let shared = "document.querySelector('[data-part=share]').disabled";
    let again = wait(&named("jankowski_2005"));
    let slider = "(({ value, min, max }) => [value === min, value === max])(document.querySelector('input[type=range][data-control=\"gap.0.restitution\"]'))";
    let expressions = [
        put("building.0.mass-0", "0", WRONG),
        put("gap.0-model", hertz, &wished(hertz)),
        CHOSEN.to_owned(),
        FAULTS.to_owned(),
        case.clone(),
        shared.to_owned(),
        put("building.0.mass-0", "25", &named(hertz)),
        CHOSEN.to_owned(),
        FAULTS.to_owned(),
        case.clone(),
        // Two parameters that exclude one another.
        reset.to_owned(),
        again.clone(),
        put("gap.0.restitution", "0.6", WRONG),
        put("gap.0-model", hertz, &wished(hertz)),
        put("gap.0.restitution", "", &named(hertz)),
        case.clone(),
        // One that is missing.
        reset.to_owned(),
        again.clone(),
        put("gap.0.damping_ratio", "", WRONG),
        put("gap.0-model", linear, &wished(linear)),
        put("gap.0.restitution", "0.5", &named(linear)),
        case.clone(),
        // A field that is emptied leaves nothing of its slider.
        reset.to_owned(),
        again,
        put("gap.0.restitution", "0.6", WRONG),
        put("gap.0.restitution", "", RIGHT),
        slider.to_owned(),
    ];
    let expressions: Vec<&str> = expressions.iter().map(String::as_str).collect();
    let Some(told) = asked_of_page(&pair("6 s"), &expressions) else {
        return;
    };
    let said = told[2][2].as_str().unwrap();
    assert_eq!(told[2][0], hertz);
    assert!(said.contains("hertz_1882 is taken up"), "{said}");
    assert_eq!(told[3].as_array().unwrap().len(), 1, "{}", told[3]);
    assert_eq!([&told[4], &told[5]], [&json!("disabled"), &json!(true)]);
    assert_eq!(told[7], json!([hertz, "About hertz_1882", false]));
    assert_eq!(told[8], json!([]));
    for (at, model) in [(9, hertz), (15, hertz), (21, linear)] {
        let text = told[at].as_str().unwrap();
        assert!(text.contains(&format!("model = \"{model}\"")), "{text}");
    }
    assert!(told[21].as_str().unwrap().contains("restitution = 0.5"));
    assert_eq!(told[26], json!([true, false]));
}

/// A text that is no number leaves the value that is in force, as does an emptied field of a storey; numbers as long as a
/// field takes them are shown. Beside a rigid law the page says that a model has the parameters of its example.
#[test]
fn texts_that_are_no_numbers_leave_values() {
    let typed = |id: &str, text: &str| {
        format!(
            "(() => {{ const field = document.getElementById('control-{id}'); field.focus(); field.select();\
             document.execCommand('insertText', false, '{text}'); const bad = field.validity.badInput;\
             field.dispatchEvent(new Event('change')); return [bad, field.value]; }})()"
        )
    };
    let value = |id: &str| format!("document.getElementById('control-{id}').value");
    let overlay =
        "document.querySelector('[data-part=overlays] input[value=kuwabara_kono_1987]').click()";
    let calibrations = "document.querySelector('[data-part=calibrations]').textContent";
    let expressions = [
        put("ground_motion.scale", "2", RIGHT),
        typed("ground_motion.scale", "3e"),
        wait(RIGHT),
        file_of("case"),
        put("building.0.mass-1", "", RIGHT),
        value("building.0.mass-1"),
        put("gap.0.width", "1e150", RIGHT),
        value("gap.0.width"),
        file_of("case"),
        put("gap.0.width", "20", RIGHT),
        overlay.to_owned(),
        wait(&format!("{calibrations}.length > 0")),
        calibrations.to_owned(),
        put(
            "gap.0-model",
            "stereomechanical",
            &format!("{RIGHT} && {calibrations}.includes('example')"),
        ),
        calibrations.to_owned(),
    ];
    let expressions: Vec<&str> = expressions.iter().map(String::as_str).collect();
    let Some(told) = asked_of_page(&pair("6 s"), &expressions) else {
        return;
    };
    assert_eq!(told[1], json!([true, "2"]));
    let case = told[3].as_str().unwrap();
    assert!(case.contains("scale = 2"), "{case}");
    assert_eq!(told[5], "25");
    assert_eq!(told[7], "1e150");
    let case = told[8].as_str().unwrap();
    assert!(
        case.contains("width = \"1e150 mm\"") || case.contains("width = \"1e+150 mm\""),
        "{case}"
    );
    let calibrated = told[12].as_str().unwrap();
    assert!(
        calibrated.contains("kuwabara_kono_1987: dissipation_time = "),
        "{calibrated}"
    );
    let of_example = told[14].as_str().unwrap();
    assert!(
        of_example.contains("parameters of the model's example, as"),
        "{of_example}"
    );
}

/// Names are texts to a spreadsheet, have no more room than there is, and tables are in the words of
/// `gap --csv`; nothing that is one or none is counted as several.
#[test]
fn names_and_words() {
    let long = format!("=cmd|{}", "x".repeat(180));
    let case = pair("6 s")
        .replace("\"light\"", &format!("\"{long}\""))
        .replace("\"heavy\"", "\"@sum, or more\"");
    let texts = [
        "=1+1", "+a", "-", "-a", "-1", "+2.5e3", "-.5", "@b", "\tc", "light", "-1x", "-inf",
    ];
    let guarded = format!(
        "{}.map((text) => elements.quoted(text))",
        serde_json::to_string(&texts).unwrap()
    );
    let counts = "[0, 1, 2].map((n) => elements.counted(n, 'impact'))";
    let wide = "document.documentElement.scrollWidth";
    let columns = "[...document.querySelectorAll('[data-part=storeys] tbody th')].map((e) => e.getBoundingClientRect().width)";
    let together = "getComputedStyle(document.querySelector('[data-part=legend]').closest(':has([data-part=sweep])')).breakInside";
    let [sweep, peaks] = ["sweep-csv", "peaks-csv"].map(file_of);
    let apart = put(
        "gap.0.width",
        "500",
        "document.querySelector('[data-result=impacts]').textContent === '0'",
    );
    let label = "document.querySelector('[data-part=impacts]').getAttribute('aria-label')";
    let impacts = part("impacts");
    let caption = "((select) => { select.value = '1'; select.dispatchEvent(new Event('change')); return document.querySelector('figcaption').textContent; })(document.querySelector('[data-part=magnification]'))";
    let models = "document.querySelector('[data-part=sweep]').getAttribute('aria-label')";
    let expressions = [
        &guarded, counts, &sweep, &peaks, models, "@print", together, "@screen", "@400", wide,
        columns, &apart, label, &impacts, caption,
    ];
    let Some(told) = asked_of_page(&case, &expressions) else {
        return;
    };
    assert_eq!(told[0], json!(texts.map(|text| cell(text))));
    assert_eq!(told[1], json!(["0 impacts", "1 impact", "2 impacts"]));
    let rows = |at: usize| -> Vec<String> {
        let lines = told[at].as_str().unwrap().lines();
        lines.map(str::to_owned).collect()
    };
    let (sweep, peaks) = (rows(2), rows(3));
    assert_eq!(
        sweep[0],
        "gap,model,width_m,building,displacement_amplification,impacts,peak_force_n,impact_energy_j,failure"
    );
    let of_gap = format!("\"'{long}-@sum, or more\",jankowski_2005,");
    let buildings = [format!(",'{long},"), ",\"'@sum, or more\",".to_owned()];
    for (line, building) in sweep[1..].iter().zip(buildings.iter().cycle()) {
        assert!(
            line.starts_with(&of_gap) && line.contains(building),
            "{line}"
        );
    }
    assert_eq!(sweep.len(), 1 + 2 * 400);
    assert!(peaks[1].starts_with(&format!("'{long},1,")), "{}", peaks[1]);
    assert!(peaks[4].starts_with("\"'@sum, or more\",1,"));
    assert!(told[4].as_str().unwrap().ends_with(", 1 model"));
    assert_eq!(told[5], "avoid");
    assert!(told[6].as_f64().unwrap() <= 400.0, "{}", told[6]);
    let widest: Vec<f64> = serde_json::from_value(told[7].clone()).unwrap();
    assert!(
        widest.iter().all(|width| (80.0..270.0).contains(width)),
        "{widest:?}"
    );
    assert!(told[9].as_str().unwrap().starts_with("no impacts over 6 s"));
    let chart = told[10].as_str().unwrap();
    assert!(chart.contains("impacts: none"), "{chart}");
    assert!(!chart.contains("0.5") && !chart.contains("kN"), "{chart}");
    let caption = told[11].as_str().unwrap();
    assert!(
        caption.ends_with("displacements and gaps are drawn to scale too."),
        "{caption}"
    );
}

/// A scale with more than a number is moved by its value, and one by a spectrum is said to stay.
#[test]
fn scales_are_moved() {
    let scaled = |scale: &str| {
        let record = "el_centro_1940_ns.csv\"\n";
        pair("6 s").replacen(record, &format!("{record}scale = {scale}\n"), 1)
    };
    let open = |text: &str| json!({ "do": "open", "name": "case.toml", "$text": text });
    let motion = |answer: &Value, label: &str| -> Value {
        let controls = answer["controls"].as_array().unwrap().iter();
        let mut found = controls.filter(|c| c["label"].as_str().unwrap().starts_with(label));
        found.next().unwrap_or_else(|| panic!("{answer}")).clone()
    };
    let [psa, pgv, band] = [
        "{ psa = \"0.5 g\", period = \"1.2 s\" }",
        "{ pgv = \"0.4 m/s\" }",
        "{ code = \"eurocode_8_2004\", ag = \"0.25 g\", ground_type = \"C\" }",
    ]
    .map(scaled);
    let run = |changes: Value| json!({ "do": "run", "changes": changes, "frames": 0 });
    let moved = json!([{ "path": "ground_motion.scale.psa", "value": "1 g" }]);
    let faster = json!([{ "path": "ground_motion.scale.pgv", "value": "0.8 m/s" }]);
    let requests = vec![
        open(&psa),
        run(moved),
        open(&pgv),
        run(faster),
        open(&band),
        open(&scaled("{ psa = \"1 g\", period = \"1.2 s\" }")),
        run(json!([])),
    ];
    let answers = natively(&of_the_pair(requests));
    let control = motion(&answers[2], "scale");
    assert_eq!(control["label"], "scale: psa at 1.2 s");
    assert_eq!([&control["unit"], &control["kind"]], ["g", "number"]);
    assert!((control["value"].as_f64().unwrap() - 0.5 * 9.80665).abs() < 1e-9);
    assert_eq!(answers[3]["summary"], answers[8]["summary"]);
    let control = motion(&answers[4], "scale");
    assert_eq!([&control["label"], &control["unit"]], ["scale: pgv", "m/s"]);
    assert!(answers[5]["faults"].is_null(), "{}", answers[5]);
    let control = motion(&answers[6], "scale");
    assert_eq!(control["kind"], "said");
    assert!(control["value"].as_str().unwrap().contains("spectrum"));
}

/// Another model in the place of one with parameters for each level is said to have one law at all levels.
#[test]
fn models_of_gaps_with_a_law_for_each_level() {
    let calibrate = json!({ "do": "calibrate", "changes": [], "gap": 0, "model": "hertz_1882" });
    let levels = pair("31 s").replacen(
        "damping_ratio = 0.35",
        "damping_ratio = [0.35, 0.3, 0.2]",
        1,
    );
    assert!(levels.contains("[0.35, 0.3, 0.2]"));
    let open = json!({ "do": "open", "name": "case.toml", "$text": levels });
    let answers = natively(&of_the_pair(vec![calibrate.clone(), open, calibrate]));
    let notes = |i: usize| answers[i]["notes"].to_string();
    assert!(
        !notes(2).contains("parameters of their own"),
        "{}",
        notes(2)
    );
    assert!(notes(4).contains("parameters of their own"), "{}", notes(4));
}

/// A model can be chosen where a building collapses without contact: there is nothing to be like. Such a
/// case is sound, and so is one of more steps than a page takes.
#[test]
fn models_of_what_collapses() {
    let calibrate = json!({ "do": "calibrate", "changes": [], "gap": 0, "model": "hertz_1882" });
    let run = json!({ "do": "run", "changes": [], "frames": 0 });
    let open = json!({ "do": "open", "name": "case.toml", "$text": falling(&pair("31 s")) });
    let massless = json!([{ "path": "building.0.mass", "value": 0 }]);
    let refused = json!({ "do": "run", "changes": massless, "frames": 0 });
    let endless = pair("31 s").replacen(
        "[analysis]",
        "[analysis]\nmethod = \"newmark\"\nstep = \"1e-7 s\"",
        1,
    );
    let long = json!({ "do": "open", "name": "case.toml", "$text": endless });
    let answers = natively(&of_the_pair(vec![open, calibrate, run, refused, long]));
    assert_eq!(answers[3]["keys"][0], json!(["model", "hertz_1882"]));
    let fault = &answers[4]["faults"][0];
    assert!(fault["message"].as_str().unwrap().contains("collapsed"));
    assert_eq!(fault["sound"], true);
    assert_eq!(answers[5]["faults"][0]["sound"], false);
    assert!(
        answers[5]["faults"][0]["help"]
            .as_str()
            .unwrap()
            .contains("above zero")
    );
    let fault = &answers[6]["faults"][0];
    assert!(
        fault["message"].as_str().unwrap().contains("steps"),
        "{fault}"
    );
    assert_eq!(fault["sound"], true);
}

/// A pair whose light building falls by itself.
fn falling(case: &str) -> String {
    let law = "p_delta = true\nlaw = { model = \"elastic_perfectly_plastic\", yield_force = \"15 kN\" }\nstiffness = \"3.46 MN/m\"";
    case.replacen("stiffness = \"3.46 MN/m\"", law, 1)
}

/// A case that collapses is sound: it has no peaks, and its file is there. What is shown beside it is
/// said to be of another input.
#[test]
fn a_collapse_leaves_the_case() {
    let bench = Bench::with(&pair("31 s").replace("../../ground_motions", "MOTIONS"));
    let text = falling(&bench.read("case.toml"));
    let drop = format!(
        "(() => {{ const data = new DataTransfer(); data.items.add(new File([{}], 'falls.toml'));\
         dispatchEvent(new DragEvent('drop', {{ dataTransfer: data, bubbles: true, cancelable: true }})); }})()",
        serde_json::to_string(&text).unwrap()
    );
    let banner = part("stale");
    let buttons = "['case', 'share', 'peaks-csv'].map((name) => document.querySelector(`[data-part=${name}]`).disabled)";
    let fallen = wait("document.querySelector('[data-part=stale]').checkVisibility()");
    let case = file_of("case");
    let Some(told) = asked_of(&bench, &[&drop, &fallen, FAULTS, &banner, buttons, &case]) else {
        return;
    };
    assert!(told[2][0].as_str().unwrap().contains("collapsed at t ="));
    let banner = told[3].as_str().unwrap();
    assert!(
        banner.starts_with("This input has no peaks") && !banner.contains("cannot be run"),
        "{banner}"
    );
    assert_eq!(told[4], json!([false, false, true]));
    assert_eq!(told[5], text);
}

/// A building that its neighbours hold up, and that falls without them: it alone has nothing to be compared
/// with, and what the gaps demand is not known.
#[test]
fn a_building_that_neighbours_hold_up() {
    let building = |name: &str, mass: &str, stiffness: &str, further: &str| {
        format!(
            "[[building]]\nname = \"{name}\"\nstoreys = 1\nmass = \"{mass}\"\nstiffness = \"{stiffness}\"\nheight = \"3 m\"\ndamping = {{ modal = 0.05 }}\n{further}"
        )
    };
    let gap = |left: &str, right: &str| {
        format!(
            "[[gap]]\nbetween = [\"{left}\", \"{right}\"]\nwidth = \"30 mm\"\nmodel = \"kelvin_voigt\"\nstiffness = \"100 MN/m\"\nrestitution = 0.6\n"
        )
    };
    let falls = "p_delta = true\nlaw = { model = \"elastic_perfectly_plastic\", yield_force = \"15 kN\" }\n";
    let case = [
        building("a", "300 t", "150 MN/m", ""),
        building("weak", "50 t", "3.46 MN/m", falls),
        building("b", "300 t", "120 MN/m", ""),
        gap("a", "weak"),
        gap("weak", "b"),
        "[ground_motion]\nfile = \"../../ground_motions/el_centro_1940_ns.csv\"\n[analysis]\nduration = \"12 s\"\n".to_owned(),
    ]
    .concat();
    let open = json!({ "do": "open", "name": "case.toml", "$text": &case });
    let run = json!({ "do": "run", "changes": [], "frames": 0 });
    let answer = &natively(&of_the_pair(vec![open, run]))[3];
    let isolated = |building: usize| {
        &answer["summary"]["buildings"][building]["isolated"][0]["displacement"]["peak"]
    };
    assert!(isolated(0).is_number() && isolated(1).is_null() && isolated(2).is_number());
    assert_eq!(answer["demand"][0][0]["peak"], Value::Null);
    let warnings = answer["summary"]["warnings"].to_string();
    assert!(
        warnings.contains("weak collapsed at") && warnings.contains("compare this building with"),
        "{warnings}"
    );
}

/// Of an address what cannot be run is left out, and what nobody knows is ignored: both are said, and
/// the page is there.
#[test]
fn addresses_are_no_traps() {
    let go = |state: Value| {
        let text = serde_json::to_string(&state.to_string()).unwrap();
        let said = wait(&format!(
            "{WRONG} && document.documentElement.dataset.seen !== ({FAULTS})[0]"
        ));
        [
            format!(
                "(() => {{ document.documentElement.dataset.seen = ({FAULTS})[0]; location.hash = encodeURIComponent({text}); }})()"
            ),
            said,
            FAULTS.to_owned(),
            "['gap.0.width', 'gap.0-model'].map((id) => document.getElementById(`control-${id}`).value)".to_owned(),
        ]
    };
    let states = [
        (
            json!({ "entries": { "gap.0.width": "abc" } }),
            vec!["what the address changes is left out", "abc"],
        ),
        (
            json!({ "models": { "gap.0": [["model", "nonsense_model"]] } }),
            vec!["what the address changes is left out", "nonsense_model"],
        ),
        (
            json!({ "models": { "gap.0": "nonsense" } }),
            vec!["ignored", "models {\"gap.0\":\"nonsense\"}"],
        ),
        // What no control shows.
        (
            json!({ "entries": { "analysis.duration": "2 s", "gap.0.width": "20 mm" } }),
            vec!["ignored", "analysis.duration"],
        ),
        (
            json!({ "absent": ["gap.0.name"], "entries": { "gap.0.levels": [[1, 1]] } }),
            vec!["ignored", "gap.0.levels", "gap.0.name"],
        ),
        (
            json!({ "models": { "gap.0": [["model", "jankowski_2005"], ["stiffness", 2.75e9], ["damping_ratio", 0.35], ["levels", [[3, 3]]]] } }),
            vec!["ignored", "gap.0.levels"],
        ),
        (
            json!({ "overlays": ["hertz_1882", "no_such_law"], "gap": 99, "quantity": "weight", "more": 1 }),
            vec![
                "ignored",
                "overlays no_such_law",
                "gap 99",
                "quantity weight",
                "more 1",
            ],
        ),
    ];
    let expressions: Vec<String> = states
        .iter()
        .flat_map(|(state, _)| go(state.clone()))
        .collect();
    let reset = "document.querySelector('[data-part=reset]').click()";
    // The address stays until something is changed.
    let address = "decodeURIComponent(location.hash)";
    let clean = wait(&format!("!{address}.includes('weight')"));
    let expressions = expressions.iter().map(String::as_str);
    let expressions: Vec<&str> = expressions
        .chain([address, reset, &clean, address])
        .collect();
    let Some(told) = asked_of_page(&pair("6 s"), &expressions) else {
        return;
    };
    let last = &told[4 * states.len()..];
    assert!(last[0].as_str().unwrap().contains("weight"), "{}", last[0]);
    assert!(!last[3].as_str().unwrap().contains("weight"), "{}", last[3]);
    for (number, (state, words)) in states.iter().enumerate() {
        let faults = told[4 * number + 2].as_array().unwrap();
        assert_eq!(faults.len(), 1, "{state}: {faults:?}");
        let said = faults[0].as_str().unwrap();
        for word in words {
            assert!(said.contains(word), "{state}: {said}");
        }
        assert!(!said.contains("hertz_1882"), "{said}");
        assert_eq!(told[4 * number + 3], json!(["20", "jankowski_2005"]));
    }
}
