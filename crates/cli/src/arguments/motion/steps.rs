//! Steps of processing, in the order of the command line.

use clap::{Arg, ArgAction, ArgMatches, Command, Error, FromArgMatches};

/// Steps as given: key of the case file's `process` list, and value.
#[derive(Debug, Clone, Default)]
pub struct StepArguments(pub Vec<(&'static str, String)>);

/// Key, option, form of the value, explanation.
const STEPS: [(&str, &str, &str, &str); 10] = [
    (
        "true_unit",
        "true-unit",
        "UNIT",
        "The values as the file prints them are in this unit, whatever unit it states",
    ),
    ("sign", "sign", "reversed", "Turn the sign"),
    (
        "remove_offset",
        "remove-offset",
        "mean | pre_event=2 s | value=0.01 m/s^2",
        "Take a constant off",
    ),
    (
        "filter",
        "filter",
        "high_pass=0.1 Hz, low_pass=25 Hz, order=4, phase=zero|causal, keep_pads=true",
        "Butterworth filter",
    ),
    (
        "baseline",
        "baseline",
        "acceleration=DEGREE | velocity=DEGREE | start=T1, end=T2, fit_from=T | threshold=0.5 m/s^2",
        "Correct the baseline by a polynomial or two segments",
    ),
    (
        "trim",
        "trim",
        "start=2 s, end=30 s | arias_from=0.001, arias_to=0.999",
        "Keep a part",
    ),
    (
        "taper",
        "taper",
        "start=1 s, end=2 s",
        "Bring the ends to zero by half a cosine",
    ),
    (
        "pad",
        "pad",
        "before=2 s, after=10 s",
        "Put zeros before and after",
    ),
    (
        "resample",
        "resample",
        "time_step=0.005 s, interpolation=linear|band_limited",
        "Change the time step",
    ),
    (
        "scale",
        "scale",
        "FACTOR | pga=0.35 g | pgv=0.4 m/s | psa=0.8 g, period=1 s | target=FILE, from=0.2 s, to=2 s | code=eurocode_8_2004, ag=0.25 g, ground_type=C | code=asce_7_2016, s_ds=1 g, s_d1=0.6 g, t_l=8 s",
        "Scale",
    ),
];

impl FromArgMatches for StepArguments {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let mut found = Vec::new();
        for (key, ..) in STEPS {
            let values = matches.get_many::<String>(key).into_iter().flatten();
            let places = matches.indices_of(key).into_iter().flatten();
            found.extend(places.zip(values).map(|(at, v)| (at, key, v.clone())));
        }
        found.sort_by_key(|(at, ..)| *at);
        Ok(Self(
            found
                .into_iter()
                .map(|(_, key, value)| (key, value))
                .collect(),
        ))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl clap::Args for StepArguments {
    fn augment_args(command: Command) -> Command {
        STEPS
            .into_iter()
            .fold(command, |command, (key, option, form, help)| {
                command.arg(
                    Arg::new(key)
                        .long(option)
                        .value_name(form)
                        .help(help)
                        .action(ArgAction::Append)
                        .allow_hyphen_values(true)
                        .help_heading("Steps, done in the order given, each may be repeated"),
                )
            })
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}
