//! Storeys with laws, and links.

use pounding_assembly::UsedParameters;
use pounding_case::Case;
use pounding_catalogue::numbers::{fixed, fixed_or_small, shown_unit, significant, six_digits};
use pounding_hysteresis::{LawDescriptor, Verification};
use pounding_shear_building::ShearBuilding;
use pounding_time_history::{Element, LinkedMotion, Peak, System};

use super::{Run, decimal, new_table};

/// What the storeys with laws of a building went through; empty without any.
pub(super) fn storeys(run: &Run<'_>, index: usize) -> String {
    let outcome = &run.outcome.buildings[index];
    if !outcome.frames.is_empty() {
        return frames(run, index);
    }
    if outcome.yielding.iter().all(Option::is_none) {
        return String::new();
    }
    let mut table = new_table([
        "storey",
        "law",
        "ductility",
        "residual drift ratio (%)",
        "hysteretic energy (kJ)",
    ]);
    for (i, storey) in outcome.yielding.iter().enumerate().rev() {
        let Some(s) = storey else { continue };
        table.add_row([
            (i + 1).to_string(),
            s.law.to_owned(),
            ratio(s.ductility),
            format!("{:.3}", 100.0 * s.residual_drift_ratio),
            kilojoules(s.hysteretic_energy, run.outcome.energy.largest_input, 3),
        ]);
    }
    let building = &run.system().buildings()[index];
    format!("{table}\n{}", sources(descriptors(building)))
}

/// What the frames with laws of a building went through that turns in plan.
fn frames(run: &Run<'_>, index: usize) -> String {
    let mut table = new_table([
        "storey",
        "frame",
        "law",
        "force (kN)",
        "ductility",
        "residual deformation (mm)",
        "hysteretic energy (kJ)",
    ]);
    for frame in run.outcome.buildings[index].frames.iter().rev() {
        table.add_row([
            frame.storey.to_string(),
            format!("{} at {} m", frame.direction, six_digits(frame.at)),
            frame.law.to_owned(),
            format!(
                "{} @{:.2}",
                decimal(1e-3 * frame.force.value, 1),
                frame.force.time
            ),
            ratio(frame.ductility),
            fixed(1e3 * frame.residual_deformation, 3),
            kilojoules(frame.hysteretic_energy, run.outcome.energy.largest_input, 3),
        ]);
    }
    let building = &run.system().buildings()[index];
    format!("{table}\n{}", sources(descriptors(building)))
}

/// Part of the largest input energy below which a part of it may look like none.
const SMALL_PART: f64 = 1e-4;

/// Energy (J) of a run with this largest input energy, in kJ with so many decimals; what is
/// round-off has no sign.
pub(super) fn kilojoules(energy: f64, largest_input: f64, decimals: usize) -> String {
    let shown = energy * 1e-3;
    match energy.abs() < SMALL_PART * largest_input {
        true => fixed(shown, decimals),
        false => fixed_or_small(shown, decimals),
    }
}

fn ratio(peak: Option<Peak>) -> String {
    peak.map_or_else(
        || "-".to_owned(),
        |p| format!("{:.2} @{:.2}", p.value, p.time),
    )
}

/// What a link went through.
pub(super) fn link(run: &Run<'_>, index: usize) -> String {
    let outcome = &run.outcome.links[index];
    let system = run.system();
    let joins = system.links()[index].joins;
    let [(length, length_unit), (force, force_unit)] = joins.units().map(shown_unit);
    let mut table = new_table([
        "level".to_owned(),
        "elevations (m)".to_owned(),
        format!("deformation ({length_unit})"),
        format!("{} ({force_unit})", of_force(joins)),
        "ductility".to_owned(),
        format!("deformation at the end ({length_unit})"),
        "energy lost (kJ)".to_owned(),
    ]);
    for (l, place) in outcome.levels.iter().zip(system.link_levels(index)).rev() {
        table.add_row([
            place.label(),
            place.elevations_label(),
            format!(
                "{} @{:.2}",
                decimal(l.deformation.value * length, 2),
                l.deformation.time
            ),
            format!("{} @{:.2}", decimal(l.force.value * force, 1), l.force.time),
            ratio(l.ductility),
            fixed(l.final_deformation * length, 2),
            kilojoules(l.energy_dissipated, run.outcome.energy.largest_input, 3),
        ]);
    }
    let descriptors = elements(system, index).iter().map(|e| e.law.descriptor());
    format!(
        "\nLink {} ({}): peak @time (s)\n{table}\n{}",
        outcome.name,
        outcome.law,
        sources(descriptors)
    )
}

