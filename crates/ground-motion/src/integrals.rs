//! Accelerations, velocities and displacements of one channel held against one another.

use crate::error::{bound, rounded};
use crate::recording::{Sampling, Series};

/// Steps on either side among which the largest change counts: what a change is compared with.
const NEIGHBOURS: usize = 10;
/// Part of the largest change of all that counts as least: smaller ones are lost in printed digits.
const LEAST: f64 = 0.05;
/// Part of the changes around by which a change may differ from the integral. Agencies
/// integrate by other rules than the trapezoidal, which leaves 0.35 of the changes of a weak
/// vertical component of frequencies near that of the sampling.
const TOLERANCE: f64 = 0.7;

/// Says of every series where the integral of the same channel in the same file (velocities of
/// accelerations, displacements of velocities) does not follow from it: one of them is damaged.
pub(crate) fn compare(series: &mut [Series]) {
    for index in 0..series.len() {
        let of = &series[index];
        let is_integral = |s: &&Series| {
            Some(s.quantity) == of.quantity.integral()
                && s.channel == of.channel
                && s.component == of.component
        };
        let said = series
            .iter()
            .find(is_integral)
            .and_then(|integral| difference(of, integral));
        series[index].origin.warnings.extend(said);
    }
}

/// What to say of a series whose integral does not follow from it.
fn difference(of: &Series, integral: &Series) -> Option<String> {
    let (Sampling::Even { time_step: step }, Sampling::Even { time_step: long }) =
        (&of.sampling, &integral.sampling)
    else {
        return None;
    };
    // Agencies print integrals at multiples of the step.
    let each = (long / step).round();
    if !(each >= 1.0 && (long / step - each).abs() < 1.0e-3) {
        return None;
    }
    let each = each as usize;
    let trapezoids = |w: &[f64]| {
        w.windows(2)
            .map(|a| 0.5 * step * (a[0] + a[1]))
            .sum::<f64>()
    };
    let changes: Vec<(f64, f64)> = integral
        .samples
        .windows(2)
        .enumerate()
        .map_while(|(i, v)| {
            let over = of.samples.get(i * each..=(i + 1) * each)?;
            Some((v[1] - v[0], trapezoids(over)))
        })
        .collect();
    let size = |(change, expected): &(f64, f64)| change.abs().max(expected.abs());
    let largest = |of: &[(f64, f64)]| of.iter().map(size).fold(0.0, f64::max);
    let least = LEAST * largest(&changes);
    let differs = |&i: &usize| {
        let (change, expected) = changes[i];
        let around = i.saturating_sub(NEIGHBOURS)..(i + NEIGHBOURS + 1).min(changes.len());
        (change - expected).abs() > TOLERANCE * largest(&changes[around]).max(least)
    };
    // The first value may be that of before the record.
    let places: Vec<usize> = (1..changes.len()).filter(differs).collect();
    let first = *places.first()?;
    let (change, expected) = changes[first];
    let unit = integral.quantity.si_symbol();
    let [change, expected] = [change, expected].map(|x| rounded(x, 4));
    let [start, end] = [first, first + 1].map(|i| bound(i as f64 * long));
    let more = match places.len() - 1 {
        0 => String::new(),
        1 => ", and in one more step".to_owned(),
        more => format!(", and in {more} more steps"),
    };
    Some(format!(
        "from {start} s to {end} s the {0} of this channel changes by {change} {unit}, where its {1} gives {expected} {unit}{more}: one of them is damaged, or they were not processed alike; get the record again",
        integral.quantity, of.quantity,
    ))
}
