//! Checks whose runs several processes share.

use std::path::Path;

use pounding_files::FileUse;
use pounding_study::Deal;

use crate::arguments::DealArguments;
use crate::failure::Failure;
use crate::files::reads_too;
use crate::output::print;

/// Ending of the file of a shard of a check.
const ENDING: &str = "runs";

/// Who makes the runs of a check, as the arguments say; refuses answers, options by name and
/// whether they are given, where a shard makes its part of the runs alone.
pub fn deal(
    arguments: &DealArguments,
    (check, case): (&str, &Path),
    answers: &[(&str, bool)],
    files: &mut FileUse,
) -> Result<Deal, Failure> {
    if let (Some(_), Some((option, _))) =
        (&arguments.shard, answers.iter().find(|(_, given)| *given))
    {
        return Err(Failure::input(
            format!(
                "--shard makes a part of the runs and no answer: {option} has nothing to write"
            ),
            Some(format!(
                "give {option} to the call with --merge, when all shards are done"
            )),
        ));
    }
    if let (Some(shard), Some(folder)) = (&arguments.shard, &arguments.into) {
        let shard: pounding_study::Shard = shard.parse()?;
        std::fs::create_dir_all(folder)
            .map_err(|e| Failure::output(&e, &folder.display().to_string()))?;
        let name = case.file_stem().unwrap_or_default().to_string_lossy();
        let (i, n) = (shard.index, shard.count);
        let file = folder.join(format!("{name}.{check}-shard-{i}-of-{n}.{ENDING}"));
        return Ok(Deal::Part { shard, file });
    }
    if arguments.merge.is_empty() {
        return Ok(Deal::All);
    }
    let mut found = Vec::new();
    for path in &arguments.merge {
        if !path.is_dir() {
            found.push(path.to_path_buf());
            continue;
        }
        let failed = |e: std::io::Error| {
            Failure::input(format!("cannot read {}: {e}", path.display()), None)
        };
        let mut inside = Vec::new();
        for entry in std::fs::read_dir(path).map_err(failed)? {
            let file = entry.map_err(failed)?.path();
            let name = file.file_name().unwrap_or_default().to_string_lossy();
            if is_shard_of(check, &name) {
                inside.push(file);
            }
        }
        if inside.is_empty() {
            return Err(Failure::input(
                format!("{} holds no shards of a `{check}`", path.display()),
                Some(format!(
                    "make them with `pounding {check} ... --shard I/N --into FOLDER`"
                )),
            ));
        }
        inside.sort();
        found.append(&mut inside);
    }
    reads_too(files, found.iter().map(|file| ("shard", file.clone())))?;
    Ok(Deal::Merged { files: found })
}

/// Whether a file has the name of a shard of a check.
fn is_shard_of(check: &str, name: &str) -> bool {
    name.contains(&format!(".{check}-shard-")) && name.ends_with(&format!(".{ENDING}"))
}

/// Whether a file has the name of a shard of any check.
pub fn is_shard(name: &str) -> bool {
    ["gap", "compare"]
        .iter()
        .any(|check| is_shard_of(check, name))
}

/// Says where the runs of a shard are, which are not the answer; false if the runs are all there.
pub fn print_shard(deal: &Deal, check: &str) -> Result<bool, Failure> {
    let Deal::Part { shard, file } = deal else {
        return Ok(false);
    };
    print(&format!(
        "shard {}/{} in {}\nWhen all are done: the same `pounding {check}` with --merge and the folder in the place of --shard and --into",
        shard.index,
        shard.count,
        file.display()
    ))?;
    Ok(true)
}
