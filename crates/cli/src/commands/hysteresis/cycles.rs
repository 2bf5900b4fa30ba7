//! The table of a loop.

use pounding_catalogue::numbers::significant;
use pounding_hysteresis::laboratory::Loop;
use pounding_report::{CYCLE_COLUMNS, cycle_cells};

use crate::tables::new_table;

/// The cycles in a table, below what they are.
pub fn text(driven: &Loop, description: &str) -> String {
    let mut table = new_table(std::iter::once("cycle").chain(CYCLE_COLUMNS));
    for (i, cycle) in driven.cycles.iter().enumerate() {
        table.add_row(std::iter::once((i + 1).to_string()).chain(cycle_cells(cycle)));
    }
    let total = format!(
        "maximum force {} kN, dissipated in all {} J\n",
        significant(1.0e-3 * driven.maximum_force()),
        significant(driven.dissipated())
    );
    if driven.cycles.is_empty() {
        return format!("\nThe history closes no cycle.\n{total}");
    }
    format!("\n{description}\n{table}\n{total}")
}
