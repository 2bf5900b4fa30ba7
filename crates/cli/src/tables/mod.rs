//! Tables that an engineer can read.

mod collapsed;
mod elements;
mod foundation;
mod isolators;
mod width;

use comfy_table::{CellAlignment, Row};
use pounding_assembly::{
    Assembly, parameters_of_frames, parameters_of_gap, parameters_of_link, parameters_of_storeys,
};
use pounding_case::{Case, CaseError};
use pounding_catalogue::numbers::{fixed_or_small, shown_unit, six_digits};
use pounding_catalogue::wording::counted;
use pounding_gap_element::Verification;
use pounding_time_history::{
    ContactLevel, LevelOutcome, NamedPeak, Outcome, Peak, System, VELOCITY_JUMPS,
};

pub use collapsed::collapsed;
use elements::kilojoules;
pub use width::{Table, paragraphs, width};

/// The unit of accelerations on the screen (m/s2).
pub use pounding_catalogue::STANDARD_GRAVITY as G;

/// A run that has ended, to be shown.
pub struct Run<'a> {
    /// What was asked for.
    pub case: &'a Case,
    /// What was made of it.
    pub assembly: &'a Assembly,
    /// Result of the run.
    pub outcome: &'a Outcome,
    /// Result of the same buildings without gaps.
    pub isolated: &'a Outcome,
    /// Warnings of the record and of the run.
    pub warnings: &'a [String],
    /// Wall-clock time of the run (s).
    pub wall_time: f64,
}

impl Run<'_> {
    fn system(&self) -> &System {
        &self.assembly.system
    }
}

/// The report at the end of a run.
pub fn report(run: &Run<'_>) -> String {
    let mut text = String::new();
    if !run.case.title.is_empty() {
        text.push_str(&format!("{}\n", run.case.title));
    }
    for line in run.assembly.excitation() {
        text.push_str(&format!("  {line}\n"));
    }
    text.push_str(&warning_lines(run.warnings));
    for index in 0..run.outcome.buildings.len() {
        text.push_str(&building(run, index));
        text.push_str(&elements::storeys(run, index));
        text.push_str(&isolators::run(run, index));
    }
    for index in 0..run.outcome.gaps.len() {
        text.push_str(&gap(run, index));
    }
    for index in 0..run.outcome.links.len() {
        text.push_str(&elements::link(run, index));
    }
    text.push_str(&energy(run));
    text
}

/// Warnings, a line each.
pub fn warning_lines(warnings: &[impl std::fmt::Display]) -> String {
    warnings.iter().map(|w| format!("warning: {w}\n")).collect()
}

/// What "isolated" means in a gap check and in a comparison of a case with links.
pub fn links_stay(case: &Case) -> &'static str {
    match case.links.is_empty() {
        true => "",
        false => "  links stay in place in all that follows: \"isolated\" means without contact\n",
    }
}