/// What a link carries.
fn of_force(joins: LinkedMotion) -> &'static str {
    match joins {
        LinkedMotion::FoundationRotation => "moment",
        _ => "force",
    }
}

fn elements(system: &System, link: usize) -> &[Element] {
    let link = &system.links()[link];
    &system.elements()[link.first_element..link.first_element + link.levels]
}

fn descriptors(building: &ShearBuilding) -> impl Iterator<Item = &'static LawDescriptor> {
    building.all_laws().map(|l| l.law.descriptor())
}

/// The lines of laws whose rules were not read in their papers, each law once.
fn sources(descriptors: impl Iterator<Item = &'static LawDescriptor>) -> String {
    let mut text = String::new();
    let mut reported: Vec<&str> = Vec::new();
    for descriptor in descriptors {
        if let Verification::SecondarySources(how) = descriptor.verification
            && !reported.contains(&descriptor.name)
        {
            reported.push(descriptor.name);
            text.push_str(&format!(
                "{} is from secondary sources: {how}\n",
                descriptor.name
            ));
        }
    }
    text
}

/// What `check` says of the parameters of a gap or a link, which has those of its levels: once where
/// all have the same.
pub(super) fn parameters(all: &[(String, UsedParameters)]) -> String {
    let same = all.windows(2).all(|pair| pair[0].1 == pair[1].1);
    match (same, all.first()) {
        (_, None) => String::new(),
        (true, Some((_, parameters))) => match parameters.to_string() {
            none if none.is_empty() => none,
            parameters => format!("parameters: {parameters}\n"),
        },
        (false, _) => {
            let line = |(level, parameters)| format!("level {level}: {parameters}\n");
            all.iter().map(|(level, p)| line((level, p))).collect()
        }
    }
}

/// What `check` says of the laws of a building with their parameters by storey, of those of its frames, and of gravity.
pub(super) fn laws(
    building: &ShearBuilding,
    [parameters, of_frames]: [&[(usize, UsedParameters)]; 2],
) -> String {
    let mut text = String::new();
    for (frame, (_, parameters)) in building.yielding_frames().iter().zip(of_frames) {
        let yields = frame.law.yield_drift.map_or_else(String::new, |y| {
            format!(", yields at a deformation of {:.3} mm", y * 1e3)
        });
        let law = frame.law.law.descriptor().name;
        text.push_str(&format!("{frame}: law {law}{yields}: {parameters}\n"));
    }
    for (i, law) in building.laws().iter().enumerate() {
        let Some(law) = law else { continue };
        let yields = law.yield_drift.map_or_else(String::new, |y| {
            format!(", yields at a drift of {:.3} mm", y * 1e3)
        });
        let of = parameters.iter().find(|(storey, _)| *storey == i);
        let of = of.map_or_else(String::new, |(_, parameters)| parameters.to_string());
        let of = if of.is_empty() { of } else { format!(": {of}") };
        text.push_str(&format!(
            "storey {}: law {}{yields}{of}\n",
            i + 1,
            law.law.descriptor().name
        ));
    }
    text.push_str(&gravity(building));
    text.push_str(&sources(descriptors(building)));
    text
}

