//! The linear systems of a case, one for each mode of its contact.

use super::case::{Case, Law};

/// State of the contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    Open,
    Approach,
    Restitution,
    Stuck,
    /// Not pulling, though closed.
    Released,
}

const MODES: [Mode; 5] = [
    Mode::Open,
    Mode::Approach,
    Mode::Restitution,
    Mode::Stuck,
    Mode::Released,
];

/// Where an event leads.
#[derive(Debug, Clone, Copy)]
pub enum Target {
    Mode(Mode),
    StickOrSlip,
}

type Row = Vec<f64>;

/// A linear function of the state, watched for becoming positive or for its peak.
#[derive(Debug, Clone)]
pub struct Watch {
    row: Row,
    slope: Row,
    pub is_velocity: bool,
    pub target: Target,
}

impl Watch {
    /// Its value at a state.
    pub fn value(&self, y: &[f64]) -> f64 {
        dot(&self.row, y)
    }

    /// Its rate at a state, in the mode that it is watched in.
    pub fn slope(&self, y: &[f64]) -> f64 {
        dot(&self.slope, y)
    }
}

/// The linear system of one mode.
#[derive(Debug, Clone)]
struct Linear {
    matrix: Vec<Row>,
    piece: f64,
    /// Takes a state over a whole piece.
    over_piece: Vec<Row>,
    watches: Vec<Watch>,
    observed: Vec<Watch>,
}

/// All linear systems of a case, on states of displacements, velocities, ground
/// acceleration, its slope and one.
#[derive(Debug, Clone)]
pub struct Plant {
    pub floors: usize,
    delta: Row,
    rate: Row,
    holding: Row,
    modes: Vec<Linear>,
}

impl Plant {
    /// Assembles a case.
    pub fn new(case: &Case) -> Self {
        let n = case.floor_count();
        let size = 2 * n + 3;
        let (mass, free) = free_accelerations(case);
        let (left, right) = case.floors;
        let mut side: Row = vec![0.0; n];
        side[left] = 1.0;
        if let Some(right) = right {
            side[right] = -1.0;
        }
        let effective: f64 = 1.0 / (0..n).map(|i| side[i].powi(2) / mass[i]).sum::<f64>();
        let (mut delta, mut rate) = (vec![0.0; size], vec![0.0; size]);
        delta[..n].copy_from_slice(&side);
        rate[n..2 * n].copy_from_slice(&side);
        delta[size - 1] = -case.gap;
        let mut holding = vec![0.0; size];
        for i in 0..n {
            add(&mut holding, effective * side[i], &free[i]);
        }
        let mut plant = Self {
            floors: n,
            delta,
            rate,
            holding,
            modes: Vec::new(),
        };
        for mode in MODES {
            let force = plant.force(case.law, mode, effective);
            let mut acceleration = free.clone();
            for i in 0..n {
                add(&mut acceleration[i], -side[i] / mass[i], &force);
            }
            let linear = plant.linear(case, mode, &acceleration, &force, effective);
            plant.modes.push(linear);
        }
        plant
    }

    /// The contact force of a mode.
    fn force(&self, law: Law, mode: Mode, effective: f64) -> Row {
        let (k, c) = match (law, mode) {
            (_, Mode::Open | Mode::Released) => (0.0, 0.0),
            (_, Mode::Stuck) => return self.holding.clone(),
            (Law::DryFriction { k, friction }, Mode::Approach) => (k * (1.0 + friction), 0.0),
            (Law::DryFriction { k, friction }, _) => (k * (1.0 - friction), 0.0),
            (Law::ApproachOnly { k, .. }, Mode::Restitution) | (Law::Spring { k }, _) => (k, 0.0),
            (
                Law::KelvinVoigt { k, zeta }
                | Law::NoTension { k, zeta }
                | Law::ApproachOnly { k, zeta },
                _,
            ) => (k, 2.0 * zeta * (k * effective).sqrt()),
        };
        let mut force = vec![0.0; self.delta.len()];
        add(&mut force, k, &self.delta);
        add(&mut force, c, &self.rate);
        force
    }

