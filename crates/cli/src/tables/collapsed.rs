//! Records under which buildings collapse without contact.

use pounding_catalogue::wording::counted;
use pounding_study::gap_check::CollapsedRecord;

/// Such records that are named.
const NAMED: usize = 20;

/// The records, beside so many under which all buildings stand, with what that makes of them: a text that
/// goes on with "are of the others".
pub fn collapsed((records, standing): (&[CollapsedRecord], usize), consequence: &str) -> String {
    let fallen = records.len();
    if fallen == 0 {
        return String::new();
    }
    let mut text = format!(
        "\nCollapse without contact under {fallen} of {}{consequence} are of the {} under which all buildings stand\n",
        counted(fallen + standing, "record"),
        match standing {
            1 => "one".to_owned(),
            some => some.to_string(),
        }
    );
    for record in records.iter().take(NAMED) {
        text.push_str(&format!("  {}: {}\n", record.name, record.diagnosis));
    }
    if fallen > NAMED {
        text.push_str("  ... --json names all of them\n");
    }
    text
}
