//! Contacts that are softer than the storeys beside them: a stiffness in the wrong unit.

use pounding_gap_element::{Memory, Phase};

use crate::limits::APPROACH_VELOCITY;
use crate::outcome::LevelOutcome;
use crate::system::{ContactLevel, Gap, System};
use crate::warning::Warning;

/// Contact over storey stiffness from which an overlap wider than the gap is that of a narrow gap: at usual
/// stiffnesses floors overlap by some centimetres.
const STIFF_RATIO: f64 = 2.0;
/// The ratio that contacts do not fall below.
const LEAST_RATIO: f64 = 1.0;
/// Factors of a unit that was taken for another (kN for MN, N for MN), and the greatest ratio that
/// one of them may lead to.
const FACTORS: ([f64; 2], f64) = ([1.0e3, 1.0e6], 1.0e3);

/// The softest contact of each gap, where it is softer than the storeys beside it. Every run of a study asks: one force
/// of each level decides.
pub(crate) fn soft_contacts(system: &System) -> impl Iterator<Item = Warning> {
    system.gaps().iter().filter_map(|gap| {
        let soft = compliant(system, gap).filter_map(|level| {
            let storey = Storey::softest_beside(system, level)?;
            if !is_softer(level, LEAST_RATIO * storey.stiffness) {
                return None;
            }
            let stiffness = secant(level, 1.0)?;
            Some((stiffness / storey.stiffness, stiffness, storey, level))
        });
        let (_, stiffness, storey, level) = soft.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let meant = FACTORS.0.into_iter().find_map(|factor| {
            let meant = secant(level, factor)?;
            let usual = LEAST_RATIO..=FACTORS.1;
            let fits = usual.contains(&(meant / storey.stiffness));
            fits.then_some((factor, meant))
        });
        Some(Warning::SoftContact {
            gap: gap.name.clone(),
            stiffness,
            storey: storey.name(system),
            storey_stiffness: storey.stiffness,
            meant,
        })
    })
}

/// The level of each gap whose floors overlapped most, if by more than the gap is wide, in contacts
/// that are hardly stiffer than a storey.
pub(crate) fn deep_penetrations(
    system: &System,
    outcomes: &[LevelOutcome],
) -> impl Iterator<Item = Warning> {
    system.gaps().iter().filter_map(|gap| {
        let levels = gap.first_level..gap.first_level + gap.levels;
        let deepest = levels.max_by(|a, b| {
            let of = |l: &usize| outcomes[*l].peak_penetration.value;
            of(a).total_cmp(&of(b))
        })?;
        let level = &system.levels()[deepest];
        let outcome = &outcomes[deepest];
        let penetration = outcome.peak_penetration.value;
        let deep = level.width > 0.0 && penetration > level.width;
        if !deep || !is_of_floors(level) {
            return None;
        }
        let storey = Storey::softest_beside(system, level)?;
        let ratio = outcome.peak_force.value / penetration / storey.stiffness;
        (ratio < STIFF_RATIO).then(|| Warning::DeepPenetration {
            place: system.name_of_level(deepest),
            penetration,
            width: level.width,
            time: outcome.peak_penetration.time,
            ratio,
            storey: storey.name(system),
        })
    })
}

/// Levels of a gap where floors meet as floors do.
fn compliant<'s>(system: &'s System, gap: &Gap) -> impl Iterator<Item = &'s ContactLevel> {
    system.levels_of(gap).iter().filter(|l| is_of_floors(l))
}

/// Whether floors meet here, in a contact that deforms: no bumper, which is meant to be soft, and no
/// column, which bends.
fn is_of_floors(level: &ContactLevel) -> bool {
    let model = &level.model;
    model.rigid_restitution().is_none()
        && model.spring_behind().is_none()
        && !model.descriptor().is_of_bumper()
}

/// What holds a floor: a storey of a building, both from zero.
struct Storey {
    building: usize,
    storey: usize,
    /// Its stiffness (N/m).
    stiffness: f64,
}

impl Storey {
    /// The softest of the storeys below and above the floors that meet at a level, those of a building on soil being
    /// its own above it. `None` beside a building without storey stiffnesses: what is softest there is not known. A slab on
    /// isolators is passed over: before they yield or slide they are as stiff as it happens, and moat walls that it
    /// meets are softer than floors.
    fn softest_beside(system: &System, level: &ContactLevel) -> Option<Self> {
        let floors = level.between.iter().filter_map(|f| system.storey_of(*f));
        let mut softest: Option<Self> = None;
        for (building, floor) in floors {
            let of = &system.buildings()[building];
            if floor == 0 && of.isolator().is_some() {
                continue;
            }
            let all = of.without_foundation().stiffness();
            let own = all.iter().enumerate().skip(floor).take(2);
            let (storey, stiffness) = own.min_by(|a, b| a.1.total_cmp(b.1))?;
            if softest.as_ref().is_none_or(|s| *stiffness < s.stiffness) {
                softest = Some(Self {
                    building,
                    storey,
                    stiffness: *stiffness,
                });
            }
        }
        softest
    }

    fn name(&self, system: &System) -> String {
        let building = system.buildings()[self.building].name();
        format!("storey {} of \"{building}\"", self.storey + 1)
    }
}

/// Force (N) of the contact at a penetration (m), on the approach at [`APPROACH_VELOCITY`].
fn force_of(level: &ContactLevel) -> impl Fn(f64) -> f64 {
    let model = level.model.as_ref();
    let collision = model.begin(APPROACH_VELOCITY, level.effective_mass);
    move |delta| {
        let memory = Memory::default();
        let force = model.force(&collision, &memory, Phase::Approach, delta, 0.0);
        force.value
    }
}

/// Whether the [`secant`] of the contact is less than a stiffness (N/m): at the penetration at which that one holds the
/// energy of the approach, the contact holds less.
fn is_softer(level: &ContactLevel, stiffness: f64) -> bool {
    let delta = APPROACH_VELOCITY * (level.effective_mass / stiffness).sqrt();
    force_of(level)(delta) < stiffness * delta
}

/// Force over penetration (N/m) of the contact at this many times its force, at the penetration in which a linear spring
/// of that stiffness holds the energy of the approach: its own stiffness where the law is linear.
fn secant(level: &ContactLevel, factor: f64) -> Option<f64> {
    let energy = level.effective_mass * APPROACH_VELOCITY * APPROACH_VELOCITY;
    let force = force_of(level);
    // The logarithm of the penetration by bisection: forces grow with it.
    let (mut low, mut high) = (-40.0_f64, 40.0_f64);
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        let delta = libm::exp(middle);
        match factor * force(delta) * delta < energy {
            true => low = middle,
            false => high = middle,
        }
    }
    let delta = libm::exp(0.5 * (low + high));
    let stiffness = factor * force(delta) / delta;
    (stiffness.is_finite() && stiffness > 0.0).then_some(stiffness)
}
