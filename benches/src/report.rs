//! What is measured in which mode, and how it is written down.

mod tables;

use std::fmt::Write as _;
use std::path::Path;

use pounding_time_history::GroundAcceleration;
use verification::{Failure, ReferenceCases, reference_system};

use crate::clock::least;
use crate::methods::sweeping;
use crate::peers::{MODELS, PROTOTYPE, Program, Room};
use crate::precision::{Plan, Point, measure};
use crate::scaling;
use crate::sweep::{Grid, sweep};
use crate::{machine, memory, tell, write_cases};
use tables::{equal_error, prototype_ratios, table, three, work_precision};

/// Models that are measured by all methods.
const WHOLE: [&str; 2] = ["kv", "jank"];

/// Points of one case with one model.
struct Block {
    case: String,
    model: String,
    points: Vec<Point>,
}

/// About a minute.
pub(crate) fn quick(
    mut reference: ReferenceCases,
    ground: &GroundAcceleration,
) -> Result<String, Failure> {
    let room = ready(&reference, ground)?;
    let plan = Plan {
        rounds: 1,
        fixed_steps: true,
        python: false,
        short: true,
    };
    let mut blocks = Vec::new();
    for (case, model) in [("C2", "kv"), ("C2", "jank"), ("C3a", "kv"), ("C3a", "jank")] {
        blocks.push(block(&room, &reference, ground, (case, model), &plan)?);
    }
    write_points(&room, &blocks)?;
    let mut text = opening(&room);
    text += &work_precision(&blocks)?;
    text += &equal_error(&blocks)?;
    text += &prototype_ratios(&blocks)?;
    text += &sweeps(&room, &reference, ground, &["jank"], 1)?;
    text += &scalings(
        &room,
        &mut reference,
        ground,
        &[3, 10, 30],
        &[2, 5],
        &[1.0],
        1,
    )?;
    text += &memories(&[1])?;
    Ok(text)
}

/// All of it.
pub(crate) fn full(
    mut reference: ReferenceCases,
    ground: &GroundAcceleration,
) -> Result<String, Failure> {
    let room = ready(&reference, ground)?;
    let start = opening(&room);
    let mut blocks = Vec::new();
    let cases: Vec<String> = reference.cases.keys().cloned().collect();
    for case in &cases {
        for model in MODELS {
            let whole = WHOLE.contains(&model);
            let plan = Plan {
                rounds: 3,
                fixed_steps: whole,
                python: whole && ["C2", "C3a"].contains(&case.as_str()),
                short: false,
            };
            blocks.push(block(&room, &reference, ground, (case, model), &plan)?);
        }
    }
    write_points(&room, &blocks)?;
    let mut text = start;
    text += &equal_error(&blocks)?;
    text += &prototype_ratios(&blocks)?;
    text += &work_precision(&blocks)?;
    text += &sweeps(&room, &reference, ground, &WHOLE, 2)?;
    text += &whole_scaling(&room, &mut reference, ground)?;
    text += &memories(&[1, 100, 1000])?;
    Ok(text)
}

fn whole_scaling(
    room: &Room,
    reference: &mut ReferenceCases,
    ground: &GroundAcceleration,
) -> Result<String, Failure> {
    scalings(
        room,
        reference,
        ground,
        &[3, 5, 10, 15, 20, 30, 50, 100, 200],
        &[2, 3, 5, 10, 20],
        &[0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 100.0],
        3,
    )
}

/// Cost against storeys, buildings and impacts, and memory.
pub(crate) fn only_scaling(
    mut reference: ReferenceCases,
    ground: &GroundAcceleration,
) -> Result<String, Failure> {
    let room = ready(&reference, ground)?;
    let text = whole_scaling(&room, &mut reference, ground)?;
    Ok(text + &memories(&[1, 100, 1000])?)
}

/// Ours beside the prototype on every case and model, methods with tolerances only.
pub(crate) fn prototype(
    reference: &ReferenceCases,
    ground: &GroundAcceleration,
) -> Result<String, Failure> {
    let room = ready(reference, ground)?;
    let plan = Plan {
        rounds: 2,
        fixed_steps: false,
        python: false,
        short: true,
    };
    let mut text = opening(&room);
    let mut blocks = Vec::new();
    for case in reference.cases.keys() {
        for model in MODELS {
            blocks.push(block(&room, reference, ground, (case, model), &plan)?);
        }
    }
    write_points(&room, &blocks)?;
    text += &prototype_ratios(&blocks)?;
    Ok(text)
}

