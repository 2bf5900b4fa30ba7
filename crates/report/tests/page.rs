//! Pages of results that are made by hand: nothing that a result can hold breaks one.
use pounding_files::checksum::{Checksum, WithoutChecksum, append};
use pounding_report::{
    BaseMoment, BuildingResult, EnergyHistory, GapResult, ImpactResult, LevelResponses,
    LevelResult, NamedResponse, ReportError, RunResult, StoreyPeaks, Table, page::run as page,
};

fn peaks(value: [f64; 2], isolated: [f64; 2]) -> StoreyPeaks {
    StoreyPeaks {
        value: value.to_vec(),
        isolated: isolated.to_vec(),
    }
}

fn table(column: &[f64]) -> Table {
    Table {
        values: column.iter().flat_map(|x| [0.5 * x, *x]).collect(),
        columns: 2,
    }
}

fn impact(level: u64, peak_force: f64) -> ImpactResult {
    ImpactResult {
        level,
        t_close: 1.25,
        t_open: 1.26,
        approach_velocity: 0.321,
        separation_velocity: 0.2,
        achieved_restitution: 0.623,
        peak_force,
        peak_force_time: 1.255,
        peak_penetration: 2.0e-3,
        impulse: 4.0e3,
        energy_dissipated: 6.0e2,
        constants: [0.0; 4],
    }
}

fn level(label: &str, elevation: f64) -> LevelResult {
    LevelResult {
        label: label.to_owned(),
        elevations: [elevation, elevation],
    }
}

fn result() -> RunResult {
    let time: Vec<f64> = (0..500).map(|i| 0.02 * f64::from(i)).collect();
    let wave: Vec<f64> = time.iter().map(|t| 0.1 * (3.0 * t).sin()).collect();
    let building = |name: &str| BuildingResult {
        name: name.to_owned(),
        elevation: vec![3.0, 6.0],
        on_moving_ground: true,
        pushed: false,
        displacement: table(&wave),
        displacement_peaks: peaks([0.05, 0.1], [0.06, 0.08]),
        drift_peaks: peaks([0.016, 0.017], [0.02, 0.01]),
        shear_peaks: peaks([2.0e5, 1.0e5], [1.0e5, 1.0e5]),
        acceleration_peaks: peaks([4.0, 9.0], [3.0, 3.0]),
        isolator: None,
        base_moment: None,
        responses: Vec::new(),
        frames: Vec::new(),
        ductility: None,
        period: vec![0.61, 0.2],
        damping_ratio: vec![0.05, 0.05],
    };
    let energy: Vec<f64> = time.iter().map(|t| 1.0e3 * t).collect();
    RunResult {
        checksum: Checksum::Matches,
        title: "A pair".to_owned(),
        version: "0.1.0".to_owned(),
        case: "[case]\ntitle = \"A pair\"\n".to_owned(),
        case_sha256: "ab".repeat(32),
        record_sha256: "cd".repeat(32),
        record: "El Centro".to_owned(),
        method: "event-driven".to_owned(),
        warnings: Vec::new(),
        steps: 1559,
        wall_time: 0.01,
        residual_ratio: 1.2e-13,
        ground_acceleration: wave.clone(),
        buildings: vec![building("light"), building("heavy")],
        gaps: vec![GapResult {
            name: "light-heavy".to_owned(),
            between: "light | heavy".to_owned(),
            model: "jankowski_2005".to_owned(),
            separation: "zero_penetration".to_owned(),
            clearance: None,
            levels: vec![level("1-1", 3.0), level("2-2", 6.0)],
            width: vec![0.02, 0.02],
            penetration: table(&wave),
            force: table(&vec![0.0; wave.len()]),
            impacts: vec![impact(2, 1.271e6), impact(1, 3.0e5), impact(2, 8.0e5)],
            responses: Vec::new(),
        }],
        links: Vec::new(),
        energy: EnergyHistory {
            input: energy.clone(),
            kinetic: vec![0.0; time.len()],
            strain: vec![0.0; time.len()],
            viscous: energy.iter().map(|e| 0.75 * e).collect(),
            hysteretic: vec![0.0; time.len()],
            impact: energy.iter().map(|e| 0.25 * e).collect(),
        },
        time,
    }
}