/// A table whose columns stand at the right.
pub fn new_table(header: impl Into<Row>) -> Table {
    let mut table = Table::new();
    table.set_header(header);
    for column in table.column_iter_mut() {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

/// The same without lines between rows, for long tables.
pub fn new_long_table(header: impl Into<Row>) -> Table {
    let mut table = new_table(header);
    table.load_style(comfy_table::presets::ASCII_MARKDOWN);
    table
}

/// A number with this many decimals, or by its power of ten where it is long or would look like a zero.
pub fn decimal(x: f64, digits: usize) -> String {
    if x.is_finite() && x.abs() >= 1e7 {
        format!("{x:.digits$e}")
    } else {
        fixed_or_small(x, digits)
    }
}

/// Value, time, and ratio to the isolated building.
fn cell(p: Peak, isolated: Peak, factor: f64, digits: usize) -> String {
    let ratio = if isolated.value > 0.0 {
        format!("x{}", decimal(p.value / isolated.value, 2))
    } else {
        "-".to_owned()
    };
    let value = decimal(p.value * factor, digits);
    format!("{value} @{:.2} {ratio}", p.time)
}

fn building(run: &Run<'_>, index: usize) -> String {
    let (with, isolated) = (
        &run.outcome.buildings[index],
        &run.isolated.buildings[index],
    );
    let mut table = new_table([
        "storey",
        "displacement (mm)",
        "drift ratio (%)",
        "storey shear (kN)",
        "absolute acceleration (g)",
    ]);
    for (i, (a, b)) in with.storeys.iter().zip(&isolated.storeys).enumerate().rev() {
        table.add_row([
            (i + 1).to_string(),
            cell(a.displacement, b.displacement, 1e3, 2),
            cell(a.drift_ratio, b.drift_ratio, 1e2, 3),
            cell(a.storey_shear, b.storey_shear, 1e-3, 1),
            cell(a.acceleration_absolute, b.acceleration_absolute, 1.0 / G, 3),
        ]);
    }
    let base = with.base_moment.zip(isolated.base_moment);
    let base = base.map_or_else(String::new, |(a, b)| {
        let moment = cell(a, b, 1e-3, 1);
        format!("overturning moment at the base (kN m): {moment}\n")
    });
    let mut responses = new_long_table(["response", "unit", "peak"]);
    for (a, b) in with.responses.iter().zip(&isolated.responses) {
        let (factor, unit) = shown_unit(a.unit);
        let peak = cell(a.peak, b.peak, factor, 3);
        responses.add_row([a.name.replace('_', " "), unit.to_owned(), peak]);
    }
    let responses = match with.responses.is_empty() {
        true => String::new(),
        false => format!("{responses}\n"),
    };
    let other = match with.isolator {
        // Here that word says something else.
        Some(_) => "the building without gaps and links",
        None => "the isolated building",
    };
    format!(
        "\nBuilding {}: peak @time (s), x ratio to {other}\n{table}\n{base}{responses}",
        with.name
    )
}

fn gap(run: &Run<'_>, index: usize) -> String {
    let outcome = &run.outcome.gaps[index];
    let system = run.system();
    let gap = &system.gaps()[index];
    let levels = system.levels_of(gap);
    let model = levels.first().map_or("", |l| l.model.descriptor().name);
    let total: usize = outcome.levels.iter().map(|l| l.impacts).sum();
    if total == 0 {
        return format!(
            "\nGap {} ({model}): the buildings do not touch\n{}",
            gap.name,
            isolators::clearances(&outcome.levels, levels)
        );
    }
    let rigid = levels.iter().any(|l| l.model.rigid_restitution().is_some());
    let mut table = new_table([
        "level at (m)",
        "gap (mm)",
        "impacts",
        "first contact (s)",
        "approach velocity (m/s)",
        if rigid {
            "maximum impulse (kN s)"
        } else {
            "peak force (kN)"
        },
        "energy lost (kJ)",
        "restitution",
    ]);
    for (l, at) in outcome.levels.iter().zip(levels).rev() {
        let or_dash = |x: Option<String>| x.unwrap_or_else(|| "-".to_owned());
        table.add_row([
            format!("{} at {}", at.place.label(), at.place.elevations_label()),
            decimal(at.width * 1e3, 1),
            l.impacts.to_string(),
            or_dash(l.first_contact.map(|t| format!("{t:.4}"))),
            decimal(l.approach_velocity_max, 3),
            match l.impacts {
                0 => "-".to_owned(),
                _ if rigid => decimal(l.impulse_max * 1e-3, 2),
                _ => format!(
                    "{} @{:.2}",
                    decimal(l.peak_force.value * 1e-3, 1),
                    l.peak_force.time
                ),
            },
            kilojoules(l.energy_dissipated, run.outcome.energy.largest_input, 2),
            or_dash(l.achieved_restitution.map(|e| format!("{e:.3}"))),
        ]);
    }
    let total = counted(total, "impact");
    let mut text = format!("\nGap {} ({model}): {total}\n{table}\n", gap.name);
    text.push_str(&secondary_sources(levels));
    if rigid {
        text.push_str(&format!("{VELOCITY_JUMPS}\n"));
    }
    text.push_str(driven_contacts(
        &outcome.levels,
        run.outcome.energy.largest_input,
    ));
    text.push_str(&held_and_widened(&outcome.levels, levels));
    text.push_str(&isolators::clearances(&outcome.levels, levels));
    text.push_str(&level_responses(&outcome.levels, levels));
    text
}

/// Part of the largest input energy that round-off may leave of nothing lost.
const ROUND_OFF: f64 = 1.0e-9;

/// What a restitution is that the model of the contact cannot have: above one, or below it where nothing is lost.
fn driven_contacts(levels: &[LevelOutcome], largest_input: f64) -> &'static str {
    let is_driven = |level: &LevelOutcome| {
        let lossless = level.energy_dissipated.abs() <= ROUND_OFF * largest_input;
        let restitution = level.achieved_restitution;
        restitution.is_some_and(|e| e > 1.005 || (lossless && e < 0.995))
    };
    match levels.iter().any(is_driven) {
        true => {
            "restitution: how fast floors part over how fast they met. Buildings and ground push them while they touch, so that it is not that of the contact\n"
        }
        false => "",
    }
}

/// What the levels bear beside contact forces, the top first.
fn level_responses(levels: &[LevelOutcome], places: &[ContactLevel]) -> String {
    let mut text = String::new();
    for (l, at) in levels.iter().zip(places).rev() {
        for response in &l.responses {
            let ((factor, unit), peak) = (shown_unit(response.unit), response.peak);
            let digits = if unit == "mm" { 3 } else { 1 };
            text.push_str(&format!(
                "Level {}: {} {} {unit} at {:.2} s{}\n",
                at.place,
                response.name.replace('_', " "),
                decimal(peak.value * factor, digits),
                peak.time,
                against_capacity(response)
            ));
        }
    }
    text
}

/// How a response stands to the capacity for it, if that is known.
pub fn against_capacity(response: &NamedPeak) -> String {
    let Some((capacity, ratio)) = response.capacity.zip(response.demand_ratio()) else {
        return String::new();
    };
    let (factor, unit) = shown_unit(response.unit);
    format!(
        ", {} the capacity of {} {unit}: demand over capacity {}",
        if ratio > 1.0 {
            "exceeds"
        } else {
            "stays below"
        },
        decimal(capacity * factor, 1),
        decimal(ratio, 2)
    )
}

/// The line of a model whose formula or constants were not read in its paper.
fn secondary_sources(levels: &[ContactLevel]) -> String {
    let descriptor = levels.first().map(|l| l.model.descriptor());
    match descriptor.map(|d| (d.name, d.verification)) {
        Some((name, Verification::SecondarySources(how))) => {
            format!("{name} is from secondary sources: {how}\n")
        }
        _ => String::new(),
    }
}

/// Lasting contacts with the maximum force that they held, and widened gaps.
fn held_and_widened(levels: &[LevelOutcome], places: &[ContactLevel]) -> String {
    let mut text = String::new();
    for (l, at) in levels.iter().zip(places) {
        let level = at.place;
        if l.sticks > 0 {
            let times = counted(l.sticks, "time");
            text.push_str(&match l.peak_force.value > 0.0 {
                true => format!(
                    "Level {level}: floors held together {times}, maximum contact force {:.1} kN at {:.2} s\n",
                    l.peak_force.value * 1e-3,
                    l.peak_force.time
                ),
                // An impact that returns nothing, after which they part at once.
                false => format!(
                    "Level {level}: floors held together {times} for an instant, without a contact force\n"
                ),
            });
        }
        if l.gap_widening > 0.0 {
            text.push_str(&format!(
                "Level {level}: plastic deformation widened the gap by {:.2} mm\n",
                l.gap_widening * 1e3
            ));
        }
    }
    text
}

fn energy(run: &Run<'_>) -> String {
    let (e, statistics) = (run.outcome.energy, run.outcome.statistics);
    let gravity = run.system().buildings().iter();
    let gravity = gravity
        .flat_map(|b| b.geometric_stiffness())
        .any(|k| *k > 0.0);
    let strain = if gravity {
        "strain less work of gravity"
    } else {
        "strain"
    };
    let part = |energy: f64| kilojoules(energy, e.largest_input, 3);
    let hysteretic = if run.system().elements().is_empty() {
        String::new()
    } else {
        format!("hysteretic {} + ", part(e.end.hysteretic))
    };
    format!(
        "\nEnergy at {} s (kJ): input {} = viscous {} + {}impact {} + kinetic {} + {} {}; residual {:.1e} of the largest input\n{}: {}, {} rejected, {}; {:.2} s\n",
        six_digits(run.outcome.end_time),
        part(e.end.input),
        part(e.end.viscous),
        hysteretic,
        part(e.end.impact),
        part(e.end.kinetic),
        strain,
        part(e.end.strain),
        e.residual_ratio,
        run.outcome.method.title,
        counted(statistics.steps, "step"),
        statistics.rejected,
        counted(statistics.events, "event"),
        run.wall_time,
    )
}

/// A line for each level at which columns are hit.
fn hit_columns(system: &System, levels: &[ContactLevel]) -> String {
    let mut text = String::new();
    for level in levels {
        let Some(side) = (0..2).find(|side| system.is_column(level, *side)) else {
            continue;
        };
        let Some((building, storey)) = system.storey_of(level.between[side]) else {
            continue;
        };
        let b = &system.buildings()[building];
        let below = storey.checked_sub(1).map_or(0.0, |s| b.elevations()[s]);
        let point = match level.model.spring_behind() {
            Some(stiffness) => format!(
                "a point without mass behind which the columns give {} MN/m",
                decimal(1e-6 * stiffness, 1)
            ),
            None => "a point with mass: restitution and damping are those of this light point, whose effective mass stands above".to_owned(),
        };
        text.push_str(&format!(
            "level {}: the floor hits columns of {} in storey {}, from {below} m to {} m, at {point}\n",
            level.place.label(),
            b.name(),
            storey + 1,
            b.elevations()[storey]
        ));
    }
    text
}

/// What `check` prints.
///
/// # Errors
/// As of a case that cannot be assembled.
pub fn understood(case: &Case, assembly: &Assembly) -> Result<String, CaseError> {
    let mut text = format!("{}: the case is sound\n", case.file.display());
    for line in assembly.excitation() {
        text.push_str(&format!("  {line}\n"));
    }
    text.push_str(&warning_lines(&assembly.warnings()));
    text.push_str(&warning_lines(&case.separation.warnings()));
    for (b, given) in assembly.system.buildings().iter().zip(&case.buildings) {
        let on = b.foundation();
        let of_floors = on.map_or(&**b, |on| on.fixed_base());
        let matrix = of_floors.elastic_stiffness_matrix();
        let mut table = new_table([
            "storey",
            "elevation (m)",
            "mass (kg)",
            if matrix.is_some() {
                "K_ii (N/m)"
            } else {
                "stiffness (N/m)"
            },
            "mode",
            "period (s)",
            "damping (%)",
            "effective mass (%)",
        ]);
        let modes = b.modes();
        let total: f64 = b.mass().iter().sum::<f64>() + foundation::mass_along(b);
        for i in 0..modes.period.len() {
            let [storey, elevation, mass, stiffness] = match i < b.storeys() {
                true => [
                    (i + 1).to_string(),
                    format!("{}", b.elevations()[i]),
                    format!("{}", b.mass()[i]),
                    match &matrix {
                        Some(rows) => format!("{:.6e}", rows[i][i]),
                        None => match of_floors.stiffness().get(i) {
                            Some(stiffness) => format!("{stiffness:e}"),
                            // Its frames stand in the case.
                            None => String::new(),
                        },
                    },
                ],
                // The floors have no more to say than their number.
                false => Default::default(),
            };
            table.add_row([
                storey,
                elevation,
                mass,
                stiffness,
                (i + 1).to_string(),
                decimal(modes.period[i], 5),
                format!("{:.3}", 100.0 * modes.damping_ratio[i]),
                format!("{:.2}", 100.0 * modes.effective_mass[i] / total),
            ]);
        }
        text.push_str(&format!("\nBuilding {}\n{table}\n", b.name()));
        if matrix.is_some() {
            text.push_str("stiffness matrix: every floor acts on every other; K_ii is its diagonal, all of it is in --json\n");
        }
        let parameters = parameters_of_storeys(case, given)?;
        let of_frames = parameters_of_frames(case, given)?;
        text.push_str(&elements::laws(b, [&parameters, &of_frames]));
        text.push_str(&isolators::understood(b));
        text.push_str(&foundation::understood(b));
    }
    for (gap, given) in assembly.system.gaps().iter().zip(&case.gaps) {
        let mut table = new_table([
            "level",
            "elevations (m)",
            "width (m)",
            "effective mass (kg)",
        ]);
        let levels = assembly.system.levels_of(gap);
        for l in levels {
            table.add_row([
                l.place.label(),
                l.place.elevations_label(),
                format!("{}", l.width),
                format!("{:.3}", l.effective_mass),
            ]);
        }
        let model = levels.first().map_or(String::new(), |l| {
            format!(
                "{}, ends at {}",
                l.model.descriptor().name,
                l.model.separation().name()
            )
        });
        text.push_str(&format!("\nGap {} ({model})\n{table}\n", gap.name));
        let of_level = |(place, level): (usize, &ContactLevel)| {
            Ok((level.place.label(), parameters_of_gap(case, given, place)?))
        };
        let of_levels: Result<Vec<_>, CaseError> =
            levels.iter().enumerate().map(of_level).collect();
        text.push_str(&elements::parameters(&of_levels?));
        text.push_str(&hit_columns(&assembly.system, levels));
        text.push_str(&secondary_sources(levels));
    }
    let of_links = case.links.iter().map(|link| parameters_of_link(case, link));
    let of_links: Vec<_> = of_links.collect::<Result<_, _>>()?;
    text.push_str(&elements::links(&assembly.system, &of_links));
    let duration = assembly
        .options
        .duration
        .unwrap_or(assembly.system.record_duration());
    let steps = elements::in_place_of_exact_steps(case, &assembly.system);
    text.push_str(&format!(
        "\nMethod {}{steps}, duration {} s, output every {} s\n",
        case.analysis.method.value,
        six_digits(duration),
        assembly.output_step
    ));
    Ok(text)
}
