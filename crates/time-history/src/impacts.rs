//! What counts as an impact: the only place where impacts are counted, whatever the method.
//!
//! A contact begins at a located closure and ends by the separation rule of its model. An
//! impact is a run of contacts between which the floors do not part: hops of at most
//! [`TOUCH`] are within what positions are known to, and belong to it. It counts if it
//! amounts to more than a touch. The rule in words is in `docs/theory/impacts.md`.

use pounding_gap_element::{Collision, MAXIMUM_CONSTANTS};

use crate::layout::Layout;
use crate::outcome::{Impact, LevelOutcome};
use crate::peak::Peak;
use crate::peaks::Peaks;
use crate::system::{System, TOUCH};

/// Change of the relative velocity (m/s) up to which rigid floors, which never overlap, do
/// no more than touch; floors that meet no faster than this meet at rest.
pub(crate) const TOUCH_VELOCITY: f64 = 1.0e-9;

/// The impact of a level that is in progress, or the last one while it may go on.
#[derive(Debug, Clone, Copy)]
struct Episode {
    /// Place in the log.
    index: usize,
    /// Time of the first contact (s), which `time_closed` may come after.
    first_contact: f64,
    /// Work and impulse of the level when the present contact closed; `None` between two
    /// contacts.
    closed_with: Option<(f64, f64)>,
    /// Whether the present contact is a lasting one of rigid floors.
    lasting: bool,
    sticks: usize,
}

/// What is followed of a level from contact to contact.
#[derive(Debug, Clone, Copy)]
struct Track {
    episode: Option<Episode>,
    /// Whether the floors are apart by more than a touch from the start.
    apart_from_start: bool,
    /// Whether they have not met yet.
    is_new: bool,
    /// Since when they are apart (s), and how fast they parted (m/s). Before they have met, until
    /// when they stand still, if no impact moves them before.
    apart_since: f64,
    separation_velocity: f64,
    /// Sums of squared approach and separation velocities of finished impacts.
    squares: (f64, f64),
    /// Gap, and level within it.
    place: (usize, usize),
    /// Number of constants of its model.
    constants: usize,
    /// Whether its impacts are velocity jumps.
    rigid: bool,
    effective_mass: f64,
}

impl Track {
    /// Whether floors that close now have not parted since their last contact, or since the
    /// start: whether they hopped no higher than a touch since a time. The height is that of the
    /// parabola with these velocities at its ends.
    fn stayed_in_touch(&self, since: f64, time: f64, approach_velocity: f64) -> bool {
        let velocities = self.separation_velocity + approach_velocity;
        !self.apart_from_start && 0.125 * velocities * (time - since.min(time)) <= TOUCH
    }
}

/// Space for impacts before the log has to grow.
const IMPACTS: usize = 1024;

/// Impacts in the order in which they were found.
#[derive(Debug)]
pub(crate) struct ImpactLog {
    impacts: Vec<Impact>,
    /// Constants of all impacts: handed over with the impact, so that nothing is allocated
    /// while it lasts.
    constants: Vec<[f64; MAXIMUM_CONSTANTS]>,
    /// Impacts that turned out to be touches.
    touches: Vec<bool>,
    tracks: Vec<Track>,
    /// Of every level, the groups of buildings at it that move together.
    groups: Vec<Vec<usize>>,
    /// First level of every gap.
    first_levels: Vec<usize>,
    levels: Vec<LevelOutcome>,
    finished: Vec<usize>,
    handed_out: Vec<Impact>,
}

/// What the log holds of one level at one time, to go back to.
#[derive(Debug, Clone)]
pub(crate) struct LevelMark {
    level: usize,
    track: Track,
    outcome: LevelOutcome,
    /// The impact that may go on.
    impact: Option<Impact>,
}

/// How long the lists of the log are at one time.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct LogMark {
    impacts: usize,
    finished: usize,
}

impl ImpactLog {
    /// The present lengths of the lists.
    pub(crate) fn mark(&self) -> LogMark {
        LogMark {
            impacts: self.impacts.len(),
            finished: self.finished.len(),
        }
    }

    /// What is known of a level at present.
    pub(crate) fn mark_level(&self, level: usize) -> LevelMark {
        let track = self.tracks[level];
        LevelMark {
            level,
            track,
            outcome: self.levels[level].clone(),
            impact: track.episode.map(|e| self.impacts[e.index].clone()),
        }
    }

    /// Forgets all impacts since the mark.
    pub(crate) fn go_back(&mut self, mark: LogMark) {
        self.impacts.truncate(mark.impacts);
        self.constants.truncate(mark.impacts);
        self.touches.truncate(mark.impacts);
        self.finished.truncate(mark.finished);
    }

