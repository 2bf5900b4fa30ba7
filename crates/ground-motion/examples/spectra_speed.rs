//! How long the response spectra of one record at 200 periods and 5 damping ratios
//! take: `cargo run --release -p pounding-ground-motion --example spectra_speed -- RECORD
//! SAMPLES`. Writes the samples (m/s2), a line each, to the file SAMPLES for a peer; prints
//! the time step (s), the mean time of 50 repetitions (ms) at samples and with peaks
//! between them, and PSA at samples (m/s2) for 5 %.
#![allow(clippy::print_stdout)]

use std::error::Error;
use std::path::Path;
use std::sync::OnceLock;
use std::time::Instant;

use pounding_ground_motion::spectra::{Evaluation, logarithmic_periods, response_spectra};
use pounding_ground_motion::writers::{Column, Written, write_plain_columns};
use pounding_ground_motion::{ReadOptions, read};

const DAMPINGS: [f64; 5] = [0.01, 0.02, 0.05, 0.10, 0.20];
const REPETITIONS: usize = 50;

/// Time of the processor (s) on Linux, of the clock elsewhere.
fn processor_time() -> f64 {
    let spent = std::fs::read_to_string("/proc/thread-self/schedstat");
    let nanoseconds = spent
        .ok()
        .and_then(|s| s.split(' ').next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(
        || START.get_or_init(Instant::now).elapsed().as_secs_f64(),
        |n| 1.0e-9 * n,
    )
}

static START: OnceLock<Instant> = OnceLock::new();

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let (Some(record), Some(samples)) = (arguments.next(), arguments.next()) else {
        return Err("give a record and a file for its samples".into());
    };
    let record = read(Path::new(&record), &ReadOptions::default())?;
    let (text, _) = write_plain_columns(&Written::of(&record), &[Column::Value], None);
    std::fs::write(samples, text)?;
    let periods = logarithmic_periods(0.02, 10.0, 200)?;
    println!("{}", record.time_step());
    let mut accelerations = Vec::new();
    for evaluation in [Evaluation::AtSamples, Evaluation::PiecewiseLinear] {
        let start = processor_time();
        for _ in 0..REPETITIONS {
            let spectra = response_spectra(&record, &periods, &DAMPINGS, evaluation)?;
            if evaluation == Evaluation::AtSamples {
                accelerations.clone_from(&spectra[2].pseudo_acceleration);
            }
        }
        // The processor's time goes in steps of some ms: a mean, not the least.
        let mean = (processor_time() - start) / REPETITIONS as f64;
        println!("{:.2}", 1.0e3 * mean);
    }
    let shown: Vec<_> = accelerations.iter().map(|a| format!("{a:e}")).collect();
    println!("{}", shown.join(" "));
    Ok(())
}
