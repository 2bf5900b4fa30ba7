//! Measured curves that fall, which no Iwan density follows.

use pounding_catalogue::numbers::significant;

use super::density::LAW;
use super::measured_curve::MeasuredCurve;
use crate::error::HysteresisError;

/// Root mean square of the relative errors, of the best of all curves that never fall, up to which a fall is
/// noise.
const NOISE: f64 = 0.1;

/// A curve that falls by more than noise.
#[derive(Debug, Clone, PartialEq)]
pub struct Fall {
    curve: MeasuredCurve,
    /// The pair, amplitude or deformation (m) and energy (J) or force (N), from which it falls most.
    pub from: (f64, f64),
    /// The pair to which it does.
    pub to: (f64, f64),
    /// Place of that pair among the data.
    pub place: usize,
    /// Root mean square of the relative errors of the best curve that never falls.
    pub misfit: f64,
}

impl Fall {
    /// The largest fall of measured pairs of positive numbers, if the best of all curves that never fall has
    /// relative errors of more than 10 % (root mean square).
    #[must_use]
    pub fn of(curve: MeasuredCurve, measured: &[(f64, f64)]) -> Option<Self> {
        let mut order: Vec<usize> = (0..measured.len()).collect();
        order.sort_by(|a, b| measured[*a].0.total_cmp(&measured[*b].0));
        let misfit = misfit_of_never_falling(order.iter().map(|i| measured[*i].1));
        if !(misfit > NOISE) {
            return None;
        }
        let first = *order.first()?;
        let mut highest = measured[first];
        let (mut least_left, mut from, mut place) = (1.0, highest, first);
        for at in order {
            let pair = measured[at];
            if pair.1 / highest.1 < least_left {
                (least_left, from, place) = (pair.1 / highest.1, highest, at);
            }
            if pair.1 > highest.1 {
                highest = pair;
            }
        }
        Some(Self {
            curve,
            from,
            to: measured[place],
            place,
            misfit,
        })
    }

    /// What to do about it.
    #[must_use]
    pub fn remedy(&self) -> &'static str {
        self.curve.remedy()
    }
}

impl std::fmt::Display for Fall {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (what, over) = match self.curve {
            MeasuredCurve::Dissipation => ("energy", "amplitude"),
            MeasuredCurve::Backbone => ("force", "deformation"),
        };
        let pair = |(reach, value): (f64, f64)| {
            format!(
                "{} {} at {} mm",
                significant(value),
                self.curve.unit(),
                significant(1.0e3 * reach)
            )
        };
        write!(
            f,
            "the measured {what} falls with the {over}, from {} to {}, and that of law {LAW} never does: the best of all curves that never fall misses the data by {:.0} % (root mean square), and up to {:.0} % count as noise",
            pair(self.from),
            pair(self.to),
            100.0 * self.misfit,
            100.0 * NOISE
        )
    }
}

impl From<Fall> for HysteresisError {
    fn from(fall: Fall) -> Self {
        Self::Measured {
            reason: fall.to_string(),
            remedy: fall.remedy(),
        }
    }
}

/// Root mean square of the relative errors of the best sequence that never falls, by pooling what falls (Ayer et
/// al., Annals of Mathematical Statistics 26 (1955) 641).
fn misfit_of_never_falling(values: impl Iterator<Item = f64> + Clone) -> f64 {
    /// Values with one level `m`: the least sum of `(m/y - 1)^2` is at `sum 1/y / sum 1/y^2`.
    struct Pool {
        count: usize,
        inverses: f64,
        squares: f64,
    }
    impl Pool {
        fn level(&self) -> f64 {
            self.inverses / self.squares
        }
    }
    // Inverses of what is measured in N, near one.
    let Some(unit) = values.clone().reduce(f64::max) else {
        return 0.0;
    };
    let mut pools: Vec<Pool> = Vec::new();
    for value in values.clone() {
        let inverse = unit / value;
        let mut last = Pool {
            count: 1,
            inverses: inverse,
            squares: inverse * inverse,
        };
        while let Some(before) = pools.pop_if(|before| before.level() > last.level()) {
            last.count += before.count;
            last.inverses += before.inverses;
            last.squares += before.squares;
        }
        pools.push(last);
    }
    let levels = pools
        .iter()
        .flat_map(|pool| std::iter::repeat_n(pool.level(), pool.count));
    let (count, sum) = values
        .zip(levels)
        .map(|(value, level)| (level * unit / value - 1.0).powi(2))
        .fold((0_usize, 0.0), |(count, sum), miss| (count + 1, sum + miss));
    (sum / count as f64).sqrt()
}
