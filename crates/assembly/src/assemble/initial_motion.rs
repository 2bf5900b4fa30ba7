//! Velocities and displacements that files state at the first sample of their records.

use pounding_case::Case;
use pounding_ground_motion::Accelerogram;

/// What initial motions may leave out of a displacement of the ground (m) unsaid.
const UNSAID: f64 = 1.0e-3;

/// Records under the buildings of which some state an initial motion, which displacements of one ground relative to another, from
/// rest, leave out, in words. Motions with the same one have no such displacement.
pub(super) fn left_out(
    case: &Case,
    of_the_case: &Accelerogram,
    own: &[(usize, Accelerogram)],
) -> Vec<String> {
    let initial = |record: &Accelerogram| record.initial().unwrap_or_default();
    if own
        .iter()
        .all(|(_, record)| initial(record) == initial(of_the_case))
    {
        return Vec::new();
    }
    let own = own.iter().map(|(building, record)| {
        let name = &case.buildings[*building].name.value;
        (format!("of {name}"), record)
    });
    let records = std::iter::once(("of the case".to_owned(), of_the_case)).chain(own);
    let told = records.filter_map(|(of, record)| {
        let (velocity, displacement) = initial(record);
        let duration = record.duration();
        let left_out = displacement + velocity * duration;
        let most = displacement.abs().max(left_out.abs());
        (most > UNSAID).then(|| {
            format!(
                "the record {of} states an initial velocity of {velocity:.4} m/s and displacement of {displacement:.4} m; displacements of the ground relative to that of neighbours are from rest and leave them out, {left_out:.3} m at the end after {duration:.2} s: take a record that begins at rest, as with the pads of its filter"
            )
        })
    });
    told.collect()
}
