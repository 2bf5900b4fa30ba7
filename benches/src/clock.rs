//! Processor time.

/// Processor time of this thread (s); elapsed time where the system does not tell.
#[cfg(unix)]
pub(crate) fn thread_seconds() -> f64 {
    let now = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    now.tv_sec as f64 + 1.0e-9 * now.tv_nsec as f64
}

/// Processor time of this thread (s); elapsed time where the system does not tell.
#[cfg(not(unix))]
pub(crate) fn thread_seconds() -> f64 {
    static START: std::sync::OnceLock<std::time::Instant> = std::sync::OnceLock::new();
    START
        .get_or_init(std::time::Instant::now)
        .elapsed()
        .as_secs_f64()
}

/// Processor time of all threads of this process (s); elapsed time where the system does
/// not tell.
#[cfg(unix)]
pub(crate) fn process_seconds() -> f64 {
    let now = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    now.tv_sec as f64 + 1.0e-9 * now.tv_nsec as f64
}

/// Processor time of all threads of this process (s); elapsed time where the system does
/// not tell.
#[cfg(not(unix))]
pub(crate) fn process_seconds() -> f64 {
    thread_seconds()
}

/// The least.
pub(crate) fn least(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::INFINITY, f64::min)
}

/// The middle one; NaN of none.
pub(crate) fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let n = sorted.len();
    match n {
        0 => f64::NAN,
        _ if n % 2 == 1 => sorted[n / 2],
        _ => 0.5 * (sorted[n / 2 - 1] + sorted[n / 2]),
    }
}
