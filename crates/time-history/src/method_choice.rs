//! The integration methods that can be chosen, with their parameters.

/// Default relative tolerance of the adaptive pair, as a method of its own and inside
/// contacts of the event-driven one.
pub const DEFAULT_RELATIVE_TOLERANCE: f64 = 1.0e-10;

/// The integration method with its parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum MethodChoice {
    /// Adaptive explicit Runge-Kutta 8(5,3). Errors of a step are held below
    /// `relative_tolerance` times the value, or times 0.01 m and 0.1 m/s where
    /// values are smaller than that.
    Adaptive {
        /// Relative tolerance (-).
        relative_tolerance: f64,
    },
    /// Exact between impacts, a Taylor series to round-off in contacts whose law is
    /// affine and while storeys and links are on straight branches of their laws, the
    /// adaptive pair in all others.
    EventDriven {
        /// Relative tolerance of the adaptive pair (-).
        relative_tolerance: f64,
    },
    /// Newmark (1959, J. Eng. Mech. Div. 85 (3) 67) with a fixed step.
    Newmark {
        /// Step (s).
        step: f64,
        /// Weight of the acceleration in the displacement.
        beta: f64,
        /// Weight of the acceleration in the velocity.
        gamma: f64,
    },
    /// HHT-alpha (Hilber, Hughes and Taylor 1977, Earthq. Eng. Struct. Dyn. 5, 283) with a fixed step; beta and gamma follow from alpha.
    HhtAlpha {
        /// Step (s).
        step: f64,
        /// Between -1/3 and 0.
        alpha: f64,
    },
    /// Classical Runge-Kutta with a fixed step.
    RungeKutta4 {
        /// Step (s).
        step: f64,
    },
    /// Time stepping of Moreau and Jean for rigid impacts, which are not located.
    MoreauJean {
        /// Step (s).
        step: f64,
        /// Weight of the end of a step, 1/2 to 1.
        theta: f64,
    },
}
