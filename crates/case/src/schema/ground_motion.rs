//! The keys of the record and of what is done to it.

use super::{Key, Kind, key, needed};

pub(crate) const GROUND_MOTION: &[Key] = &[
    needed(
        "file",
        Kind::Text,
        "Record, relative to the folder of the case file",
    ),
    key(
        "format",
        Kind::Text,
        "Name of the format, such as peer_at2 or plain_columns; found from the content by default",
    ),
    key(
        "time_step",
        Kind::Quantity,
        "Time step (s), for files that do not state it, and for uneven times",
    ),
    key(
        "unit",
        Kind::Text,
        "Unit of the values, for files that do not state it",
    ),
    key(
        "layout",
        Kind::Text,
        "Plain columns: \"a\", or names such as \"t,ns,ew\"",
    ),
    key(
        "component",
        Kind::Text,
        "Component to use: its name in the file, its azimuth, or its channel number",
    ),
    key(
        "second_component",
        Kind::Text,
        "The other component of the file, for `rotate`",
    ),
    key(
        "rotate",
        Kind::Quantity,
        "Angle (degrees, a plain number) by which two components at right angles are turned, first towards second; the first is used",
    ),
    key(
        "quantity",
        Kind::Text,
        "acceleration, the only quantity that excites buildings",
    ),
    key(
        "skip_lines",
        Kind::Count(0),
        "Plain columns: lines to skip at the start",
    ),
    key(
        "skip_columns",
        Kind::Count(0),
        "Plain columns: characters to skip at the start of each line",
    ),
    key(
        "prepend_zero",
        Kind::Flag,
        "The first value is at one time step, after a zero",
    ),
    key(
        "lenient",
        Kind::Flag,
        "Accept fewer samples than the header says",
    ),
    key(
        "sensitivity",
        Kind::Quantity,
        "Counts per m/s2 of the whole channel, for records in counts",
    ),
    key(
        "gravity",
        Kind::Quantity,
        "The g (m/s2) of records in units of gravity, by default 9.80665",
    ),
    key(
        "offset",
        Kind::Text,
        "What becomes of the mean: automatic (taken off raw records, kept in corrected ones), keep or remove",
    ),
    key(
        "process",
        Kind::Steps(PROCESS),
        "What is done to the record, in this order, before it is scaled",
    ),
    key(
        "scale",
        Kind::Scale,
        "A factor, or a table such as { pga = \"0.35 g\" }",
    ),
];

/// The root of a text that holds nothing but steps.
pub(crate) const STEPS: &[Key] = &[needed(
    "process",
    Kind::Steps(PROCESS),
    "What is done to a record, in this order",
)];

pub(crate) const PROCESS: &[Key] = &[
    key(
        "true_unit",
        Kind::Text,
        "The values, taken as m/s2, are in truth in this unit",
    ),
    key("sign", Kind::Text, "\"reversed\" turns the sign"),
    key(
        "remove_offset",
        Kind::TextOr(REMOVE_OFFSET, &[&["pre_event"], &["value"]]),
        "Takes \"mean\", the mean of the time before the event, or a value off all samples",
    ),
    key(
        "filter",
        Kind::Table(FILTER),
        "Butterworth filter: high-pass, low-pass, or both",
    ),
    key(
        "baseline",
        Kind::Choice(
            BASELINE,
            &[
                &["acceleration"],
                &["velocity"],
                &["start", "end"],
                &["threshold"],
            ],
        ),
        "Corrects the baseline",
    ),
    key(
        "trim",
        Kind::Choice(TRIM, &[&["end"], &["arias_from", "arias_to"]]),
        "Keeps a part",
    ),
    key(
        "taper",
        Kind::Table(TAPER),
        "Brings the ends to zero by half a cosine",
    ),
    key(
        "pad",
        Kind::Table(PAD),
        "Puts zeros before and after: after, for free vibration",
    ),
    key("resample", Kind::Table(RESAMPLE), "Changes the time step"),
    key("scale", Kind::Scale, "Scales"),
];