/// The sweeps of 1,000 runs alone.
pub(crate) fn only_sweeps(
    reference: &ReferenceCases,
    ground: &GroundAcceleration,
) -> Result<String, Failure> {
    let room = ready(reference, ground)?;
    sweeps(&room, reference, ground, &WHOLE, 2)
}

/// Runs per second of one sweep of any size.
pub(crate) fn one_sweep(
    reference: &ReferenceCases,
    ground: &GroundAcceleration,
    runs: usize,
) -> Result<String, Failure> {
    let case = reference.cases.get("C2").ok_or("no case C2")?;
    let grid = Grid::of(runs);
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let mut text = String::new();
    for (name, method) in sweeping(ground.time_step) {
        let swept = sweep((case, "jank"), ground, method, grid, threads)?;
        let rate = grid.runs() as f64 / swept.elapsed;
        writeln!(
            text,
            "{name}: {} runs of C2 jank in {:.1} s on {threads} threads, {rate:.0} runs/s",
            grid.runs(),
            swept.elapsed,
        )?;
    }
    Ok(text)
}

/// Writes the text between the marks of `benches/README.md`.
pub(crate) fn write_page(text: &str) -> Result<(), Failure> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md");
    let page = std::fs::read_to_string(&path)?;
    let (begin, end) = ("<!-- measured -->", "<!-- end of measured -->");
    let head = page.split_once(begin).ok_or("the page has no marks")?.0;
    let tail = page.split_once(end).ok_or("the page has no end mark")?.1;
    let page = format!("{head}{begin}\n\n{}\n\n{end}{tail}", text.trim_end());
    Ok(std::fs::write(path, page)?)
}

fn ready(reference: &ReferenceCases, ground: &GroundAcceleration) -> Result<Room, Failure> {
    let room = Room::look()?;
    write_cases(reference, ground, &room.out)?;
    Ok(room)
}

fn opening(room: &Room) -> String {
    format!(
        "Machine: {}\n\nPeers: {}.\n",
        machine::sentence(),
        room.availability()
    )
}

fn block(
    room: &Room,
    reference: &ReferenceCases,
    ground: &GroundAcceleration,
    (case, model): (&str, &str),
    plan: &Plan,
) -> Result<Block, Failure> {
    tell(&format!("{case} {model}"));
    let data = reference.cases.get(case).ok_or("no such case")?;
    let values = data.models.get(model).ok_or("no such model")?;
    let system = reference_system(data, model, ground.clone(), 1.0)?;
    Ok(Block {
        case: case.to_owned(),
        model: model.to_owned(),
        points: measure(room, &system, values, (case, model), plan)?,
    })
}

/// Every point, as CSV.
fn write_points(room: &Room, blocks: &[Block]) -> Result<(), Failure> {
    let mut text =
        "case,model,method,parameter,error_displacement,error_force,error_own,ms_min,ms_median,\
                    rounds\n"
            .to_owned();
    for b in blocks {
        for p in &b.points {
            let (u, f, own) = p.errors.map_or((f64::NAN, f64::NAN, f64::NAN), |e| {
                (e.displacement, e.force, e.own)
            });
            writeln!(
                text,
                "{},{},{},{},{u:.3e},{f:.3e},{own:.3e},{:.5},{:.5},{}",
                b.case,
                b.model,
                p.method,
                p.parameter,
                p.milliseconds(),
                p.median_milliseconds(),
                p.seconds.len(),
            )?;
        }
    }
    Ok(std::fs::write(room.out.join("points.csv"), text)?)
}

