//! Masing's rule with wiping-out: loops from a backbone and a stack of turning points.
//!
//! From a turning point the force follows the backbone doubled in both directions
//! (Masing 1926). A branch that returns to the turning point before it closes the
//! inner loop, which is forgotten; a branch from the first turning point meets the
//! backbone at its mirror image. This is exactly what sliders in parallel do, so
//! energy needs no bookkeeping of loops: along a branch of length L they dissipate
//! twice `slip_work(L / 2)`.

use crate::descriptor::LawDescriptor;
use crate::history::{Branch, History, Point};
use crate::path::PathLaw;

/// A backbone for loading from the new state, on the positive side.
pub(crate) trait Backbone: Send + Sync + std::fmt::Debug {
    fn law_descriptor(&self) -> &'static LawDescriptor;

    /// Deformations, growing, at which the formula of the backbone changes.
    fn corners(&self) -> &[f64];

    /// Force and slope by the formula of segment `segment`, which ends at the corner
    /// of that number; continued smoothly outside the segment.
    fn force(&self, segment: usize, deformation: f64) -> (f64, f64);

    /// Energy (J) dissipated on the way from zero to this deformation.
    fn slip_work(&self, deformation: f64) -> f64;

    /// Energy (J) stored at this deformation on the backbone.
    fn stored(&self, deformation: f64) -> f64;
}

/// A law that follows a backbone by Masing's rule.
#[derive(Debug)]
pub(crate) struct Masing<B> {
    pub backbone: B,
}

/// Where the held branch begins, and by how much it is stretched against the
/// backbone (1 on the backbone itself, 2 on a branch).
fn origin(history: &History) -> (Point, f64) {
    match history.reversals.last() {
        None => (Point::default(), 1.0),
        Some(point) => (*point, 2.0),
    }
}

/// Distance from the origin of the branch on the scale of the backbone, signed.
fn reach(history: &History, deformation: f64) -> f64 {
    let (from, stretch) = origin(history);
    (deformation - from.deformation) / stretch
}

impl<B: Backbone> Masing<B> {
    /// Sets the segment and the ends of the held branch at this deformation.
    fn settle(&self, history: &mut History, direction: f64, deformation: f64) {
        let (from, stretch) = origin(history);
        let advanced = direction * reach(history, deformation);
        let corners = self.backbone.corners();
        let segment = corners.iter().take_while(|c| advanced >= **c).count();
        self.bound(history, direction, segment, from, stretch);
    }

    /// Puts the element on a segment of the held branch, up to its corner or to
    /// where the loop closes.
    fn bound(
        &self,
        history: &mut History,
        direction: f64,
        segment: usize,
        from: Point,
        stretch: f64,
    ) {
        let corner = self.backbone.corners().get(segment);
        let corner = corner.map_or(f64::INFINITY, |c| {
            direction * from.deformation + stretch * c
        });
        let end = direction * closure(history, direction);
        let branch = Branch::line(segment as u8, direction, from, 0.0);
        history.branch = branch
            .towards(direction)
            .between(f64::NEG_INFINITY, corner.min(end));
    }

    /// Energy dissipated along the held branch up to this deformation.
    fn along(&self, history: &History, deformation: f64) -> f64 {
        let (_, stretch) = origin(history);
        stretch * self.backbone.slip_work(reach(history, deformation).abs())
    }
}

/// Deformation at which the held branch meets the one it broke away from.
fn closure(history: &History, direction: f64) -> f64 {
    match history.reversals.as_slice() {
        [] => direction * f64::INFINITY,
        [first] => -first.deformation,
        [.., before, _] => before.deformation,
    }
}

impl<B: Backbone> PathLaw for Masing<B> {
    fn law_descriptor(&self) -> &'static LawDescriptor {
        self.backbone.law_descriptor()
    }
    fn stiffness_when_new(&self) -> f64 {
        self.on_branch(&self.begin(), 0.0).1
    }
    fn begin(&self) -> History {
        let mut history = History::new(Branch::default());
        self.settle(&mut history, 1.0, 0.0);
        history
    }
    fn on_branch(&self, history: &History, deformation: f64) -> (f64, f64) {
        let (from, stretch) = origin(history);
        let reach = reach(history, deformation);
        let segment = usize::from(history.branch.kind);
        // Odd continuation: behind its origin a branch is its own mirror image.
        let (force, slope) = self.backbone.force(segment, reach.abs());
        let force = if reach < 0.0 { -force } else { force };
        (from.force + stretch * force, slope)
    }
    fn work(&self, history: &History, deformation: f64) -> f64 {
        self.stored(history, deformation) + self.dissipated(history, deformation)
    }
    fn stored(&self, history: &History, deformation: f64) -> f64 {
        // Every turning point begins a branch whose sliders share the springs of the
        // branch before; energies along the path are exact integrals of the force.
        let mut stored = 0.0;
        let mut at = Point::default();
        for (i, point) in history.reversals.iter().enumerate() {
            stored += self.gain(i, at, point.deformation);
            at = *point;
        }
        stored + self.gain(history.reversals.len(), at, deformation)
    }
    fn dissipated(&self, history: &History, deformation: f64) -> f64 {
        history.dissipated + self.along(history, deformation)
    }
    fn turn(&self, history: &mut History, deformation: f64) {
        let (force, _) = self.on_branch(history, deformation);
        let direction = -history.branch.direction;
        history.dissipated += self.along(history, deformation);
        history.reversals.push(Point { deformation, force });
        let (from, stretch) = origin(history);
        let first = self.backbone.corners().iter().take_while(|c| **c <= 0.0);
        let segment = first.count();
        self.bound(history, direction, segment, from, stretch);
    }
    fn leave(&self, history: &mut History, end: f64) {
        let at = if end > 0.0 {
            history.branch.upper
        } else {
            history.branch.lower
        };
        if at != closure(history, end) {
            let (from, stretch) = origin(history);
            let segment = usize::from(history.branch.kind) + 1;
            self.bound(history, end, segment, from, stretch);
            return;
        }
        history.dissipated += self.along(history, at);
        let open = history.reversals.len();
        history.reversals.truncate(open.saturating_sub(2));
        history.dissipated -= self.along(history, at);
        self.settle(history, end, at);
    }
}

impl<B: Backbone> Masing<B> {
    /// Change of stored energy along the branch that begins at `from` after
    /// `reversals` turning points, up to this deformation: the work of the force
    /// less the dissipation.
    fn gain(&self, reversals: usize, from: Point, deformation: f64) -> f64 {
        let way = deformation - from.deformation;
        let stretch = if reversals == 0 { 1.0 } else { 2.0 };
        // Work of the doubled backbone is four times that of the backbone, its
        // dissipation twice.
        let half = (way / stretch).abs();
        let (stored, slip) = (self.backbone.stored(half), self.backbone.slip_work(half));
        if reversals == 0 {
            stored
        } else {
            from.force * way + 4.0 * stored + 2.0 * slip
        }
    }
}
