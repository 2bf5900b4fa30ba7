//! The end of a run.

use pounding_shear_building::ShearBuilding;

use super::Driver;

use crate::error::TimeHistoryError;
use crate::ledger;
use crate::outcome::{
    BuildingOutcome, FrameOutcome, GapOutcome, IsolatorOutcome, LinkLevelOutcome, LinkOutcome,
    NamedPeak, Outcome, StoreyPeaks, YieldingStorey,
};
use crate::peak::Peak;
use crate::recorder::Recorder;
use crate::system::{ElementPlace, LevelMotion};
use crate::warning::Warning;

/// Responses with names of a building, from the peaks of all.
fn responses<'a>(
    building: &ShearBuilding,
    peaks: impl Iterator<Item = &'a Peak>,
) -> Vec<NamedPeak> {
    let rows = building.responses().iter().zip(peaks);
    rows.map(|(row, peak)| NamedPeak {
        name: row.name.clone(),
        unit: row.unit,
        peak: *peak,
        capacity: None,
    })
    .collect()
}

impl Driver<'_> {
    pub(super) fn finish(
        mut self,
        duration: f64,
        recorders: &mut [&mut dyn Recorder],
    ) -> Result<Outcome, TimeHistoryError> {
        self.leave_for_good(duration)?;
        self.settle_put_off(duration);
        let layout = self.dynamics.layout;
        let n = layout.dofs;
        for l in 0..layout.levels {
            let stored = ledger::stored_energy(self.system, &self.contacts, l, &self.state[..n]);
            self.log
                .open(l, None, &self.peaks, layout, &self.state, stored);
        }
        self.log.settle_all();
        self.hand_out_impacts(recorders)?;
        if self.ledger.largest_input > 0.0 {
            self.ledger.residual_ratio = self.largest_residual / self.ledger.largest_input;
        }
        let allowed = self.options.energy_tolerance();
        if self.ledger.residual_ratio > allowed {
            return Err(self.does_not_close(duration, self.ledger.residual_ratio));
        }
        let counts = self.method.counts();
        let recording = self.exact.as_ref().map_or(0, |exact| exact.recording);
        self.statistics.evaluations = counts.evaluations - recording + self.evaluations_in_modes();
        self.statistics.newton_iterations = counts.newton_iterations;
        let mut named = self.peaks.named.iter();
        let mut buildings: Vec<BuildingOutcome> = self
            .system
            .buildings()
            .iter()
            .zip(self.system.offsets().windows(2))
            .zip(&self.peaks.base_moment)
            .map(|((b, range), base_moment)| BuildingOutcome {
                name: b.name().to_owned(),
                storeys: self.peaks.storeys[range[0]..range[1]].to_vec(),
                responses: responses(b, named.by_ref()),
                base_moment: b.stiffness().is_empty().then_some(*base_moment),
                yielding: vec![None; b.storeys()],
                frames: Vec::new(),
                isolator: isolator(b, &self.peaks.storeys[range[0]]),
            })
            .collect();
        let links = self.elements(&mut buildings);
        let (mut levels, impacts) = self.log.into_outcome();
        for (row, peak) in self.system.level_rows().iter().zip(&self.peaks.of_levels) {
            let mut peak = *peak;
            // Where the ground has stopped away from where it began, the first instant of the peak is known
            // from the records alone.
            if row.given.name == LevelMotion::RelativeGroundDisplacement.name()
                && let Some(first) = self
                    .system
                    .relative_ground_displacement(row.level, duration)
            {
                peak.time = first.time;
            }
            levels[row.level].responses.push(NamedPeak {
                name: row.given.name.clone(),
                unit: row.given.unit,
                peak,
                capacity: row.given.capacity,
            });
        }
        let warnings = {
            let found = (
                &buildings[..],
                &levels[..],
                &self.contacts.elements.lost[..],
            );
            Warning::after(self.system, self.options, found, self.ledger.largest_input)
        };
        let gaps = self
            .system
            .gaps()
            .iter()
            .map(|g| GapOutcome {
                name: g.name.clone(),
                levels: levels[g.first_level..g.first_level + g.levels].to_vec(),
            })
            .collect();
        Ok(Outcome {
            method: self.method.information(),
            end_time: duration,
            buildings,
            gaps,
            links,
            impacts,
            energy: self.ledger,
            final_displacement: self.state[..n].to_vec(),
            final_velocity: self.state[n..2 * n].to_vec(),
            statistics: self.statistics,
            warnings,
        })
    }

    /// What storeys with laws and links went through.
    fn elements(&mut self, buildings: &mut [BuildingOutcome]) -> Vec<LinkOutcome> {
        let (system, layout) = (self.system, self.dynamics.layout);
        let mut links: Vec<LinkOutcome> = Vec::new();
        for (index, element) in system.elements().iter().enumerate() {
            let peaks = self.peaks.elements[index];
            let (contacts, state) = (&self.contacts, &self.state);
            let force = self.dynamics.element_force(contacts, index, state, None);
            let memory = &contacts.elements;
            let (_, energy) = memory.energy_of(index, (system, layout), state, None);
            let deformation = element.relative(state);
            let law = element.law.descriptor().name;
            let lost = memory.lost[index];
            let ductility = element.yield_deformation.map(|y| Peak {
                value: peaks.deformation.value / y,
                time: peaks.deformation.time,
            });
            let residual = {
                let plastic = deformation - force / element.law.initial_stiffness();
                // What round-off leaves of a storey that stayed elastic is none.
                let stays = plastic.abs() > ROUND_OFF * peaks.deformation.value;
                if stays { plastic } else { 0.0 }
            };
            match element.place {
                ElementPlace::Storey { building, storey } => {
                    let height = system.buildings()[building].height()[storey];
                    buildings[building].yielding[storey] = Some(YieldingStorey {
                        law,
                        ductility,
                        residual_drift_ratio: residual / height,
                        hysteretic_energy: energy,
                        strength_lost: lost,
                    });
                }
                ElementPlace::Frame { building, frame } => {
                    let of = &system.buildings()[building];
                    let frame = &of.yielding_frames()[frame];
                    let own = YieldingStorey {
                        law,
                        ductility,
                        residual_drift_ratio: residual / of.height()[frame.storey],
                        hysteretic_energy: energy,
                        strength_lost: None,
                    };
                    let outcome = &mut buildings[building];
                    let storey = &mut outcome.yielding[frame.storey];
                    *storey = Some(storey.map_or(own, |others| others.beside(&own)));
                    outcome.frames.push(FrameOutcome {
                        direction: frame.direction.name(),
                        at: frame.at,
                        storey: frame.storey + 1,
                        law,
                        deformation: peaks.deformation,
                        force: peaks.force,
                        ductility,
                        residual_deformation: residual,
                        hysteretic_energy: energy,
                        strength_lost: lost,
                    });
                }
                ElementPlace::Link { link, .. } => {
                    if links.len() <= link {
                        links.push(LinkOutcome {
                            name: system.links()[link].name.clone(),
                            law,
                            levels: Vec::new(),
                        });
                    }
                    links[link].levels.push(LinkLevelOutcome {
                        deformation: peaks.deformation,
                        force: peaks.force,
                        ductility,
                        final_deformation: deformation,
                        energy_dissipated: energy,
                        strength_lost: lost,
                    });
                }
            }
        }
        links
    }
}

/// Part of the maximum drift of a storey that round-off may leave of it.
const ROUND_OFF: f64 = 1.0e-13;

/// What the isolators under a building went through, from the peaks of its first storey.
fn isolator(building: &ShearBuilding, first: &StoreyPeaks) -> Option<IsolatorOutcome> {
    let (isolator, properties) = building.isolator()?;
    let (period, damping) = properties.effective(first.displacement.value);
    Some(IsolatorOutcome {
        model: isolator.name(),
        displacement: first.displacement,
        force: first.storey_shear,
        effective_period: period,
        effective_damping_ratio: damping,
    })
}
