//! Pictures of runs, studies, laboratories and motions: what each command draws.

pub mod collision;
pub mod comparison;
pub mod floor_spectrum;
pub mod gap;
pub mod hysteresis;
pub mod ida;
pub mod motion;
pub mod run;

use crate::figure::{Curve, Panel};

/// Axes with these curves.
fn panel(caption: &str, horizontal: &str, curves: Vec<Curve>) -> Panel {
    Panel {
        caption: caption.to_owned(),
        horizontal: horizontal.to_owned(),
        curves,
    }
}

/// A curve over given places, its values times a factor.
fn over(name: &str, x: &[f64], y: &[f64], factor: f64) -> Curve {
    Curve {
        name: name.to_owned(),
        points: x.iter().zip(y).map(|(x, y)| (*x, y * factor)).collect(),
    }
}
