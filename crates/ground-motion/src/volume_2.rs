//! Volume 2, corrected: acceleration, velocity and displacement of each channel.

use crate::draft::{Draft, DraftUnit, ROW, several};
use crate::error::GroundMotionError;
use crate::number;
use crate::origin::Processing;
use crate::quantity::Quantity;
use crate::recording::Series;
use crate::source::Source;
use crate::text::Lines;
use crate::time_column::Times;
use crate::volume::{ChannelHeader, Label, end_of_channel, peak_line};

const TEXT_LINES: usize = 25;
const REALS: usize = 100;
/// Reals that hold the length (s) of the record as it was digitised and of the corrected
/// series: processing may cut off an end.
const RAW_LENGTH: usize = 3;
const LENGTH: usize = 60;
/// Real that holds the step (s).
const STEP: usize = 61;

/// Reads all channels.
pub(crate) fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    let mut lines = source.lines();
    let mut series: Vec<Series> = Vec::new();
    let mut channels = 0;
    while let Some(header) = ChannelHeader::read(source, &mut lines, TEXT_LINES, REALS)? {
        channels += 1;
        let first = series.len();
        let (channel, component) = header.agreed_component(source, 8)?;
        while lines
            .peek()
            .is_some_and(|l| l.is_text() && !l.bytes.trim_ascii_start().starts_with(b"/"))
        {
            let mut draft = block(source, &mut lines, &header)?;
            draft.component.clone_from(&component);
            draft.channel = channel.unwrap_or(channels);
            series.push(draft.finish(source)?);
        }
        if series.len() == first {
            return Err(source.error(
                lines.number() + 1,
                0,
                format!(
                    "no block of data in the channel that starts in line {}",
                    header.first()
                ),
                "the header has lines too many or too few: get the record again",
            ));
        }
        initial(&mut series[first..]);
        end_of_channel(source, &mut lines);
    }
    Ok(series)
}

fn block(
    source: &Source<'_>,
    lines: &mut Lines<'_>,
    header: &ChannelHeader<'_>,
) -> Result<Draft, GroundMotionError> {
    let line = source.expect(lines, "the line before a block")?;
    let label = Label::parse(source, line)?;
    let samples = source.block(lines, label.layout, Some(label.count), None)?;
    let mut draft = Draft::new(
        samples,
        DraftUnit::Stated(label.unit),
        (line.number, line.number + 1, lines.number()),
    );
    draft.header_count = Some(label.count);
    draft.row = several(label.layout.per_line);
    draft.times = Times::Step(Some(label.step.0));
    draft.peak = peak_line(header, label.quantity);
    draft.processing = Processing::Corrected;
    draft.title = header.title(7, 3);
    draft.start_time = header.start_time();
    draft.corners = (header.reals.positive(62), header.reals.positive(73));
    draft.header_durations = header.duration_in_numbers(LENGTH).into_iter().collect();
    if let Some(words) = header.duration_in_words() {
        let [raw, own] = [RAW_LENGTH, LENGTH].map(|index| header.reals.positive(index));
        draft.state_in_words(words, raw, own);
    }
    let index = match label.quantity {
        Quantity::Acceleration => 53,
        Quantity::Velocity => 64,
        Quantity::Displacement => 66,
    };
    // Five columns cannot hold a count of six digits, and Caltech leaves the
    // counts of velocity and displacement to their blocks.
    if label.quantity == Quantity::Acceleration {
        let in_numbers = header.integers.count(index);
        let in_numbers = in_numbers.filter(|_| label.count < 100_000);
        let in_numbers = in_numbers.map(|count| (header.integers.line_of(index), count));
        for (at, count) in in_numbers.into_iter().chain(count_in_words(header)) {
            if count == label.count {
                continue;
            }
            let message = format!(
                "{} samples follow here, but line {at} says {count}",
                label.count
            );
            let difference = count.abs_diff(label.count);
            count_differs(source, &mut draft, line.number, difference, message)?;
        }
    }
    let of_numbers = header.reals.positive(STEP);
    let of_numbers = of_numbers.map(|step| (header.reals.line_of(STEP), step));
    let differs = |(_, step): &(usize, f64)| (step - label.step.0).abs() > label.step.1;
    if let Some((at, step)) = of_numbers
        .into_iter()
        .chain(step_in_words(header))
        .find(differs)
    {
        let message = format!(
            "the step is {} s here, but {step} s in line {at}",
            label.step.0
        );
        draft.step_conflict = Some((
            line.number,
            message,
            "the header contradicts itself: get the record again, or set `lenient = true` to use the first".to_owned(),
        ));
    }
    Ok(draft)
}

/// The count of `2674  INSTRUMENT AND BASELINE CORRECTED DATA`, with its line.
fn count_in_words(header: &ChannelHeader<'_>) -> Option<(usize, usize)> {
    let (line, text) = header.find_line("baseline")?;
    let count = text.split_whitespace().next()?.parse().ok()?;
    text.contains("corrected").then_some((line, count))
}

/// The step (s) of `AT EQUALLY-SPACED INTERVALS OF .020 SEC.`, with its line.
fn step_in_words(header: &ChannelHeader<'_>) -> Option<(usize, f64)> {
    let key = "spaced intervals of";
    let (line, text) = header.find_line(key)?;
    let (step, _) = number::stated(&text, key)?;
    (step > 0.0).then_some((line, step))
}

/// Counts of samples that differ by no more than a last row holds are said, others refused.
fn count_differs(
    source: &Source<'_>,
    draft: &mut Draft,
    line: usize,
    by: usize,
    message: String,
) -> Result<(), GroundMotionError> {
    if by > ROW {
        return source.contradiction(line, message);
    }
    draft.warnings.push(format!("line {line}: {message}"));
    Ok(())
}

/// Initial velocity and displacement of the acceleration: the first values of
/// their blocks, for Caltech prints the others with the opposite sign.
fn initial(channel: &mut [Series]) {
    let first = |q: Quantity| {
        channel
            .iter()
            .find(|s| s.quantity == q)
            .and_then(|s| s.samples.first().copied())
    };
    let Some(velocity) = first(Quantity::Velocity) else {
        return;
    };
    let displacement = first(Quantity::Displacement).unwrap_or(0.0);
    for s in channel {
        if s.quantity == Quantity::Acceleration {
            s.initial = Some((velocity, displacement));
        }
    }
}
