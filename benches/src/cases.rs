//! Cases as our systems and as files of the compiled peer.

use pounding_time_history::{
    Floor, GroundAcceleration, MethodChoice, Outcome, RunOptions, System, run,
};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;
use verification::{Failure, ReferenceBuilding, ReferenceCase, ReferenceLink};

/// Runs a system; fixed steps that are too coarse are to show their error, not to fail.
pub(crate) fn integrate(system: &System, method: MethodChoice) -> Result<Outcome, Failure> {
    let options = RunOptions {
        method,
        duration: None,
        energy_tolerance: Some(1.0e9),
    };
    Ok(run(system, &options, &mut [], &mut |_| {})?)
}

/// Writes a case as the compiled peer reads it.
pub(crate) fn write_peer_case(
    case: &ReferenceCase,
    ground: &GroundAcceleration,
    path: &Path,
) -> Result<(), Failure> {
    let list = |values: &[f64]| {
        let words: Vec<String> = values.iter().map(|x| format!("{x:?}")).collect();
        words.join(" ")
    };
    let mut text = String::new();
    writeln!(text, "{}", case.buildings.len())?;
    for b in &case.buildings {
        writeln!(text, "{} {:?} {:?}", b.m.len(), b.alpha, b.beta)?;
        writeln!(text, "{}\n{}", list(&b.m), list(&b.k))?;
    }
    writeln!(text, "{}", case.links.len())?;
    for l in &case.links {
        let numbers = list(&[l.gap, l.k_lin, l.k_hertz, l.e]);
        writeln!(text, "{} {} {numbers}", l.a, l.b)?;
    }
    writeln!(text, "{} {:?}", ground.samples.len(), ground.time_step)?;
    for a in ground.samples.iter() {
        writeln!(text, "{a:?}")?;
    }
    Ok(std::fs::write(path, text)?)
}

/// The case with all gaps and contact stiffnesses multiplied, on buildings that exist.
pub(crate) fn vary(
    case: &ReferenceCase,
    model: &str,
    base: &System,
    (width, stiffness): (f64, f64),
) -> Result<System, Failure> {
    let mut system = base.isolated();
    let buildings = base.buildings();
    let mut place = Vec::new();
    for (index, b) in buildings.iter().enumerate() {
        place.extend((0..b.storeys()).map(|storey| (index, storey)));
    }
    for left in 0..buildings.len().saturating_sub(1) {
        let mut pairs = Vec::new();
        for l in case.links.iter().filter(|l| place[l.a].0 == left) {
            let link = ReferenceLink {
                gap: l.gap * width,
                k_lin: l.k_lin * stiffness,
                k_hertz: l.k_hertz * stiffness,
                ..*l
            };
            let (a, b) = (place[l.a], place[l.b]);
            pairs.push((
                Floor::Storey(a.0, a.1),
                Floor::Storey(b.0, b.1),
                link.gap,
                verification::reference_model(&link, model)?,
            ));
        }
        let between = [left, left + 1].map(|i| buildings[i].name().to_owned());
        system.add_gap(&between.join("-"), between, pairs)?;
    }
    Ok(system)
}

/// A row of uniform shear buildings with matching floors. Storeys have 300 t; every
/// second building is softer. Stiffness and damping factors do not depend on the
/// number of storeys, so the highest frequency is that of C4's buildings throughout.
pub(crate) fn uniform_row(buildings: usize, storeys: usize, gap: f64) -> ReferenceCase {
    let row = (0..buildings).map(|i| ReferenceBuilding {
        name: format!("b{i}"),
        m: vec![3.0e5; storeys],
        k: vec![if i % 2 == 0 { 5.0e8 } else { 3.0e8 }; storeys],
        alpha: 0.7,
        beta: 0.002,
    });
    let pairs = (1..buildings).flat_map(|i| (0..storeys).map(move |s| (i, s)));
    let links = pairs.map(|(i, s)| ReferenceLink {
        a: (i - 1) * storeys + s,
        b: i * storeys + s,
        gap,
        k_lin: 2.0e9,
        k_hertz: 2.0e10,
        e: 0.65,
    });
    ReferenceCase {
        buildings: row.collect(),
        links: links.collect(),
        models: BTreeMap::new(),
    }
}

/// Impacts of a run.
pub(crate) fn impacts(outcome: &Outcome) -> usize {
    let levels = outcome.gaps.iter().flat_map(|g| &g.levels);
    levels.map(|l| l.impacts).sum()
}