    /// Forgets what a level went through since the mark.
    pub(crate) fn go_back_level(&mut self, mark: &LevelMark) {
        self.tracks[mark.level] = mark.track;
        self.levels[mark.level].clone_from(&mark.outcome);
        if let (Some(episode), Some(impact)) = (mark.track.episode, &mark.impact) {
            self.impacts[episode.index].clone_from(impact);
            self.touches[episode.index] = false;
        }
    }

    pub(crate) fn new(system: &System) -> Self {
        let count = system.levels().len();
        let (u, v) = system
            .initial_state()
            .split_at(system.initial_state().len() / 2);
        let begins = system.levels_at_rest_until();
        let mut tracks = Vec::with_capacity(count);
        for (g, gap) in system.gaps().iter().enumerate() {
            for level in 0..gap.levels {
                let contact = &system.levels()[gap.first_level + level];
                tracks.push(Track {
                    episode: None,
                    apart_from_start: contact.width - contact.relative(u) > TOUCH,
                    is_new: true,
                    apart_since: begins[gap.first_level + level],
                    separation_velocity: (-contact.relative(v)).max(0.0),
                    squares: (0.0, 0.0),
                    place: (g, level),
                    constants: contact.model.descriptor().constants.len(),
                    rigid: contact.model.rigid_restitution().is_some(),
                    effective_mass: contact.effective_mass,
                });
            }
        }
        let empty = LevelOutcome {
            impacts: 0,
            first_contact: None,
            peak_force: Peak::default(),
            peak_penetration: Peak::default(),
            impulse_max: 0.0,
            approach_velocity_max: 0.0,
            energy_dissipated: 0.0,
            impulse: 0.0,
            achieved_restitution: None,
            sticks: 0,
            gap_widening: 0.0,
            responses: Vec::new(),
            clearance: None,
        };
        Self {
            impacts: Vec::with_capacity(IMPACTS),
            constants: Vec::with_capacity(IMPACTS),
            touches: Vec::with_capacity(IMPACTS),
            tracks,
            groups: groups(system),
            first_levels: system.gaps().iter().map(|gap| gap.first_level).collect(),
            levels: vec![empty; count],
            finished: Vec::with_capacity(IMPACTS),
            handed_out: Vec::new(),
        }
    }

    /// A contact begins: with it an impact, or the present one goes on.
    pub(crate) fn close(
        &mut self,
        l: usize,
        time: f64,
        collision: &Collision,
        layout: Layout,
        state: &[f64],
    ) {
        let approach_velocity = collision.approach_velocity;
        let since = self.apart_since(l);
        let track = &mut self.tracks[l];
        track.is_new = false;
        let closed_with = Some((state[layout.work(l)], state[layout.impulse(l)]));
        let in_touch = track.stayed_in_touch(since, time, approach_velocity);
        if let (true, Some(episode)) = (in_touch, &mut track.episode) {
            episode.closed_with = closed_with;
            episode.lasting = false;
            return;
        }
        // Floors that lie against one another at rest and are pressed together, however
        // slowly at first, are in contact since they began to move.
        let time = if in_touch { since.min(time) } else { time };
        let at_rest = in_touch && approach_velocity <= TOUCH_VELOCITY;
        let (gap, level) = track.place;
        self.settle(l);
        self.tracks[l].episode = Some(Episode {
            index: self.impacts.len(),
            first_contact: time,
            closed_with,
            lasting: false,
            sticks: 0,
        });
        self.impacts.push(Impact {
            gap,
            level,
            time_closed: time,
            time_opened: f64::NAN,
            approach_velocity: if at_rest { 0.0 } else { approach_velocity },
            separation_velocity: f64::NAN,
            achieved_restitution: f64::NAN,
            peak_force: Peak {
                value: if self.tracks[l].rigid { f64::NAN } else { 0.0 },
                time,
            },
            peak_penetration: Peak { value: 0.0, time },
            impulse: 0.0,
            energy_dissipated: 0.0,
            constants: Vec::new(),
        });
        self.constants.push(collision.constants);
        self.touches.push(false);
    }

    /// Since when the floors of a level are apart (s). Those that have not met and lie against one
    /// another are in touch until their own motions or an impact on their buildings move them.
    fn apart_since(&self, l: usize) -> f64 {
        let track = &self.tracks[l];
        if !track.is_new || track.apart_from_start {
            return track.apart_since;
        }
        let own = &self.groups[l];
        let moves = |impact: &&Impact| {
            let level = self.first_levels[impact.gap] + impact.level;
            let mut groups = self.groups[level].iter();
            impact.gap != track.place.0 && groups.any(|group| own.contains(group))
        };
        let impacts = self.impacts.iter().filter(moves).map(|i| i.time_closed);
        impacts.fold(track.apart_since, f64::min)
    }

