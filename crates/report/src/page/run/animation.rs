//! Buildings in motion: the picture at one instant, and the numbers that `run.js` moves it by.

use std::collections::BTreeSet;

use pounding_elevation::{Body, MAGNIFICATIONS, SCRIPT, Scene};
use serde_json::{Value, json};

use super::packed::{Kind, packed};
use super::row::row as row_of;
use super::series;
use crate::page::document::Script;
use crate::page::html::escaped;
use crate::result::{BuildingResult, GapResult, ImpactResult, RunResult};

/// Characters that displacements take at most on a page.
const MOST_CHARACTERS: f64 = 1.2e6;
/// Shown before and after an impact that a reader jumps to (s).
const WINDOW: f64 = 0.25;
/// Speeds that a reader can choose.
const SPEEDS: [&str; 7] = ["0.01", "0.02", "0.05", "0.1", "0.25", "0.5", "1"];

/// The section of the moving buildings, and what moves them; nothing for a result without
/// times.
pub(in crate::page) fn animation(result: &RunResult) -> Option<(String, Script)> {
    let scene = Scene::of(&row_of(result));
    if result.time.len() < 2 || result.buildings.is_empty() {
        return None;
    }
    let instant = Instant::of(result);
    let magnification = scene.magnification();
    let picture = picture(result, &scene, (instant, magnification));
    let data = data(result, &scene, (instant, magnification));
    let hint = caption(result, instant, magnification);
    let section = format!(
        "<section>\n<h2>Buildings in motion</h2>\n<figure class=\"elevation\">{picture}\
         <figcaption>{hint}</figcaption></figure>\n{}</section>\n",
        controls(result, magnification)
    );
    let source = format!("{SCRIPT}{}", include_str!("run.js"));
    let script = Script {
        source,
        data,
        may: "",
    };
    Some((section, script))
}

/// The time that the still picture shows: that of the hardest impact, or an output time with the
/// largest displacement where nothing touches.
#[derive(Debug, Clone, Copy)]
struct Instant {
    time: f64,
    /// The output times around it, and how far from the first to the second it is.
    rows: [usize; 2],
    share: f64,
}

impl Instant {
    fn of(result: &RunResult) -> Self {
        if let Some((_, impact)) = hardest(result) {
            let time = match impact.force().is_finite() && impact.peak_force_time.is_finite() {
                true => impact.peak_force_time,
                false => impact.t_close,
            };
            return Self::at(&result.time, time);
        }
        let largest = |row: &usize| {
            let rows = result.buildings.iter().flat_map(|b| floors(b, *row));
            rows.fold(0.0_f64, |m, u| m.max(u.abs()))
        };
        let rows = 0..result.time.len();
        let row = rows.max_by(|a, b| largest(a).total_cmp(&largest(b)));
        Self::at(&result.time, result.time[row.unwrap_or(0)])
    }

    /// This time, or that end of the motion which is nearer.
    fn at(times: &[f64], time: f64) -> Self {
        let last = times.len() - 1;
        let after = times.partition_point(|t| *t <= time).clamp(1, last);
        let rows = [after - 1, after];
        let [first, second] = rows.map(|row| times[row]);
        let share = ((time - first) / (second - first)).clamp(0.0, 1.0);
        Self {
            time: time.clamp(times[0], times[last]),
            rows,
            share: if share.is_finite() { share } else { 0.0 },
        }
    }
}

/// The hardest impact of all gaps, with the gap.
fn hardest(result: &RunResult) -> Option<(usize, &ImpactResult)> {
    let of_gaps = result.gaps.iter().enumerate();
    let hardest = of_gaps.filter_map(|(g, gap)| Some((g, *gap.hardest_first().first()?)));
    let force = |i: &ImpactResult| {
        if i.force().is_finite() {
            i.force()
        } else {
            0.0
        }
    };
    hardest.max_by(|(_, a), (_, b)| {
        let sizes = force(a).total_cmp(&force(b));
        sizes.then(a.impulse.total_cmp(&b.impulse))
    })
}

