//! Time: a run in a page that does not end soon is stopped, and the day decides between editions
//! of codes. A module in a page knows no time but that of its host.

#[cfg(target_arch = "wasm32")]
use crate::interface;
use pounding_separation::Date;

/// Milliseconds since some moment.
#[cfg(not(target_arch = "wasm32"))]
pub(crate) fn now() -> f64 {
    use std::sync::LazyLock;
    use std::time::Instant;
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    START.elapsed().as_secs_f64() * 1.0e3
}

/// Milliseconds since the beginning of 1970.
#[cfg(target_arch = "wasm32")]
pub(crate) fn now() -> f64 {
    interface::now()
}

/// Today in universal time; `None` where the host tells a day beyond the calendar.
pub(crate) fn today() -> Option<Date> {
    #[cfg(target_arch = "wasm32")]
    return Date::of_day((now() / 86.4e6).floor() as i32);
    #[cfg(not(target_arch = "wasm32"))]
    return Date::today();
}
