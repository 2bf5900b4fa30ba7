//! Long work without the interpreter's lock, which Ctrl-C ends and which says how far it is.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::channel;
use std::time::Duration;

use pounding_time_history::{History, Recorder, StepView, System, TimeHistoryError};
use pyo3::prelude::*;

/// How often signals and progress are looked at.
const INTERVAL: Duration = Duration::from_millis(50);

/// What the work and who waits for it tell one another.
#[derive(Debug, Default)]
pub struct Watch {
    stop: AtomicBool,
    done: AtomicUsize,
    total: AtomicUsize,
}

impl Watch {
    /// Whether the work has to end.
    pub fn stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// Tells how much of how much is done.
    pub fn tell(&self, done: usize, total: usize) {
        self.done.store(done, Ordering::Relaxed);
        self.total.store(total, Ordering::Relaxed);
    }

    /// The same; says whether to go on.
    pub fn ask(&self, done: usize, total: usize) -> ControlFlow<()> {
        self.tell(done, total);
        match self.stopped() {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    }
}

/// A recorder that ends the run when the work has to end. It is asked before every step, and
/// shown none until then.
#[derive(Debug)]
pub struct Stop<'w>(pub &'w Watch);

impl Stop<'_> {
    fn checked(&self) -> Result<(), TimeHistoryError> {
        match self.0.stopped() {
            false => Ok(()),
            true => Err(TimeHistoryError::Recorder("stopped".to_owned())),
        }
    }
}

impl Recorder for Stop<'_> {
    fn begin(&mut self, _system: &System, _start: &History) -> Result<(), TimeHistoryError> {
        self.checked()
    }

    fn next_time(&self) -> f64 {
        match self.0.stopped() {
            false => f64::INFINITY,
            true => f64::NEG_INFINITY,
        }
    }

    fn step(&mut self, _step: &mut StepView<'_, '_, '_>) -> Result<(), TimeHistoryError> {
        self.checked()
    }
}

/// Does `work` on a thread of its own. The calling thread gives the interpreter's lock away
/// meanwhile, but for looking after signals and for calling `progress(done, total)`; an
/// exception of either stops the work and is raised when it has ended.
///
/// # Errors
/// Such an exception, and a system that refuses the thread.
pub fn watched<T: Send>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Watch) -> T + Send,
) -> PyResult<T> {
    let watch = Watch::default();
    std::thread::scope(|scope| {
        let (sender, mut receiver) = channel();
        let shared = &watch;
        let worker = std::thread::Builder::new().spawn_scoped(scope, move || {
            let made = work(shared);
            // Who waits may have gone.
            let _ = sender.send(());
            made
        })?;
        let (mut shown, mut raised) = ((0, 0), None);
        loop {
            let waiting;
            (waiting, receiver) = py.detach(move || {
                let waiting = receiver.recv_timeout(INTERVAL);
                let waiting =
                    waiting.is_err_and(|e| e == std::sync::mpsc::RecvTimeoutError::Timeout);
                (waiting, receiver)
            });
            let now = (
                watch.done.load(Ordering::Relaxed),
                watch.total.load(Ordering::Relaxed),
            );
            let mut looked = py.check_signals();
            if let (Ok(()), Some(progress)) = (&looked, progress)
                && now != shown
            {
                shown = now;
                looked = progress.call1(now).map(drop);
            }
            if let Err(error) = looked {
                watch.stop.store(true, Ordering::Relaxed);
                raised.get_or_insert(error);
            }
            if !waiting {
                break;
            }
        }
        let made = worker.join();
        match (raised, made) {
            (Some(error), _) => Err(error),
            (None, Ok(made)) => Ok(made),
            // A panic is told as one.
            (None, Err(panic)) => std::panic::resume_unwind(panic),
        }
    })
}
