//! The time that a run takes: a run in a page that does not end soon is stopped.

/// Milliseconds since some moment.
#[cfg(not(target_arch = "wasm32"))]
pub(crate) fn now() -> f64 {
    use std::sync::LazyLock;
    use std::time::Instant;
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    START.elapsed().as_secs_f64() * 1.0e3
}

#[cfg(target_arch = "wasm32")]
pub(crate) use crate::interface::now;