/// The output time nearest to another.
pub(super) fn nearest(times: &[f64], time: f64) -> usize {
    let after = times.partition_point(|t| *t < time).min(times.len() - 1);
    match after.checked_sub(1) {
        Some(before) if time - times[before] < times[after] - time => before,
        _ => after,
    }
}

/// Displacements of all floors at an output time; nothing where the table ends before.
fn floors(building: &BuildingResult, row: usize) -> impl Iterator<Item = f64> + '_ {
    let columns = building.displacement.columns;
    let values = building.displacement.values.iter().skip(row * columns);
    values.take(columns).copied()
}

/// Whether grounds on both sides of a gap move differently: the picture, whose displacements are relative to
/// each, then has other gaps than the run.
fn on_different_grounds(result: &RunResult) -> bool {
    let responses = result.gaps.iter().flat_map(|g| &g.responses);
    let mut ground = responses.filter(|r| r.name == "relative_ground_displacement");
    ground.any(|r| r.value.iter().any(|u| *u > 0.0))
}

/// From one output time to the next (s), as a case states it: without the round-off of their difference.
fn output_step(result: &RunResult) -> f64 {
    let step = result.time[1] - result.time[0];
    format!("{step:.5e}").parse().unwrap_or(step)
}

fn caption(result: &RunResult, instant: Instant, magnification: f64) -> String {
    format!(
        "Elevation at <span data-part=\"instant\">{:.3}</span> s. Heights are to scale; displacements and \
         gaps are drawn <span data-part=\"factor\">{}</span>. All \
         buildings are drawn equally wide. Displacements are relative to the ground \
         under each building.{}{}",
        instant.time,
        match magnification {
            1.0 => "to scale too".to_owned(),
            times => format!("{times} times as wide as they are"),
        },
        match on_different_grounds(result) {
            true =>
                " The grounds move apart and together, which is left out: gaps are not drawn as wide as they are then.",
            false => "",
        },
        match result.gaps.iter().any(|g| !g.impacts.is_empty()) {
            true => format!(
                " A dot marks a level in contact. Between output times, every {} s, displacements are drawn \
                 straight: floors that touch between two of them may not quite meet.",
                output_step(result)
            ),
            false => String::new(),
        }
    )
}

/// The still picture, whose parts the script moves.
fn picture(result: &RunResult, scene: &Scene, (instant, m): (Instant, f64)) -> String {
    let (margin, reach) = (scene.margin(), m * scene.reach);
    let wide = scene.width + m * scene.offsets + 2.0 * (margin + reach);
    let left = -margin - reach;
    let names = scene.names();
    let mut inside = format!(
        "<path class=\"ground\" data-part=\"ground\" d=\"M{left:.4} {:.4}h{wide:.4}\"/>",
        scene.height
    );
    let contacts = shown_contacts(result, scene);
    for (number, body) in scene.bodies.iter().enumerate() {
        let displacement = displacements(result, body, instant);
        let class = if body.building.is_some() {
            "building"
        } else {
            "wall"
        };
        inside.push_str(&format!(
            "<path class=\"{class}\" data-body=\"{number}\" d=\"{}\"/>",
            outline(scene, body, m, &displacement)
        ));
        let middle = body.left + m * body.offset + 0.5 * body.width;
        let place = match names.turned {
            true => {
                let (x, y) = (middle + 0.35 * names.size, scene.height + 0.5 * margin);
                format!(
                    "class=\"turned\" x=\"{x:.4}\" y=\"{y:.4}\" transform=\"rotate(-90 {x:.4} {y:.4})\""
                )
            }
            false => {
                let y = scene.height + 0.3 * margin + names.size;
                format!("x=\"{middle:.4}\" y=\"{y:.4}\"")
            }
        };
        inside.push_str(&format!(
            "<text data-name=\"{number}\" {place} font-size=\"{:.4}\"><title>{}</title>{}</text>",
            names.size,
            escaped(&body.name),
            escaped(&names.shown[number])
        ));
    }
    for (number, contact) in contacts.iter().enumerate() {
        let contact = &scene.contacts[*contact];
        let side = |which: usize| {
            let body = &scene.bodies[contact.between[which]];
            let wide = if which == 0 { body.width } else { 0.0 };
            let u = at(
                body,
                &displacements(result, body, instant),
                contact.elevations[which],
            );
            body.left + wide + m * (body.offset + u)
        };
        let right = side(1) - m * contact.ahead;
        let [zl, zr] = contact.elevations.map(|z| scene.height - z);
        let gap = &result.gaps[contact.place.0];
        let closed = gap.impacts.iter().any(|i| {
            i.level == contact.place.1 as u64 + 1
                && i.t_close <= instant.time
                && !(i.t_open < instant.time)
        });
        inside.push_str(&format!(
            "<path class=\"edge\" data-edge=\"{number}\" d=\"{}\"/>\
             <circle class=\"contact{}\" data-contact=\"{number}\" cx=\"{:.4}\" cy=\"{:.4}\" r=\"{:.4}\"/>",
            match contact.ahead > 0.0 {
                true => format!("M{:.4} {zr:.4}H{right:.4}", side(1)),
                false => String::new(),
            },
            if closed { " closed" } else { "" },
            0.5 * (side(0) + right),
            0.5 * (zl + zr),
            0.02 * scene.height,
        ));
    }
    let all: Vec<&str> = scene.bodies.iter().map(|b| b.name.as_str()).collect();
    let words = escaped(&format!(
        "Elevation of {} from left to right, with the displacements of their floors",
        all.join(", ")
    ));
    format!(
        "<svg role=\"img\" aria-label=\"{words}\" data-part=\"elevation\" xmlns=\"http://www.w3.org/2000/svg\" \
         viewBox=\"{left:.4} {:.4} {wide:.4} {:.4}\">{inside}</svg>\n",
        -margin,
        scene.height + margin + names.below,
    )
}