    fn linear(
        &self,
        case: &Case,
        mode: Mode,
        acceleration: &[Row],
        force: &Row,
        effective: f64,
    ) -> Linear {
        let n = self.floors;
        let size = self.delta.len();
        let mut matrix = vec![vec![0.0; size]; size];
        for i in 0..n {
            matrix[i][n + i] = 1.0;
            matrix[n + i] = acceleration[i].clone();
        }
        matrix[2 * n][2 * n + 1] = 1.0;
        let total = |row: &Row, range: std::ops::Range<usize>| -> f64 {
            row[range].iter().map(|x| x.abs()).sum()
        };
        let fastest = acceleration.iter().map(|row| {
            let (springs, dashpots) = (total(row, 0..n), total(row, n..2 * n));
            springs.sqrt() + dashpots
        });
        let fastest = fastest.fold(1e-9, f64::max);
        let watch = |row: Row, target: Target, is_velocity: bool| Watch {
            slope: (0..size)
                .map(|j| (0..size).map(|i| row[i] * matrix[i][j]).sum())
                .collect(),
            row,
            is_velocity,
            target,
        };
        let watches = self.ways_out(case.law, mode, effective);
        let unit = |i: usize| -> Row { (0..size).map(|j| f64::from(u8::from(i == j))).collect() };
        let mut observed: Vec<Row> = (0..n).map(unit).collect();
        let mut first = 0;
        for chain in &case.chains {
            for storey in 0..chain.mass.len() {
                let mut drift = unit(first + storey);
                if storey > 0 {
                    drift[first + storey - 1] = -1.0;
                }
                observed.push(drift);
            }
            first += chain.mass.len();
        }
        for row in acceleration {
            let mut absolute = row.clone();
            absolute[2 * n] += 1.0;
            observed.push(absolute);
        }
        observed.push(force.clone());
        observed.push(self.delta.clone());
        let target = Target::Mode(mode);
        let piece = (0.25 / fastest).min(case.time_step / 8.0);
        let columns: Vec<Row> = (0..size).map(|j| series(&matrix, unit(j), piece)).collect();
        Linear {
            piece,
            over_piece: (0..size)
                .map(|i| columns.iter().map(|column| column[i]).collect())
                .collect(),
            watches: watches
                .into_iter()
                .map(|(row, target, is_velocity)| watch(row, target, is_velocity))
                .collect(),
            observed: observed
                .into_iter()
                .map(|row| watch(row, target, false))
                .collect(),
            matrix,
        }
    }

    fn ways_out(&self, law: Law, mode: Mode, effective: f64) -> Vec<(Row, Target, bool)> {
        let to = Target::Mode;
        if mode == Mode::Open {
            return vec![(self.delta.clone(), to(Mode::Approach), false)];
        }
        let parting = (negative(&self.delta), to(Mode::Open), false);
        let turning = |target| match mode {
            Mode::Approach => (negative(&self.rate), target, true),
            _ => (self.rate.clone(), target, true),
        };
        let mut ways = vec![parting];
        match (law, mode) {
            (Law::ApproachOnly { .. }, Mode::Approach) => {
                ways.push(turning(to(Mode::Restitution)));
            }
            (Law::ApproachOnly { .. }, Mode::Restitution) => ways.push(turning(to(Mode::Approach))),
            (Law::NoTension { .. }, _) => {
                let raw = self.force(law, Mode::Approach, effective);
                ways.push(if mode == Mode::Approach {
                    (negative(&raw), to(Mode::Released), false)
                } else {
                    (raw, to(Mode::Approach), false)
                });
            }
            (Law::DryFriction { k, friction }, Mode::Stuck) => {
                let mut below = negative(&self.holding);
                add(&mut below, k * (1.0 - friction), &self.delta);
                let mut above = self.holding.clone();
                add(&mut above, -k * (1.0 + friction), &self.delta);
                ways = vec![
                    (below, to(Mode::Restitution), false),
                    (above, to(Mode::Approach), false),
                ];
            }
            (Law::DryFriction { .. }, _) => ways.push(turning(Target::StickOrSlip)),
            _ => {}
        }
        ways
    }