    /// Whether the present contact of a level closed at this very instant: nothing has acted in it.
    pub(crate) fn has_just_closed(&self, l: usize, layout: Layout, state: &[f64]) -> bool {
        let episode = self.tracks[l].episode;
        let closed_with = episode.and_then(|episode| episode.closed_with);
        closed_with == Some((state[layout.work(l)], state[layout.impulse(l)]))
    }

    /// A contact that has just closed begins with another velocity, to which impulses of the same
    /// instant have brought its floors. An impact that was going on keeps its own.
    pub(crate) fn begin_again(&mut self, l: usize, time: f64, collision: &Collision) {
        let Some(episode) = &mut self.tracks[l].episode else {
            return;
        };
        let impact = &mut self.impacts[episode.index];
        if impact.impulse != 0.0 || impact.time_opened.is_finite() {
            return;
        }
        episode.first_contact = time;
        impact.time_closed = time;
        impact.approach_velocity = collision.approach_velocity;
        self.constants[episode.index] = collision.constants;
    }

    /// Ends a contact. `end` is the time (s) and the separation velocity (m/s), or `None`
    /// if the run ends first; `stored` is what the spring still holds (J).
    pub(crate) fn open(
        &mut self,
        l: usize,
        end: Option<(f64, f64)>,
        peaks: &Peaks,
        layout: Layout,
        state: &[f64],
        stored: f64,
    ) {
        let track = &mut self.tracks[l];
        let Some(episode) = &mut track.episode else {
            return;
        };
        let Some((work, impulse)) = episode.closed_with.take() else {
            return;
        };
        let impact = &mut self.impacts[episode.index];
        impact.impulse += state[layout.impulse(l)] - impulse;
        impact.energy_dissipated += state[layout.work(l)] - work - stored;
        take_larger(&mut impact.peak_force, peaks.force[l]);
        take_larger(&mut impact.peak_penetration, peaks.penetration[l]);
        if let Some((time, separation)) = end {
            if episode.lasting {
                // Contact may end before the impacts that led to it would have.
                impact.time_closed = impact.time_closed.min(time);
            }
            // The end of one step and the start of the next differ by round-off.
            impact.time_opened = time.max(impact.time_closed);
            impact.separation_velocity = separation;
            track.apart_from_start = false;
            track.apart_since = time;
            track.separation_velocity = separation;
        } else {
            impact.time_opened = f64::NAN;
            impact.separation_velocity = f64::NAN;
        }
        // Floors are held since an impact shortly before those that are not followed have come to
        // their end, which is when their contact closes.
        for peak in [&mut impact.peak_force, &mut impact.peak_penetration] {
            peak.time = peak.time.max(impact.time_closed);
        }
    }

    /// The impact of a level is over for good: takes it into the sums of its level, unless
    /// it was no more than a touch.
    fn settle(&mut self, l: usize) {
        let track = &mut self.tracks[l];
        let Some(episode) = track.episode.take() else {
            return;
        };
        let impact = &mut self.impacts[episode.index];
        let is_touch = if track.rigid {
            impact.impulse <= track.effective_mass * TOUCH_VELOCITY
        } else {
            impact.peak_penetration.value <= TOUCH
        };
        if is_touch {
            self.touches[episode.index] = true;
            return;
        }
        let outcome = &mut self.levels[l];
        outcome.impacts += 1;
        outcome.sticks += episode.sticks;
        outcome.first_contact.get_or_insert(episode.first_contact);
        outcome.approach_velocity_max = outcome.approach_velocity_max.max(impact.approach_velocity);
        let separation = impact.separation_velocity;
        if separation.is_finite() {
            // Over a speed that is round-off, the ratio is nothing but noise.
            let meets = impact.approach_velocity > TOUCH_VELOCITY;
            if meets {
                impact.achieved_restitution = separation / impact.approach_velocity;
            }
            let squares = &mut track.squares;
            squares.0 += impact.approach_velocity * impact.approach_velocity;
            squares.1 += separation * separation;
            if meets || outcome.achieved_restitution.is_some() {
                outcome.achieved_restitution = Some((squares.1 / squares.0).sqrt());
            }
        }
        outcome.impulse += impact.impulse;
        outcome.impulse_max = outcome.impulse_max.max(impact.impulse);
        outcome.energy_dissipated += impact.energy_dissipated;
        for (peak, of_impact) in [
            (&mut outcome.peak_force, impact.peak_force),
            (&mut outcome.peak_penetration, impact.peak_penetration),
        ] {
            peak.raise(of_impact.value, of_impact.time);
        }
        self.finished.push(episode.index);
    }