/// Displacements of the ground and the floors of a body (m), straight between output times.
fn displacements(result: &RunResult, body: &Body, instant: Instant) -> Vec<f64> {
    match body.building {
        Some(building) => {
            let building = &result.buildings[building];
            let [before, after] = instant.rows.map(|row| floors(building, row));
            let floors = before
                .zip(after)
                .map(|(before, after)| before + instant.share * (after - before));
            std::iter::once(0.0).chain(floors).collect()
        }
        None => vec![0.0; body.elevation.len() + 1],
    }
}

/// The displacement of a body at an elevation, straight between its floors.
fn at(body: &Body, displacement: &[f64], elevation: f64) -> f64 {
    let z: Vec<f64> = std::iter::once(0.0)
        .chain(body.elevation.iter().copied())
        .collect();
    let above = z.partition_point(|z| *z < elevation).clamp(1, z.len() - 1);
    let part = (elevation - z[above - 1]) / (z[above] - z[above - 1]);
    let of = |i: usize| displacement.get(i).copied().unwrap_or(0.0);
    of(above - 1) + part.clamp(0.0, 1.0) * (of(above) - of(above - 1))
}

/// Outline and floors of a body as the data of a path: its left side from the ground up comes first.
fn outline(scene: &Scene, body: &Body, m: f64, displacement: &[f64]) -> String {
    let rest = body.left + m * body.offset;
    let elevations = std::iter::once(0.0).chain(body.elevation.iter().copied());
    let points: Vec<(f64, f64)> = elevations
        .zip(displacement)
        .map(|(z, u)| (rest + m * u, scene.height - z))
        .collect();
    let line = |points: Vec<(f64, f64)>| {
        let points = points.iter().map(|(x, y)| format!("{x:.6} {y:.4}"));
        points.collect::<Vec<_>>().join(" L")
    };
    let right: Vec<_> = points
        .iter()
        .rev()
        .map(|(x, y)| (x + body.width, *y))
        .collect();
    let floors: String = points[1..]
        .iter()
        .map(|(x, y)| format!("M{x:.6} {y:.4}h{:.4}", body.width))
        .collect();
    format!("M{} L{}Z{floors}", line(points.clone()), line(right))
}