/// Every element that is opened is closed, in order, and nothing is fetched or run but our own
/// script, in which no text of a case is; the page without it.
fn is_whole(html: &str) -> String {
    let (before, rest) = html
        .split_once("<script type=\"application/json\" id=\"data\">")
        .unwrap();
    let (data, rest) = rest.split_once("</script>\n<script>\n").unwrap();
    let (ours, after) = rest.split_once("</script>\n").unwrap();
    let run = include_str!("../src/page/run/run.js");
    assert_eq!(ours, format!("{}{run}", pounding_elevation::SCRIPT));
    let _: serde_json::Value = serde_json::from_str(data).unwrap();
    assert!(
        !data.contains(['<', '>', '&', '\u{2028}', '\u{2029}']),
        "{data}"
    );
    let html = &format!("{before}{after}");
    let mut open = Vec::new();
    for tag in html.split('<').skip(1) {
        let (tag, _) = tag.split_once('>').unwrap();
        let name = tag
            .trim_start_matches('/')
            .split([' ', '\n', '/'])
            .next()
            .unwrap();
        let alone = ["!DOCTYPE", "meta", "br", "input"].contains(&name) || tag.ends_with('/');
        if let Some(closed) = tag.strip_prefix('/') {
            assert_eq!(open.pop().as_deref(), Some(closed.trim()), "{tag}");
        } else if !alone {
            open.push(name.to_owned());
        }
    }
    assert!(open.is_empty(), "{open:?}");
    for foreign in ["<script", "src=", "href=", "@import", "url("] {
        assert!(!html.contains(foreign), "{foreign}");
    }
    without_data(html)
}

/// The page with numbers in sentences as plain text.
fn without_data(html: &str) -> String {
    let parts = html.split("<data ").enumerate();
    let plain = parts.map(|(i, part)| match i {
        0 => part,
        _ => part.split_once('>').unwrap().1,
    });
    plain.collect::<String>().replace("</data>", "")
}

#[test]
fn the_answers_stand_in_the_page() {
    let html = page(&result(), "pair.h5").unwrap();
    let html = is_whole(&html);
    for answer in [
        "Gap light-heavy closes 3 times</strong> at 2 of 2 levels",
        "1271 kN at level 2-2 (6.000 m | 6.000 m), 1.250 s into the motion, approaching with 0.3210 m/s",
        "acceleration at most 3.00 times (storey 2: 9.000 m/s\u{b2}, alone 3.000 m/s\u{b2})",
        "viscous damping 75.0 %, impacts 25.0 %",
        "closes to 1.2e-13",
        "The hardest 3 of 3 impacts",
        // Storey 2: displacement with, without, ratio.
        "<td>100.0</td><td>80.00</td><td>1.25</td>",
    ] {
        assert!(html.contains(answer), "{answer}\n{html}");
    }
    // Nothing yields: no curve and no share of it.
    assert!(!html.contains("yielding"));
}

/// A gap that stays open has no impact to go to, and a page with impacts no end of them.
#[test]
fn curves_are_named_after_what_they_show() {
    let html = page(&result(), "pair.h5").unwrap();
    assert!(html.contains("<h3>Around an impact</h3>"));
    assert!(html.contains("data-part=\"next\">Next impact"));
    let mut open = result();
    open.gaps[0].impacts.clear();
    let html = page(&open, "pair.h5").unwrap();
    assert!(html.contains("<h3>Motion over time</h3>") && !html.contains("Around an impact"));
    for part in ["previous", "next"] {
        assert!(html.contains(&format!("data-part=\"{part}\" hidden>")));
    }
}

/// The first view is that of the hardest impact, wherever output times lie, and its level is
/// marked as closed.
#[test]
fn the_hardest_impact_is_what_is_seen_first() {
    let mut result = result();
    for impact in &mut result.gaps[0].impacts {
        impact.t_open = impact.t_close + 2.0e-4;
        impact.peak_force_time = impact.t_close + 1.0e-4;
    }
    let first = &mut result.gaps[0].impacts[0];
    (first.t_close, first.peak_force_time, first.t_open) = (1.2512, 1.2513, 1.2514);
    let html = page(&result, "pair.h5").unwrap();
    assert!(html.contains("Elevation at <span data-part=\"instant\">1.251</span> s."));
    assert!(html.contains("\"time\":1.2513,"));
    assert_eq!(html.matches("class=\"contact closed\"").count(), 1);
    assert!(html.contains("every 0.02 s, displacements are drawn straight"));
    // A jump has an impulse and no force.
    let html = page(&result, "pair.h5").unwrap();
    assert!(!html.contains("where velocities jump"));
    for impact in &mut result.gaps[0].impacts {
        (impact.peak_force, impact.peak_force_time) = (f64::NAN, 0.0);
    }
    result.gaps[0].impacts[0].impulse = 9.0e3;
    let html = page(&result, "pair.h5").unwrap();
    assert!(html.contains("\"time\":1.2512,"));
    assert!(html.contains("its impulse as a line where velocities jump"));
}