/// Sweeps of 1,000 runs, interleaved.
fn sweeps(
    room: &Room,
    reference: &ReferenceCases,
    ground: &GroundAcceleration,
    models: &[&str],
    rounds: usize,
) -> Result<String, Failure> {
    let grid = Grid::of(1000);
    let mut text = "\n## A sweep of 1,000 three-storey pairs\n\n40 gaps times 25 stiffnesses of \
                    C2, 30 s each. Runs per second of processor time on one thread; for two \
                    threads of elapsed time, with the gain over one thread's elapsed time, to \
                    which other work on the machine adds its share, and with the processor \
                    time of two threads over that of one, to which it does not.\n\n\
                    | model | program | runs/s, one thread | over prototype | two threads | gain | processor time | sum of forces over prototype's, less 1 |\n\
                    |---|---|---|---|---|---|---|---|\n"
        .to_owned();
    let case = reference.cases.get("C2").ok_or("no case C2")?;
    let methods = sweeping(ground.time_step);
    let compiled = room.has(Program::Compiled("evd"));
    for model in models {
        tell(&format!("sweep {model}"));
        let mut prototype = (f64::INFINITY, f64::NAN);
        let mut one = vec![Vec::new(); methods.len()];
        let mut two = vec![Vec::new(); methods.len()];
        let mut both = vec![Vec::new(); methods.len()];
        let mut elapsed = vec![Vec::new(); methods.len()];
        let mut force = vec![0.0; methods.len()];
        for _ in 0..rounds {
            if compiled {
                let (seconds, sum) = room.sweep("evd", ("C2", model, "1e-8"))?;
                prototype = (prototype.0.min(seconds), sum);
            }
            for (i, (_, method)) in methods.iter().enumerate() {
                let swept = sweep((case, model), ground, *method, grid, 1)?;
                one[i].push(swept.processor);
                elapsed[i].push(swept.elapsed);
                force[i] = swept.force;
                let swept = sweep((case, model), ground, *method, grid, 2)?;
                two[i].push(swept.elapsed);
                both[i].push(swept.processor);
            }
        }
        let runs = grid.runs() as f64;
        if compiled {
            let rate = three(runs / prototype.0);
            writeln!(text, "| {model} | {PROTOTYPE} 1e-8 | {rate} | 1 | | | | |")?;
        }
        for (i, (name, _)) in methods.iter().enumerate() {
            let over = |x: f64| if compiled { three(x) } else { String::new() };
            let difference = force[i] / prototype.1 - 1.0;
            writeln!(
                text,
                "| {model} | **{name}** | {} | {} | {} | {} | {} | {} |",
                three(runs / least(&one[i])),
                over(prototype.0 / least(&one[i])),
                three(runs / least(&two[i])),
                three(least(&elapsed[i]) / least(&two[i])),
                three(least(&both[i]) / least(&one[i])),
                if compiled {
                    format!("{difference:.0e}")
                } else {
                    String::new()
                },
            )?;
        }
    }
    Ok(text)
}

fn scalings(
    room: &Room,
    reference: &mut ReferenceCases,
    ground: &GroundAcceleration,
    storeys: &[usize],
    buildings: &[usize],
    gaps: &[f64],
    rounds: usize,
) -> Result<String, Failure> {
    let mut text = format!(
        "\n## Scaling\n\n{} throughout, 30 s, {} samples. Columns hold ms per run; in brackets ns \
         for each floor and sample.\n",
        scaling::MODEL,
        ground.samples.len() - 1
    );
    tell("scaling: storeys");
    let [free, touching] = scaling::storeys(room, ground, storeys, rounds)?;
    text += "\n**Two towers of so many storeys that never touch**\n\n";
    text += &table("storeys of each", ground, &free)?;
    text += "\n**The same towers 20 mm apart**\n\n";
    text += &table("storeys of each", ground, &touching)?;
    tell("scaling: buildings");
    text += "\n**Six-storey buildings in a row, 20 mm apart**\n\n";
    let rows = scaling::buildings(room, ground, buildings, rounds)?;
    text += &table("buildings", ground, &rows)?;
    tell("scaling: impacts");
    text += "\n**C3a with other gaps**\n\n";
    let case = reference.cases.get_mut("C3a").ok_or("no case C3a")?;
    let rows = scaling::gaps(room, case, ground, gaps, rounds)?;
    text += &table("gap", ground, &rows)?;
    Ok(text)
}

fn memories(runs: &[usize]) -> Result<String, Failure> {
    tell("memory");
    let mut text = "\n## Memory\n\nPeak resident memory of a whole process (MB) without \
                    histories; in brackets what the runs add to a process that reads its data \
                    and ends.\n\n| case | method | runs | MB |\n|---|---|---|---|\n"
        .to_owned();
    for case in ["C2", "C4"] {
        for (i, (name, _)) in sweeping(0.005).iter().enumerate() {
            let Ok(nothing) = memory::measure(case, scaling::MODEL, i, 0) else {
                return Ok("\n## Memory\n\nThis system does not tell peak memory.\n".to_owned());
            };
            for n in runs {
                if *n > 100 && case != "C2" {
                    continue;
                }
                let peak = memory::measure(case, scaling::MODEL, i, *n)?;
                let mb = |kb: usize| kb as f64 / 1024.0;
                writeln!(
                    text,
                    "| {case} | {name} | {} | {:.2} ({:.2}) |",
                    Grid::of(*n).runs(),
                    mb(peak),
                    mb(peak.saturating_sub(nothing)),
                )?;
            }
        }
    }
    Ok(text)
}