/// Contacts that the picture has: of levels that are hit, or all where none is.
pub(super) fn shown_contacts(result: &RunResult, scene: &Scene) -> Vec<usize> {
    let hit = |c: &usize| {
        let (gap, level) = scene.contacts[*c].place;
        let mut impacts = result.gaps[gap].impacts.iter();
        impacts.any(|i| i.level == level as u64 + 1)
    };
    (0..scene.contacts.len()).filter(hit).collect()
}

/// What the script reads.
fn data(result: &RunResult, scene: &Scene, (instant, magnification): (Instant, f64)) -> Value {
    let shown = shown_contacts(result, scene);
    let (frames, kind) = frames(result, instant);
    let times: Vec<f64> = frames.iter().map(|k| result.time[*k]).collect();
    let displacement = |body: &Body| {
        body.building.map(|b| {
            let rows = frames.iter().flat_map(|k| floors(&result.buildings[b], *k));
            packed(&rows.collect::<Vec<f64>>(), kind)
        })
    };
    let named = |c: &usize| {
        let (gap, level) = scene.contacts[*c].place;
        (*c, series::name(result, gap, level))
    };
    let place_of =
        &|place: (usize, usize)| shown.iter().position(|c| scene.contacts[*c].place == place);
    let of_gaps = result.gaps.iter().enumerate();
    let impacts = of_gaps.flat_map(|(g, gap)| {
        let impacts = gap.impacts.iter();
        impacts.filter_map(move |i| Some((place_of((g, i.level as usize - 1))?, i)))
    });
    let mut impacts: Vec<(usize, &ImpactResult)> = impacts.collect();
    impacts.sort_by(|a, b| a.1.t_close.total_cmp(&b.1.t_close));
    let column = |of: fn(&ImpactResult) -> f64, kind: Kind| {
        let values: Vec<f64> = impacts.iter().map(|(_, i)| of(i)).collect();
        packed(&values, kind)
    };
    let hardest = hardest(result).and_then(|(g, i)| place_of((g, i.level as usize - 1)));
    json!({
        "time": instant.time,
        "contact": hardest,
        "step": result.time[1] - result.time[0],
        "window": WINDOW,
        "scene": scene.json(shown.iter().map(named)),
        "magnification": magnification,
        "frames": packed(&times, Kind::Float64),
        "displacements": scene.bodies.iter().map(displacement).collect::<Vec<_>>(),
        "impacts": {
            "contact": impacts.iter().map(|(contact, _)| *contact).collect::<Vec<usize>>(),
            "closes": column(|i| i.t_close, Kind::Float64),
            "opens": column(|i| i.t_open, Kind::Float64),
            "peak": column(|i| i.peak_force_time, Kind::Float64),
            "force": column(ImpactResult::force, Kind::Float32),
            "impulse": column(|i| i.impulse, Kind::Float32),
        },
        "series": series::all(result, place_of),
    })
}

/// Output times that the animation has, and how displacements are written: all of them if
/// they fit on the page, or those next to the hardest impacts and even steps between.
fn frames(result: &RunResult, still: Instant) -> (Vec<usize>, Kind) {
    let floors: usize = result
        .buildings
        .iter()
        .map(|b| b.displacement.columns)
        .sum();
    let rows = |b: &BuildingResult| b.displacement.values.len() / b.displacement.columns.max(1);
    let count = result
        .buildings
        .iter()
        .map(rows)
        .fold(result.time.len(), usize::min);
    for kind in [Kind::Float32, Kind::Int16] {
        let most = most_frames(floors, kind);
        if count <= most {
            return ((0..count).collect(), kind);
        }
    }
    let most = most_frames(floors, Kind::Int16).max(2);
    let mut chosen: BTreeSet<usize> = [0, count - 1].into();
    chosen.extend(still.rows.map(|row| row.min(count - 1)));
    let mut impacts: Vec<&ImpactResult> = result.gaps.iter().flat_map(|g| &g.impacts).collect();
    let size = |i: &ImpactResult| i.force().max(0.0);
    impacts.sort_by(|a, b| size(b).total_cmp(&size(a)));
    for impact in impacts {
        if chosen.len() >= most / 3 {
            break;
        }
        chosen.insert(nearest(&result.time, impact.t_close).min(count - 1));
    }
    let even = most.saturating_sub(chosen.len()).max(2);
    chosen.extend((0..even).map(|i| i * (count - 1) / (even - 1)));
    (chosen.into_iter().collect(), Kind::Int16)
}

