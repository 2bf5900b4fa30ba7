//! `pounding verify`: published results, computed.

use clap::ValueEnum;
use pounding_catalogue::wording::counted;
use pounding_files::FileUse;
use pounding_verification::{
    Comparison, Entered, Line, Part, Report, Structures, TEMPLATE, Verdict, VerificationError,
    borovin_2014, holds, iwan, papi_toopchi_2022, restitution, zhou_2012,
};

use crate::arguments::{
    ImpactSource, StructureSource, VerifyArguments, VerifyImpactArguments,
    VerifyStructuresArguments, VerifySubject,
};
use crate::failure::Failure;
use crate::files::reads_too;
use crate::output::{pretty, print};
use crate::progress::Progress;
use crate::tables::Table;

/// Exit code 1 if anything that is said to reproduce does not.
pub fn verify(arguments: &VerifyArguments, files: FileUse) -> Result<(), Failure> {
    match &arguments.subject {
        VerifySubject::Impact(arguments) => impact(arguments),
        VerifySubject::Hysteresis(arguments) => shown(&[iwan()?], arguments.json),
        VerifySubject::Structures(arguments) => structures(arguments, files),
    }
}

fn structures(arguments: &VerifyStructuresArguments, mut files: FileUse) -> Result<(), Failure> {
    if arguments.template {
        return print(TEMPLATE.trim_end());
    }
    let entered = match &arguments.data {
        Some(path) => Entered::read(path),
        None => Entered::template(),
    };
    let entered = entered.map_err(VerificationError::from)?;
    reads_too(
        &mut files,
        entered.cases().into_iter().map(|path| ("case", path)),
    )?;
    let wanted = |source| match (arguments.source.is_empty(), &arguments.data) {
        // Who enters numbers wants them compared, beside what else is asked for.
        (_, Some(_)) if source == StructureSource::Entered => true,
        (true, Some(_)) => false,
        (false, _) => arguments.source.contains(&source),
        (true, None) => true,
    };
    let progress = Progress::working("running published cases".to_owned())?;
    let parts = StructureSource::value_variants()
        .iter()
        .filter(|source| wanted(**source))
        .map(|source| source_of(*source).compare(&entered))
        .collect::<Result<Vec<_>, _>>()?;
    drop(progress);
    shown(&parts, arguments.json)
}

fn source_of(source: StructureSource) -> Structures {
    match source {
        StructureSource::Opensees => Structures::OpenSees,
        StructureSource::CodeAster => Structures::CodeAster,
        StructureSource::Siconos => Structures::Siconos,
        StructureSource::Modelica => Structures::Modelica,
        StructureSource::Ansys => Structures::Ansys,
        StructureSource::ChungOoi => Structures::ChungOoi,
        StructureSource::Laws => Structures::Laws,
        StructureSource::Entered => Structures::Entered,
    }
}

fn part(source: ImpactSource) -> Result<Part, VerificationError> {
    match source {
        ImpactSource::Papi => papi_toopchi_2022(),
        ImpactSource::Zhou => zhou_2012(),
        ImpactSource::Borovin => borovin_2014(),
        ImpactSource::Table => restitution(),
    }
}

fn impact(arguments: &VerifyImpactArguments) -> Result<(), Failure> {
    let wanted = |source| arguments.source.is_empty() || arguments.source.contains(&source);
    let parts = ImpactSource::value_variants()
        .iter()
        .filter(|source| wanted(**source))
        .map(|source| part(*source))
        .collect::<Result<Vec<_>, _>>()?;
    shown(&parts, arguments.json)
}

fn shown(parts: &[Part], as_json: bool) -> Result<(), Failure> {
    if as_json {
        print(&pretty(&Report::of(parts))?)?;
    } else {
        print(&as_text(parts))?;
    }
    if holds(parts) {
        Ok(())
    } else {
        Err(Failure::No)
    }
}

/// For people.
fn as_text(parts: &[Part]) -> String {
    let mut out = String::new();
    for part in parts {
        out.push_str(&format!("{}\n\n", part.citation));
        for comparison in &part.comparisons {
            out.push_str(&format!("{}\n{}\n\n", comparison.title, table(comparison)));
        }
        for finding in &part.findings {
            out.push_str(&format!("- {finding}\n"));
        }
        out.push('\n');
    }
    let comparisons = parts.iter().flat_map(|part| &part.comparisons);
    let lines: Vec<&Line> = comparisons.flat_map(|c| &c.lines).collect();
    let without = lines.iter().filter(|l| l.verdict == Verdict::NeedsData);
    let (all, without) = (lines.len(), without.count());
    out.push_str(&format!("{} compared; ", counted(all - without, "line")));
    if without > 0 {
        out.push_str(&format!(
            "{} without their numbers; ",
            counted(without, "line")
        ));
    }
    if without == all {
        out.push_str("nothing is said to reproduce.");
        return out;
    }
    let failed: Vec<_> = lines.into_iter().filter(|line| !line.holds()).collect();
    if failed.is_empty() {
        out.push_str("everything that is said to reproduce does.");
    } else {
        out.push_str(&format!("{} do not come out as said:\n", failed.len()));
        for line in failed {
            let cells: Vec<_> = line.cells.iter().map(|c| c.shown.as_str()).collect();
            out.push_str(&format!(
                "  {}: {}, said to be {}\n",
                cells.join(" | "),
                line.verdict.words(),
                line.claimed.words()
            ));
        }
    }
    out
}

fn table(comparison: &Comparison) -> Table {
    let mut table = Table::new();
    let headings = comparison.columns.iter().map(|(_, heading)| *heading);
    table.set_header(headings.chain(["verdict"]));
    for line in &comparison.lines {
        let cells = line.cells.iter().map(|cell| cell.shown.as_str());
        table.add_row(cells.chain([line.verdict.words()]));
    }
    table
}

#[cfg(test)]
mod tests {
    use pounding_verification::{Cell, Value, Verdict};

    use super::*;

    #[test]
    fn a_line_that_falls_short_of_its_claim_is_named() {
        let parts = [Part {
            name: "source",
            citation: "Author year",
            comparisons: vec![Comparison {
                title: "Table".to_owned(),
                columns: vec![("value", "value")],
                lines: vec![Line {
                    cells: vec![Cell {
                        shown: "1.50".to_owned(),
                        value: Value::Number(1.5),
                    }],
                    verdict: Verdict::NotReproduced,
                    claimed: Verdict::Reproduced,
                }],
            }],
            findings: Vec::new(),
        }];
        assert!(!holds(&parts));
        let shown = as_text(&parts);
        assert!(shown.contains("1 do not come out as said"), "{shown}");
        assert!(
            shown.contains("1.50: not reproduced, said to be reproduced"),
            "{shown}"
        );
        let shown = serde_json::to_value(Report::of(&parts));
        assert!(shown.is_ok_and(|shown| shown["holds"] == false));
    }
}