    /// The run is over: so are all impacts.
    pub(crate) fn settle_all(&mut self) {
        for l in 0..self.tracks.len() {
            self.settle(l);
        }
    }

    /// A plastic deformation (m) widened the gap.
    pub(crate) fn widen(&mut self, l: usize, deformation: f64) {
        self.levels[l].gap_widening += deformation;
    }

    /// Whether floors that close now have not parted by more than a touch since their last
    /// contact, or since the start.
    pub(crate) fn stays_in_touch(&self, l: usize, time: f64, approach_velocity: f64) -> bool {
        self.tracks[l].stayed_in_touch(self.apart_since(l), time, approach_velocity)
    }

    /// Whether a contact is in progress.
    pub(crate) fn is_running(&self, l: usize) -> bool {
        let episode = self.tracks[l].episode;
        episode.is_some_and(|e| e.closed_with.is_some())
    }

    /// Whether the contact in progress is a lasting one of rigid floors.
    pub(crate) fn is_lasting(&self, l: usize) -> bool {
        self.is_running(l) && self.tracks[l].episode.is_some_and(|e| e.lasting)
    }

    /// The rigid floors of the contact in progress do not part.
    pub(crate) fn begin_lasting(&mut self, l: usize) {
        if let Some(episode) = &mut self.tracks[l].episode {
            episode.lasting = true;
            // A touch between two lasting contacts makes one of them.
            episode.sticks = 1;
        }
    }

    /// Moves the closure of the impact in progress, unless it goes on from a contact before.
    pub(crate) fn closed_at(&mut self, l: usize, time: f64) {
        if let Some(episode) = &self.tracks[l].episode {
            let impact = &mut self.impacts[episode.index];
            if !impact.time_opened.is_finite() {
                impact.time_closed = time;
            }
        }
    }

    pub(crate) fn stick(&mut self, l: usize) {
        if let Some(episode) = &mut self.tracks[l].episode {
            episode.sticks += 1;
        }
    }

    /// Impacts that ended since the last call.
    pub(crate) fn finished(&mut self) -> &[Impact] {
        self.handed_out.clear();
        for index in std::mem::take(&mut self.finished) {
            let mut impact = self.impacts[index].clone();
            impact.constants = self.constants_of(index);
            self.handed_out.push(impact);
        }
        &self.handed_out
    }

    /// Constants of a collision, as many as its model's descriptor has.
    fn constants_of(&self, index: usize) -> Vec<f64> {
        let impact = &self.impacts[index];
        let place = (impact.gap, impact.level);
        let track = self.tracks.iter().find(|t| t.place == place);
        let count = track.map_or(0, |t| t.constants);
        self.constants[index][..count].to_vec()
    }

    /// What happened at every level, and all impacts in order of closure.
    pub(crate) fn into_outcome(mut self) -> (Vec<LevelOutcome>, Vec<Impact>) {
        for (level, track) in self.levels.iter_mut().zip(&self.tracks) {
            if track.rigid && level.impacts > 0 && level.sticks == 0 {
                level.peak_force.value = f64::NAN;
            }
        }
        for index in 0..self.impacts.len() {
            self.impacts[index].constants = self.constants_of(index);
        }
        let mut impacts = self.impacts;
        let mut touches = self.touches.into_iter();
        impacts.retain(|_| touches.next() == Some(false));
        impacts.sort_unstable_by(|a, b| {
            let places = (a.gap, a.level).cmp(&(b.gap, b.level));
            a.time_closed.total_cmp(&b.time_closed).then(places)
        });
        // Outcomes of thousands of runs are kept.
        impacts.shrink_to_fit();
        (self.levels, impacts)
    }
}

/// Of every level, the groups of buildings that meet there and that links and touching floors move
/// together.
fn groups(system: &System) -> Vec<Vec<usize>> {
    let joined = system.joined_buildings();
    let of_level = |level| system.buildings_at(level).map(|b| joined[b]).collect();
    system.levels().iter().map(of_level).collect()
}

/// Raises the peak of an impact by that of one of its contacts; a velocity jump has none.
fn take_larger(peak: &mut Peak, other: Peak) {
    if peak.value.is_nan() {
        *peak = other;
    } else {
        peak.raise(other.value, other.time);
    }
}