/// What `check` says of gravity: what it takes off the storey stiffnesses, or off the stiffness
/// of the first mode where there is a matrix.
fn gravity(building: &ShearBuilding) -> String {
    let geometric = building.geometric_stiffness();
    if geometric.iter().all(|g| *g == 0.0) {
        return String::new();
    }
    let shares = geometric.iter().zip(building.stiffness());
    let taken = match shares.map(|(g, k)| g / k).reduce(f64::max) {
        Some(share) => format!("up to {:.2} % off a storey stiffness", 100.0 * share),
        None => format!(
            "{:.2} % off the stiffness of the first mode",
            100.0 * share_of_first_mode(building)
        ),
    };
    format!("P-Delta: gravity takes {taken}; periods include it\n")
}

/// What gravity takes off the stiffness of the first mode, over that stiffness without
/// gravity (-): by the shape of the mode with gravity.
fn share_of_first_mode(building: &ShearBuilding) -> f64 {
    let shape = building.modes().shape.column(0);
    let frequency = building.modes().circular_frequency[0];
    let masses = shape.iter().zip(building.inertia());
    let mass: f64 = masses.map(|(u, m)| m * u * u).sum();
    let left = frequency * frequency * mass;
    if let Some(matrix) = building.geometric_matrix() {
        let taken = shape.dot(&(matrix * shape));
        return taken / (taken + left);
    }
    // The base of the first storey moves with the foundation.
    let sway = building.foundation().and_then(|on| on.matrices().sway());
    let mut below = sway.map_or(0.0, |i| shape[i]);
    let mut taken = 0.0;
    for (u, k) in shape.iter().zip(building.geometric_stiffness()) {
        taken += k * (u - below) * (u - below);
        below = *u;
    }
    taken / (taken + left)
}

/// What the event-driven method does where a storey or a link follows a law.
pub(super) fn in_place_of_exact_steps(case: &Case, system: &System) -> &'static str {
    let curved = system.first_curved_element().is_some();
    if case.analysis.method.value == "event_driven" && curved {
        " (by the adaptive pair 8(5,3), since laws of storeys or links are not linear between changes of branch)"
    } else {
        ""
    }
}

/// What `check` says of links, with the parameters of their levels.
pub(super) fn links(system: &System, used: &[Vec<UsedParameters>]) -> String {
    let mut text = String::new();
    for (index, link) in system.links().iter().enumerate() {
        let joins = link.joins;
        let [length, force] = joins.units();
        let (factor, length_unit) = shown_unit(length);
        let mut table = new_table([
            "level".to_owned(),
            "elevations (m)".to_owned(),
            "law".to_owned(),
            format!("initial stiffness ({force}/{length})"),
            format!("yields at ({length_unit})"),
        ]);
        let places = system.link_levels(index);
        for (element, place) in elements(system, index).iter().zip(places) {
            table.add_row([
                place.label(),
                place.elevations_label(),
                element.law.descriptor().name.to_owned(),
                significant(element.law.initial_stiffness()),
                element
                    .yield_deformation
                    .map_or_else(|| "-".to_owned(), |y| format!("{:.3}", y * factor)),
            ]);
        }
        text.push_str(&format!("\nLink {}\n{table}\n", link.name));
        let labels = system.link_levels(index).into_iter().map(|p| p.label());
        let of_levels = used.get(index).into_iter().flatten().cloned();
        let all: Vec<_> = labels.zip(of_levels).collect();
        text.push_str(&parameters(&all));
        let descriptors = elements(system, index).iter().map(|e| e.law.descriptor());
        text.push_str(&sources(descriptors));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zero_has_no_sign() {
        for (energy, text) in [(-1e-9, "0.000"), (0.4, "0.000"), (-2.0, "-0.002")] {
            assert_eq!(kilojoules(energy, 5e3, 3), text);
        }
        // Of a run that has no more.
        assert_eq!(kilojoules(0.4, 2.0, 3), "4.00e-4");
        assert_eq!(kilojoules(0.0, 0.0, 3), "0.000");
    }
}
