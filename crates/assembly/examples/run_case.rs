//! One run of a case, for counting what it costs: CASE DURATION [without-gaps]. Prints the number
//! of impacts and of steps. `benches/coupled` counts its instructions.

use std::error::Error;
use std::io::Write as _;
use std::path::Path;

use pounding_assembly::assemble;
use pounding_case::Case;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (path, duration, gaps) = match arguments.as_slice() {
        [path, duration] => (path, duration, true),
        [path, duration, word] if word == "without-gaps" => (path, duration, false),
        _ => return Err("CASE DURATION [without-gaps]".into()),
    };
    let case = Case::read(Path::new(path))?;
    let assembly = assemble(&case)?;
    let mut options = assembly.options;
    options.duration = Some(duration.parse()?);
    let system = if gaps {
        assembly.system
    } else {
        assembly.system.without_gaps()
    };
    let outcome = pounding_time_history::run(&system, &options, &mut [], &mut |_| {})?;
    let impacts: usize = outcome
        .gaps
        .iter()
        .flat_map(|g| &g.levels)
        .map(|l| l.impacts)
        .sum();
    writeln!(std::io::stdout(), "{impacts} {}", outcome.statistics.steps)?;
    Ok(())
}