    fn of(&self, mode: Mode) -> &Linear {
        &self.modes[mode as usize]
    }

    /// Ways out of a mode.
    pub fn watches(&self, mode: Mode) -> &[Watch] {
        &self.of(mode).watches
    }

    /// Displacements, drifts, absolute accelerations, contact force, penetration.
    pub fn observed(&self, mode: Mode) -> &[Watch] {
        &self.of(mode).observed
    }

    /// A step (s) within which no response has more than one extremum.
    pub fn piece(&self, mode: Mode) -> f64 {
        self.of(mode).piece
    }

    /// Penetration (m).
    pub fn penetration(&self, y: &[f64]) -> f64 {
        dot(&self.delta, y)
    }

    /// Relative velocity (m/s).
    pub fn velocity(&self, y: &[f64]) -> f64 {
        dot(&self.rate, y)
    }

    /// The force that would hold the floors together (N).
    pub fn holding(&self, y: &[f64]) -> f64 {
        dot(&self.holding, y)
    }

    /// The state a time later, by the exponential series in pieces.
    pub fn advance(&self, mode: Mode, y: &[f64], time: f64) -> Vec<f64> {
        let linear = self.of(mode);
        let mut state = y.to_vec();
        let mut rest = time;
        while rest >= linear.piece {
            state = linear.over_piece.iter().map(|r| dot(r, &state)).collect();
            rest -= linear.piece;
        }
        if rest > 0.0 {
            state = series(&linear.matrix, state, rest);
        }
        state
    }
}

/// `exp(matrix h) y` by its series, until the terms vanish in every component.
fn series(matrix: &[Row], y: Row, h: f64) -> Row {
    let (mut state, mut term) = (y.clone(), y);
    for order in 1..=30 {
        let next = matrix.iter().map(|row| dot(row, &term));
        term = next.map(|x| x * h / f64::from(order)).collect();
        let mut vanished = true;
        for (s, t) in state.iter_mut().zip(&term) {
            *s += t;
            vanished &= t.abs() <= 1e-20 * s.abs();
        }
        if vanished {
            break;
        }
    }
    state
}

/// Floor masses and accelerations without contact.
fn free_accelerations(case: &Case) -> (Vec<f64>, Vec<Row>) {
    let n = case.floor_count();
    let mut mass = Vec::new();
    let mut free = Vec::new();
    for chain in &case.chains {
        let (first, storeys) = (mass.len(), chain.mass.len());
        for i in 0..storeys {
            let m = chain.mass[i];
            let mut row = vec![0.0; 2 * n + 3];
            let mut couple = |j: usize, k: f64| {
                row[first + j] -= k / m;
                row[n + first + j] -= chain.beta * k / m;
            };
            couple(i, chain.stiffness[i]);
            if i > 0 {
                couple(i - 1, -chain.stiffness[i]);
            }
            if i + 1 < storeys {
                couple(i, chain.stiffness[i + 1]);
                couple(i + 1, -chain.stiffness[i + 1]);
            }
            row[n + first + i] -= chain.alpha;
            row[2 * n] = -1.0;
            free.push(row);
        }
        mass.extend_from_slice(&chain.mass);
    }
    (mass, free)
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn add(to: &mut [f64], factor: f64, row: &[f64]) {
    for (t, r) in to.iter_mut().zip(row) {
        *t += factor * r;
    }
}

fn negative(row: &[f64]) -> Row {
    row.iter().map(|x| -x).collect()
}
