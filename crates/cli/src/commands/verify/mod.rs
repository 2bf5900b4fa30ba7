//! `pounding verify`: published results, computed.

mod borovin;
mod hysteresis;
mod papi;
mod report;
mod restitution;
mod zhou;

use clap::ValueEnum;

use crate::arguments::{ImpactSource, VerifyArguments, VerifyImpactArguments, VerifySubject};
use crate::failure::Failure;
use report::Part;

use super::{pretty, print};

/// Exit code 1 if anything that is said to reproduce does not.
pub fn verify(arguments: &VerifyArguments) -> Result<(), Failure> {
    match &arguments.subject {
        VerifySubject::Impact(arguments) => impact(arguments),
        VerifySubject::Hysteresis(arguments) => shown(&[hysteresis::part()?], arguments.json),
    }
}

fn part(source: ImpactSource) -> Result<Part, Failure> {
    match source {
        ImpactSource::Papi => papi::part(),
        ImpactSource::Zhou => zhou::part(),
        ImpactSource::Borovin => borovin::part(),
        ImpactSource::Table => restitution::part(),
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

fn shown(parts: &[Part], json: bool) -> Result<(), Failure> {
    if json {
        print(&pretty(&report::as_json(parts)))?;
    } else {
        print(&report::as_text(parts))?;
    }
    if report::holds(parts) {
        Ok(())
    } else {
        Err(Failure::No)
    }
}