fn most_frames(floors: usize, kind: Kind) -> usize {
    let size = floors as f64 * kind.size() + Kind::Float64.size();
    (MOST_CHARACTERS / size) as usize
}

/// What moves the picture: hidden where no script runs.
fn controls(result: &RunResult, magnification: f64) -> String {
    let options = |values: &[String], chosen: &str| -> String {
        let option = |value: &String| {
            let selected = if value == chosen { " selected" } else { "" };
            format!("<option value=\"{value}\"{selected}>{value}</option>")
        };
        values.iter().map(option).collect()
    };
    let speeds: Vec<String> = SPEEDS.map(str::to_owned).to_vec();
    let magnifications: Vec<String> = MAGNIFICATIONS.map(|m| m.to_string()).to_vec();
    let (first, last) = (result.time[0], result.time[result.time.len() - 1]);
    let (heading, hidden) = match result.gaps.iter().any(|gap| !gap.impacts.is_empty()) {
        true => ("Around an impact", ""),
        false => ("Motion over time", " hidden"),
    };
    format!(
        "<div class=\"controls live\" role=\"group\" aria-label=\"Motion\" hidden>\n\
         <button type=\"button\" data-part=\"play\">Play</button>\n\
         <label>Speed <select data-part=\"speed\">{}</select></label>\n\
         <label>Displacements times <select data-part=\"magnification\">{}</select></label>\n\
         <button type=\"button\" data-part=\"previous\"{hidden}>Previous impact</button>\n\
         <button type=\"button\" data-part=\"next\"{hidden}>Next impact</button>\n\
         <label class=\"whole\">Time <input type=\"range\" data-part=\"time\" min=\"{first}\" max=\"{last}\" step=\"any\">\
         <output data-part=\"now\"></output></label>\n\
         <label class=\"whole\" data-part=\"jump\">Jump to impact <select data-part=\"impacts\" size=\"6\"></select></label>\n\
         </div>\n\
         <div class=\"chart live\" data-part=\"history\" hidden>\n<h3>{heading}</h3>\n\
         <div class=\"controls\" role=\"group\" aria-label=\"Range of the histories\">\n\
         <label>Level <select data-part=\"level\"></select></label>\n\
         <button type=\"button\" data-part=\"closer\">Zoom in</button>\n\
         <button type=\"button\" data-part=\"farther\">Zoom out</button>\n\
         <button type=\"button\" data-part=\"earlier\">Earlier</button>\n\
         <button type=\"button\" data-part=\"later\">Later</button>\n\
         <button type=\"button\" data-part=\"everything\">Whole motion</button>\n</div>\n\
         <svg data-part=\"chart\" tabindex=\"0\" role=\"img\" aria-label=\"\" xmlns=\"http://www.w3.org/2000/svg\"></svg>\n\
         <p class=\"note\">{} With the curves in focus: arrow keys move, + and - zoom, Home shows the whole motion; a click sets the time above.</p>\n</div>\n",
        options(&speeds, "0.1"),
        options(&magnifications, &magnification.to_string()),
        note(result),
    )
}

/// What the curves pass through.
fn note(result: &RunResult) -> String {
    let step = output_step(result);
    if result.gaps.iter().all(|gap| gap.impacts.is_empty()) {
        return format!(
            "Values at output times, every {step} s: the extremes of each part of the motion."
        );
    }
    let force = match result.gaps.iter().any(GapResult::jumps) {
        true => "the peak of its force, or its impulse as a line where velocities jump",
        false => "the peak of its force",
    };
    format!(
        "Every impact as its list has it, with closing, opening and {force}, and values at output times, every \
         {step} s: all of them around impacts, and the extremes of each part of the motion elsewhere. Distances are \
         those of output times, and zero where a gap closes and throughout contacts between two of them."
    )
}