pub(crate) const REMOVE_OFFSET: &[Key] = &[
    key(
        "pre_event",
        Kind::Quantity,
        "Length of the time before the event (s), whose mean is taken off",
    ),
    key("value", Kind::Quantity, "Value to take off (m/s2)"),
];

pub(crate) const FILTER: &[Key] = &[
    key(
        "high_pass",
        Kind::Quantity,
        "High-pass (low-cut) corner (Hz)",
    ),
    key(
        "low_pass",
        Kind::Quantity,
        "Low-pass (high-cut) corner (Hz)",
    ),
    key(
        "order",
        Kind::Count(1),
        "Order of each pass and side, by default 4",
    ),
    key(
        "phase",
        Kind::Text,
        "zero (default: forward and backward) or causal (forward)",
    ),
    key(
        "keep_pads",
        Kind::Flag,
        "Zero phase: whether the zeros put at both ends stay, by default true",
    ),
];

pub(crate) const BASELINE: &[Key] = &[
    key(
        "acceleration",
        Kind::Count(0),
        "Degree, 0 to 5, of a polynomial that is fitted to the acceleration and taken off",
    ),
    key(
        "velocity",
        Kind::Count(1),
        "Degree, 1 to 5, of a polynomial that is fitted to the velocity, whose derivative is taken off",
    ),
    key(
        "start",
        Kind::Quantity,
        "Two segments: start t1 of the first (s)",
    ),
    key(
        "end",
        Kind::Quantity,
        "Two segments: end t2 of the first (s)",
    ),
    key(
        "threshold",
        Kind::Quantity,
        "Two segments: from the first to the last sample at this acceleration (m/s2)",
    ),
    key(
        "fit_from",
        Kind::Quantity,
        "Two segments: start of the fit (s), by default t2",
    ),
];

pub(crate) const TRIM: &[Key] = &[
    key("start", Kind::Quantity, "Start (s), by default 0"),
    key("end", Kind::Quantity, "End (s)"),
    key(
        "arias_from",
        Kind::Quantity,
        "Part of the Arias intensity at the start, such as 0.001",
    ),
    key(
        "arias_to",
        Kind::Quantity,
        "Part of the Arias intensity at the end, such as 0.999",
    ),
];

pub(crate) const TAPER: &[Key] = &[
    key("start", Kind::Quantity, "Length at the start (s)"),
    key("end", Kind::Quantity, "Length at the end (s)"),
];

pub(crate) const PAD: &[Key] = &[
    key("before", Kind::Quantity, "Length before (s)"),
    key("after", Kind::Quantity, "Length after (s)"),
];

pub(crate) const RESAMPLE: &[Key] = &[
    needed("time_step", Kind::Quantity, "New time step (s)"),
    key(
        "interpolation",
        Kind::Text,
        "linear (default) or band_limited",
    ),
];

pub(crate) const SCALE: &[Key] = &[
    key("factor", Kind::Quantity, "Factor (-)"),
    key("pga", Kind::Quantity, "Peak ground acceleration (m/s2)"),
    key("pgv", Kind::Quantity, "Peak ground velocity (m/s)"),
    key(
        "psa",
        Kind::Quantity,
        "Pseudo-acceleration (m/s2) at `period`",
    ),
    key("period", Kind::Quantity, "Period of `psa` (s)"),
    key(
        "target",
        Kind::Text,
        "File of a spectrum (header period_s,psa_g) to come near to from `from` to `to`",
    ),
    key("from", Kind::Quantity, "First period of the band (s)"),
    key("to", Kind::Quantity, "Last period of the band (s)"),
    key(
        "damping",
        Kind::Quantity,
        "Damping ratio of `psa` or `target`, by default 0.05",
    ),
];

/// The ways to scale a record, each with its first key as name.
pub(crate) const SCALE_KINDS: &[&[&str]] = &[
    &["factor"],
    &["pga"],
    &["pgv"],
    &["psa", "period"],
    &["target", "from", "to"],
];