/// Names that run from right to left turn nothing of the sentences and headings around them.
#[test]
fn names_from_right_to_left_stand_apart() {
    let [one, two] = [
        "\u{645}\u{628}\u{646}\u{649} 1",
        "\u{645}\u{628}\u{646}\u{649} 2",
    ];
    let mut result = result();
    result.title = format!("{one} (A) 3");
    result.buildings[0].name = one.to_owned();
    result.buildings[1].name = two.to_owned();
    result.gaps[0].name = format!("{one}-{two}");
    result.gaps[0].between = format!("{one} | {two}");
    let html = page(&result, "pair.h5").unwrap();
    let html = is_whole(&html);
    for part in [
        format!("<h1><bdi>{one} (A) 3</bdi></h1>"),
        format!("<title>{one} (A) 3</title>"),
        format!("<h2>Building <bdi>{one}</bdi></h2>"),
        format!("<h2>Gap <bdi>{one}-{two}</bdi></h2>"),
        format!("Gap <bdi>{one}-{two}</bdi> closes 3 times"),
        format!("Peaks of building <bdi>{one}</bdi> beside"),
        format!("<p><bdi>{one}</bdi> | <bdi>{two}</bdi> &middot;"),
    ] {
        assert!(html.contains(&part), "{part}\n{html}");
    }
}

/// A building with many modes shows the first ones, and says so; few are all there.
#[test]
fn modes_that_are_left_out_are_said() {
    let with = |modes: usize| {
        let mut result = result();
        result.buildings[0].period = (0..modes).map(|i| 1.0 / (i + 1) as f64).collect();
        result.buildings[0].damping_ratio = vec![0.05; modes];
        page(&result, "pair.h5").unwrap()
    };
    let [few, many] = [with(6), with(14)];
    assert!(few.contains("aria-label=\"Modes\"") && !few.contains("The first"));
    assert!(few.contains("<tr data-row=\"5\">"));
    assert!(many.contains("<p class=\"note\">The first 12 of 14 modes.</p>"));
}

/// Displacements that are drawn as large as they are are to scale.
#[test]
fn what_is_drawn_as_it_is_is_to_scale() {
    let mut result = result();
    for building in &mut result.buildings {
        for value in &mut building.displacement.values {
            *value *= 10.0;
        }
    }
    let html = page(&result, "pair.h5").unwrap();
    assert!(
        html.contains("drawn <span data-part=\"factor\">to scale too</span>."),
        "{html}"
    );
}

/// The energy is that of what acts: the ground, forces on floors, the motion at the start.
#[test]
fn energy_has_the_sources_of_the_case() {
    for (moving, pushed, started, words) in [
        (true, false, false, "The ground motion brings"),
        (false, true, false, "The forces on floors bring"),
        (false, false, true, "The initial motion brings"),
        (
            true,
            true,
            false,
            "The ground motion and forces on floors bring",
        ),
        (
            false,
            true,
            true,
            "The forces on floors and initial motion bring",
        ),
        (
            true,
            true,
            true,
            "The ground motion, forces on floors and initial motion bring",
        ),
    ] {
        let mut result = result();
        for building in &mut result.buildings {
            building.on_moving_ground = moving;
        }
        result.buildings[1].pushed = pushed;
        result.energy.strain[0] = f64::from(u8::from(started));
        let html = is_whole(&page(&result, "pair.h5").unwrap());
        let sentence = format!("<p>{words} 9.980 kJ relative to the ground");
        assert!(html.contains(&sentence), "{sentence}\n{html}");
    }
    // Round-off has no parts.
    let mut still = result();
    still.energy.input.fill(1.0e-12);
    still.residual_ratio = 0.3;
    let html = is_whole(&page(&still, "pair.h5").unwrap());
    assert!(
        html.contains("There is no energy on the output grid"),
        "{html}"
    );
    // Of models as small as that it has.
    still.residual_ratio = 1.0e-14;
    still.energy.viscous.fill(0.75e-12);
    still.energy.impact.fill(0.25e-12);
    still.buildings[0].shear_peaks = peaks([1.1e-12, 0.0], [2.2e-12, 0.0]);
    let html = is_whole(&page(&still, "pair.h5").unwrap());
    for text in [
        "brings 1.000e-15 kJ relative to the ground",
        "storey 1: 1.100e-15 kN, alone 2.200e-15 kN",
        "<td>1.100e-15</td><td>2.200e-15</td><td>0.50</td>",
    ] {
        assert!(html.contains(text), "{text}\n{html}");
    }
}

