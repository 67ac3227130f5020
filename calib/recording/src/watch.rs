//! Progress of long work, and its end on request.
//!
//! A watch belongs to the thread that calls [`watched`]. The work reports to it between its steps and ends at the next
//! step once it is told to: thirty functions lie between a call and its steps, and none of them has a word to say about it.

use std::cell::RefCell;
use std::ops::ControlFlow;
use std::sync::Arc;

use crate::error::Error;

/// Stage of the work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Stage {
    /// Static intervals and turns of a recording are looked for.
    Cutting,
    /// A model is fitted.
    Fitting,
    /// A model with one more effect is fitted.
    Searching,
    /// Samples are simulated.
    Simulating,
    /// Readings are corrected.
    Correcting,
}

impl Stage {
    /// Returns the name for a line of progress.
    pub fn name(self) -> &'static str {
        match self {
            Self::Cutting => "cutting",
            Self::Fitting => "fitting",
            Self::Searching => "searching",
            Self::Simulating => "simulating",
            Self::Correcting => "correcting",
        }
    }
}

/// One step of the work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Stage of the work.
    pub stage: Stage,
    /// Steps of any stage before this one. How many there will be depends on the data.
    pub steps: usize,
}

/// Is told of every step; `Break` ends the work.
pub type Callback = Arc<dyn Fn(Progress) -> ControlFlow<()> + Send + Sync>;

struct Watch {
    callback: Callback,
    steps: usize,
    ended: bool,
}

thread_local! {
    static WATCH: RefCell<Option<Watch>> = const { RefCell::new(None) };
}

/// Puts the watch before back, however the work ends.
struct Restored(Option<Watch>);

impl Drop for Restored {
    fn drop(&mut self) {
        WATCH.with(|watch| *watch.borrow_mut() = self.0.take());
    }
}

/// Runs `work` and reports its steps to `callback`.
///
/// # Errors
/// [`Error::Cancelled`] if the callback ended the work; otherwise the error of `work`.
///
/// # Examples
/// ```
/// use std::ops::ControlFlow;
/// use std::sync::Arc;
/// use stillpoint_recording::watch::{Stage, step, watched};
///
/// let never = Arc::new(|_| ControlFlow::Break(()));
/// let ended = watched(never, || (0..100).try_for_each(|_| step(Stage::Fitting)));
/// assert!(ended.unwrap_err().to_string().contains("cancelled"));
/// ```
pub fn watched<T>(callback: Callback, work: impl FnOnce() -> Result<T, Error>) -> Result<T, Error> {
    let watch = Watch {
        callback,
        steps: 0,
        ended: false,
    };
    let _restored = Restored(WATCH.with(|own| own.borrow_mut().replace(watch)));
    let result = work();
    // Where a step may fail and others are tried its error is not handed on.
    let ended = WATCH.with(|watch| watch.borrow().as_ref().is_some_and(|watch| watch.ended));
    if ended { Err(Error::Cancelled) } else { result }
}

/// Between two steps of the work.
///
/// # Errors
/// [`Error::Cancelled`] once the work is to end.
pub fn step(stage: Stage) -> Result<(), Error> {
    // The callback may do such work itself.
    let told = WATCH.with(|watch| {
        let mut watch = watch.borrow_mut();
        let watch = watch.as_mut()?;
        let steps = watch.steps;
        watch.steps += 1;
        Some((Arc::clone(&watch.callback), steps, watch.ended))
    });
    let Some((callback, steps, ended)) = told else {
        return Ok(());
    };
    if !ended && callback(Progress { stage, steps }).is_continue() {
        return Ok(());
    }
    WATCH.with(|watch| {
        if let Some(watch) = watch.borrow_mut().as_mut() {
            watch.ended = true;
        }
    });
    Err(Error::Cancelled)
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;

    #[test]
    fn work_that_is_to_end_ends_at_the_next_step_and_swallows_nothing() {
        let seen = Arc::new(AtomicUsize::new(0));
        let count = Arc::clone(&seen);
        let third: Callback = Arc::new(move |_| match count.fetch_add(1, Ordering::Relaxed) {
            2 => ControlFlow::Break(()),
            _ => ControlFlow::Continue(()),
        });
        let ended = watched(third, || {
            // One step's failure is another's chance: the end is none of these.
            let done = (0..10).filter(|_| step(Stage::Fitting).is_ok()).count();
            Ok(done)
        });
        assert!(matches!(ended, Err(Error::Cancelled)));
        assert_eq!(seen.load(Ordering::Relaxed), 3);
        assert!(step(Stage::Fitting).is_ok());
    }
}
