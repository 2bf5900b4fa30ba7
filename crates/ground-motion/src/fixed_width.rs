//! Rows of numbers of fixed width.

use crate::cut_numbers::Forms;
use crate::error::GroundMotionError;
use crate::fortran::Layout;
use crate::number;
use crate::source::{REMEDY_VALUE, Source};
use crate::text::{Line, Lines};

impl Source<'_> {
    /// Appends the numbers of a line of fixed width. A tab in it means that
    /// somebody saved it again: its fields are then split at blanks.
    pub(crate) fn row(
        &self,
        line: Line<'_>,
        layout: Layout,
        values: &mut Vec<f64>,
    ) -> Result<(), GroundMotionError> {
        if line.bytes.contains(&b'\t') {
            self.warn("tabs where columns must be: the rows were split at blanks and tabs");
            for (column, field) in line.fields() {
                values.push(self.field(line, column, field, layout)?);
            }
            return Ok(());
        }
        let end = layout.margin + layout.per_line * layout.width;
        if line.bytes.len() > end {
            return Err(self.error(
                line.number,
                end,
                format!(
                    "more than {} numbers of {} columns",
                    layout.per_line, layout.width
                ),
                REMEDY_VALUE,
            ));
        }
        let (margin, fields) = line.bytes.split_at(layout.margin.min(line.bytes.len()));
        if !(layout.skips || margin.trim_ascii().is_empty()) {
            return Err(self.error(
                line.number,
                0,
                format!("the first {} columns must be blank", layout.margin),
                REMEDY_VALUE,
            ));
        }
        for (i, field) in fields.chunks(layout.width).enumerate() {
            let column = layout.margin + i * layout.width;
            if field.len() < layout.width {
                return Err(self.error(
                    line.number,
                    column,
                    format!(
                        "\"{}\" is cut off: a number takes {} columns",
                        number::shown(field),
                        layout.width
                    ),
                    "the file is damaged or truncated: get it again",
                ));
            }
            if !field[..layout.gap].trim_ascii().is_empty() {
                let message = format!("{} columns before each number must be blank", layout.gap);
                return Err(self.error(line.number, column, message, REMEDY_VALUE));
            }
            values.push(self.field(line, column, field, layout)?);
        }
        Ok(())
    }

    /// Takes the forms of the numbers of a line of fixed width into account.
    pub(crate) fn see_row(&self, line: Line<'_>, layout: Layout, forms: &mut Forms) {
        let mut see = |(column, field)| {
            forms.see(line.number, column + self.options.skip_columns, field);
        };
        match line.bytes.contains(&b'\t') {
            true => line.fields().for_each(&mut see),
            false => layout.fields(line.bytes).for_each(&mut see),
        }
    }

    /// Numbers of fixed width up to the next line of text or one that starts with
    /// `/` or `|`; at most `most` of them, when the count alone tells
    /// where they end.
    pub(crate) fn block(
        &self,
        lines: &mut Lines<'_>,
        layout: Layout,
        expected: Option<usize>,
        most: Option<usize>,
    ) -> Result<Vec<f64>, GroundMotionError> {
        let room = lines.remaining() / layout.width + 1;
        let mut values = Vec::with_capacity(room.min(expected.unwrap_or(0)));
        let mut forms = Forms::of(layout);
        while most.is_none_or(|n| values.len() < n)
            && let Some(line) = lines.peek()
        {
            let start = line.bytes.trim_ascii_start().first();
            if line.is_text() || matches!(start, Some(b'/' | b'|')) {
                break;
            }
            lines.next();
            self.row(line, layout, &mut values)?;
            self.see_row(line, layout, &mut forms);
        }
        forms.are_whole(self)?;
        Ok(values)
    }
}