/// Of a building with a stiffness matrix alone.
#[test]
fn base_moments_stand_in_the_page() {
    let mut result = result();
    result.buildings[1].base_moment = Some(BaseMoment {
        value: 2.5e6,
        time: 4.321,
        isolated: 2.0e6,
    });
    let html = page(&result, "pair.h5").unwrap();
    let html = is_whole(&html);
    let sentence = "overturning moment at the base 1.25 times (2500 kN m, alone 2000 kN m)";
    assert_eq!(html.matches(sentence).count(), 1, "{html}");
    let row = "<td>2500</td><td>4.321</td><td>2000</td><td>1.25</td>";
    assert_eq!(html.matches(row).count(), 1, "{html}");
    // Where the isolated buildings could not be run, there is nothing beside it.
    if let Some(moment) = &mut result.buildings[1].base_moment {
        moment.isolated = f64::NAN;
    }
    let html = is_whole(&page(&result, "pair.h5").unwrap());
    assert!(!html.contains("moment at the base \u{2013}") && !html.contains("NaN"));
    assert!(html.contains("<td>4.321</td><td>\u{2013}</td><td>\u{2013}</td>"));
}

#[test]
fn responses_with_names_stand_in_the_page() {
    let mut result = result();
    result.buildings[0].responses = vec![NamedResponse {
        name: "foundation_rotation".to_owned(),
        unit: "rad".to_owned(),
        value: 1.234e-3,
        time: 5.6,
        isolated: 0.617e-3,
    }];
    result.gaps[0].responses = vec![LevelResponses {
        name: "column_shear_below".to_owned(),
        unit: "N".to_owned(),
        value: vec![f64::NAN, 432.1e3],
        time: vec![f64::NAN, 7.8],
        capacity: vec![f64::NAN, 400.0e3],
    }];
    let html = page(&result, "pair.h5").unwrap();
    let html = is_whole(&html);
    for text in [
        "foundation rotation (mrad)",
        "column shear below (kN)",
        "1.234",
        "0.617",
        "2.00",
    ] {
        assert!(html.contains(text), "{text}");
    }
    for text in ["432.1", "7.800", "400.0", "1.080 (exceeds it)"] {
        assert_eq!(
            html.matches(&format!("<td>{text}</td>")).count(),
            1,
            "{text}"
        );
    }
}

#[test]
fn texts_of_the_case_cannot_break_the_page() {
    let mut result = result();
    result.title = "<img src=x onerror=alert(1)> & \u{0}".to_owned();
    result.case = "# </pre></details><script>".to_owned();
    result.record = "<b>".to_owned();
    result.buildings[1].name = "a\u{2028}b </script><!--".to_owned();
    result.gaps[0].between = format!(
        "{} | {}",
        result.buildings[0].name, result.buildings[1].name
    );
    result.gaps[0].levels[1].label = "<script>alert(1)</script>".to_owned();
    result.warnings = vec!["peak < 0 & \"more\"".to_owned()];
    result.buildings[0].name = "<i>light</i>".to_owned();
    result.gaps[0].name = "</h2>".to_owned();
    let html = page(&result, "<x>.h5").unwrap();
    let html = html.replace("src=x", "");
    let html = is_whole(&html);
    assert!(html.contains("peak &lt; 0 &amp; &quot;more&quot;"));
    assert!(html.contains("&lt;i&gt;light&lt;/i&gt;"));
}

