//! Fractiles of samples.

/// The 16, 50 and 84 % fractiles, linear between ordered values; NaN without any.
#[must_use]
pub fn fractiles(mut values: Vec<f64>) -> [f64; 3] {
    values.sort_by(f64::total_cmp);
    [0.16, 0.5, 0.84].map(|p| fractile(&values, p))
}

/// A fractile of values in rising order, linear between them; NaN without any, and for what is no probability.
#[must_use]
pub fn fractile(sorted: &[f64], probability: f64) -> f64 {
    let Some(last) = sorted.len().checked_sub(1) else {
        return f64::NAN;
    };
    if !(0.0..=1.0).contains(&probability) {
        return f64::NAN;
    }
    let place = probability * last as f64;
    let below = place.floor() as usize;
    let above = (below + 1).min(last);
    let part = place - below as f64;
    // Half the way to an infinite value is infinite, no way at all is none.
    if part == 0.0 || sorted[below] == sorted[above] {
        return sorted[below];
    }
    sorted[below] + part * (sorted[above] - sorted[below])
}

#[cfg(test)]
mod tests {
    use super::{fractile, fractiles};

    #[test]
    fn what_is_no_probability_has_no_fractile() {
        let values = [1.0, 2.0, 3.0];
        assert_eq!(fractile(&values, 1.0), 3.0);
        for p in [-0.1, 1.5, f64::NAN] {
            assert!(fractile(&values, p).is_nan());
        }
    }

    /// By hand: places 0.16, 0.5 and 0.84 of the way from the first to the last value.
    #[test]
    fn fractiles_reach_into_collapses_only_where_they_lie_there() {
        let f = f64::INFINITY;
        let near = |found: f64, wanted: f64| (found - wanted).abs() < 1e-14;
        let [low, middle, high] = fractiles(vec![3.0, 1.0, 2.0]);
        assert!(near(low, 1.32) && near(middle, 2.0) && near(high, 2.68));
        let [low, middle, high] = fractiles(vec![f, 1.0, 2.0]);
        assert!(near(low, 1.32) && near(middle, 2.0) && high == f);
        assert_eq!(fractiles(vec![f, f, 2.0]), [f, f, f]);
        assert_eq!(fractiles(vec![f, f]), [f, f, f]);
        assert!(fractiles(Vec::new()).iter().all(|x| x.is_nan()));
    }
}
