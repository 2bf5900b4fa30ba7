//! Histories with fewer points that look the same.

/// Points of a history, at most four for each of `columns` equal parts of it: the first, the
/// minimum, the maximum and the last, in order. Peaks stay where they are.
pub(crate) fn decimated(points: &[(f64, f64)], columns: usize) -> Vec<(f64, f64)> {
    if points.len() <= 4 * columns {
        return points.to_vec();
    }
    let size = points.len().div_ceil(columns);
    let mut kept = Vec::with_capacity(4 * columns);
    for part in points.chunks(size) {
        let by_value = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
        let extremes = [
            part.first(),
            part.iter().min_by(by_value),
            part.iter().max_by(by_value),
            part.last(),
        ];
        let mut few: Vec<(f64, f64)> = extremes.into_iter().flatten().copied().collect();
        few.sort_by(|a, b| a.0.total_cmp(&b.0));
        few.dedup();
        kept.extend(few);
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn peaks_and_order_are_kept() {
        let mut points: Vec<(f64, f64)> = (0..100_000)
            .map(|i| (f64::from(i), (f64::from(i) * 0.01).sin()))
            .collect();
        points[54_321].1 = 7.0;
        points[12_345].1 = -3.0;
        let few = decimated(&points, 500);
        assert!(few.len() <= 2000);
        assert!(few.contains(&(54_321.0, 7.0)) && few.contains(&(12_345.0, -3.0)));
        assert!(few.windows(2).all(|p| p[0].0 < p[1].0));
        assert_eq!((few[0], few[few.len() - 1]), (points[0], points[99_999]));
        assert_eq!(decimated(&points[..100], 500), points[..100]);
    }
}