/// Gaps that stay open or have no level, velocity jumps, contacts that outlast the run, a
/// motion of zero: dashes, not NaN.
#[test]
fn what_is_not_known_is_a_dash() {
    let mut silent = result();
    silent.gaps[0].impacts.clear();
    silent.gaps[0].penetration = Table {
        values: vec![-0.015; 1000],
        columns: 2,
    };
    let html = page(&silent, "a.h5").unwrap();
    let html = is_whole(&html);
    assert!(html.contains("stays open"), "{html}");
    assert!(html.contains("15.00 mm of 20.00 mm are left"));

    let mut jumps = result();
    for i in &mut jumps.gaps[0].impacts {
        (i.peak_force, i.peak_force_time) = (f64::NAN, f64::NAN);
        (i.separation_velocity, i.achieved_restitution) = (f64::NAN, f64::NAN);
    }
    jumps.gaps[0].impacts[1].t_open = f64::NAN;
    let html = page(&jumps, "a.h5").unwrap();
    let html = is_whole(&html);
    assert!(html.contains("with an impulse of 4.000 kN s"), "{html}");
    assert!(!html.contains("NaN") && !html.contains(">inf"), "{html}");

    // One that holds floors together after a jump is not the hardest.
    let mut mixed = result();
    (
        mixed.gaps[0].impacts[0].peak_force,
        mixed.gaps[0].impacts[0].impulse,
    ) = (0.0, 9.0e3);
    mixed.gaps[0].impacts[1].peak_force = 1.0e6;
    let html = page(&mixed, "a.h5").unwrap();
    let html = is_whole(&html);
    assert!(
        html.contains("with an impulse of 9.000 kN s at level 2-2"),
        "{html}"
    );
    assert!(html.contains("Velocities jump at impacts"));

    let mut empty = result();
    empty.gaps[0].levels.clear();
    empty.gaps[0].width.clear();
    empty.gaps[0].impacts.clear();
    empty.gaps[0].model.clear();
    empty.gaps[0].penetration = Table::default();
    let zeros = vec![0.0; empty.time.len()];
    empty.ground_acceleration = zeros.clone();
    empty.energy = EnergyHistory {
        input: zeros.clone(),
        kinetic: zeros.clone(),
        strain: zeros.clone(),
        viscous: zeros.clone(),
        hysteretic: zeros.clone(),
        impact: zeros,
    };
    for building in &mut empty.buildings {
        building.displacement_peaks = peaks([0.0; 2], [0.0; 2]);
        building.acceleration_peaks = peaks([2.0; 2], [1.0e-28; 2]);
    }
    let html = page(&empty, "a.h5").unwrap();
    let html = is_whole(&html);
    assert!(
        html.contains("There is no gap with a contact level"),
        "{html}"
    );
    assert!(!html.contains("NaN") && !html.contains(">inf"), "{html}");
}

#[test]
fn files_that_are_no_results() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.h5");
    let error =
        |path: &std::path::Path| RunResult::read(path, WithoutChecksum::Refuse).unwrap_err();
    assert!(matches!(error(&path), ReportError::Unreadable { .. }));
    std::fs::write(&path, "no HDF5").unwrap();
    let found = error(&path);
    assert!(found.to_string().contains("it is not HDF5"), "{found}");
    assert!(found.help().is_some());
    drop(hdf5::File::create(&path).unwrap());
    assert!(error(&path).to_string().contains("no checksum"));
    append(&path).unwrap();
    let found = error(&path);
    assert!(matches!(found, ReportError::NotAResult { .. }), "{found}");
    assert!(matches!(
        error(folder.path()),
        ReportError::Unreadable { .. }
    ));
}

/// Of an input of 10 kJ elastic laws dissipate nothing but round-off, which is a zero, and what is a little more is shown.
#[test]
fn round_off_is_no_energy() {
    let mut result = result();
    for (lost, shown) in [(8.913e-6, "0"), (-3.0e-7, "0"), (2.0e-5, "2.000e-8")] {
        for impact in &mut result.gaps[0].impacts {
            impact.energy_dissipated = lost;
        }
        let html = page(&result, "pair.h5").unwrap();
        let hardest = html.rsplit("The hardest 3 of 3 impacts").next().unwrap();
        let row = hardest.split("</tr>").find(|row| row.contains("1271"));
        let row = row.unwrap();
        assert!(row.ends_with(&format!("<td>{shown}</td>")), "{row}");
    }
}

/// Steps of output are written as `check` and cases write them.
#[test]
fn output_steps_are_decimals() {
    let mut result = result();
    for (step, shown) in [(0.0005, "0.0005"), (0.02, "0.02"), (1.0 / 3.0, "0.333333")] {
        result.time = (0..500).map(|i| step * f64::from(i)).collect();
        let html = page(&result, "pair.h5").unwrap();
        let said = format!("every {shown} s");
        assert!(html.matches(&said).count() >= 2, "{said}");
    }
}
