//! Steps of recorders that no run has.

use pounding::prelude::*;
use pounding::time_history::{HistorySink, TimeHistoryError};

use crate::pair;

/// A sink that counts rows and keeps none.
struct Count {
    rows: usize,
    most: f64,
}

impl HistorySink for Count {
    fn most_bytes(&self) -> f64 {
        self.most
    }

    fn take(&mut self, rows: &mut History) -> Result<(), TimeHistoryError> {
        self.rows += rows.len();
        Ok(())
    }
}

#[test]
fn steps_that_are_none_are_refused() {
    for step in [0.0, -0.0, -0.01, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let error = GridRecorder::new(step).unwrap_err();
        assert!(
            matches!(
                error,
                TimeHistoryError::Option {
                    option: "output_step",
                    ..
                }
            ),
            "{error}"
        );
        let help = Error::from(error).help().unwrap();
        assert!(help.contains("recorder"), "{help}");
    }
}

/// A grid that would fill the memory ends the run before its first step, and is no matter of a short run.
#[test]
fn steps_that_are_too_many_are_refused() {
    let model = pair().build().unwrap();
    for step in [1e-9, 1e-12, 1e-300, f64::MIN_POSITIVE, f64::from_bits(1)] {
        let mut recorder = GridRecorder::new(step).unwrap();
        let error = model.run_with(&mut [&mut recorder]).unwrap_err();
        let Error::Run(TimeHistoryError::ResponsesTooLarge {
            step: told,
            bytes,
            most,
            ..
        }) = &error
        else {
            panic!("{error}");
        };
        assert!(*told == step && bytes > most, "{error}");
        assert!(error.help().unwrap().contains("longer steps"));
        assert!(recorder.responses.is_empty());
    }
    let short = RunOptions {
        duration: Some(1e-6),
        ..*model.options()
    };
    let short = model.with_options(short).unwrap();
    let mut recorder = GridRecorder::new(1e-9).unwrap();
    short.run_with(&mut [&mut recorder]).unwrap();
    assert_eq!(recorder.responses.len(), 1001);
}

/// Who keeps no rows may take as many as there are.
#[test]
fn a_sink_says_how_much_it_takes() {
    let model = pair().duration(Time::seconds(1.0)).build().unwrap();
    for (most, rows) in [(1e3, None), (f64::INFINITY, Some(1001))] {
        let mut recorder = GridRecorder::into_sink(1e-3, Count { rows: 0, most }).unwrap();
        let ran = model.run_with(&mut [&mut recorder]);
        assert_eq!(ran.is_ok(), rows.is_some());
        assert_eq!(recorder.responses.rows, rows.unwrap_or_default());
    }
}
