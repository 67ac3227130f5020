//! Progress of long work, and its end on request.
//!
//! A request holds a watch and hands it to the work, which reports its steps to it and ends at the next one once it is told to.

use std::fmt;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

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

/// Watch over long work; by default nobody watches. Clones share it.
///
/// # Examples
/// ```
/// use std::ops::ControlFlow;
/// use stillpoint_recording::watch::{Stage, Watch};
///
/// let never = Watch::new(|_| ControlFlow::Break(()));
/// let ended = never.over(|| (0..100).try_for_each(|_| never.step(Stage::Fitting)));
/// assert!(ended.unwrap_err().to_string().contains("cancelled"));
/// ```
#[derive(Clone, Default)]
pub struct Watch(Option<Arc<Watched>>);

struct Watched {
    told: Box<dyn Fn(Progress) -> ControlFlow<()> + Send + Sync>,
    steps: AtomicUsize,
    ended: AtomicBool,
}

impl Watch {
    /// A watch that tells `told` of every step; `Break` ends the work.
    pub fn new(told: impl Fn(Progress) -> ControlFlow<()> + Send + Sync + 'static) -> Self {
        Self(Some(Arc::new(Watched {
            told: Box::new(told),
            steps: AtomicUsize::new(0),
            ended: AtomicBool::new(false),
        })))
    }

    /// The watch over one call, where there is one: its steps count from the call, whatever became of those before.
    pub fn of_call(watch: Option<&Self>) -> Self {
        match watch.and_then(|watch| watch.0.clone()) {
            Some(watched) => Self::new(move |progress| (watched.told)(progress)),
            None => Self::default(),
        }
    }

    /// Between two steps of the work.
    ///
    /// # Errors
    /// [`Error::Cancelled`] once the work is to end.
    pub fn step(&self, stage: Stage) -> Result<(), Error> {
        let Some(watched) = &self.0 else {
            return Ok(());
        };
        let steps = watched.steps.fetch_add(1, Ordering::Relaxed);
        let goes_on = || (watched.told)(Progress { stage, steps }).is_continue();
        if !watched.ended.load(Ordering::Relaxed) && goes_on() {
            return Ok(());
        }
        watched.ended.store(true, Ordering::Relaxed);
        Err(Error::Cancelled)
    }

    /// Runs `work`, which takes its steps under this watch, and returns its result.
    ///
    /// # Errors
    /// [`Error::Cancelled`] if the work was ended, also where it took that for the failure of one way of many; otherwise the error of
    /// `work`.
    pub fn over<T>(&self, work: impl FnOnce() -> Result<T, Error>) -> Result<T, Error> {
        let result = work();
        let ended = self.0.as_ref();
        match ended.is_some_and(|watched| watched.ended.load(Ordering::Relaxed)) {
            true => Err(Error::Cancelled),
            false => result,
        }
    }
}

impl fmt::Debug for Watch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Watch")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_that_is_to_end_ends_at_the_next_step_and_swallows_nothing() {
        let seen = Arc::new(AtomicUsize::new(0));
        let count = Arc::clone(&seen);
        let third = Watch::new(move |_| match count.fetch_add(1, Ordering::Relaxed) {
            2 => ControlFlow::Break(()),
            _ => ControlFlow::Continue(()),
        });
        let ended = third.over(|| {
            // One step's failure is another's chance: the end is none of these.
            let done = (0..10)
                .filter(|_| third.step(Stage::Fitting).is_ok())
                .count();
            Ok(done)
        });
        assert!(matches!(ended, Err(Error::Cancelled)));
        assert_eq!(seen.load(Ordering::Relaxed), 3);
        assert!(Watch::default().step(Stage::Fitting).is_ok());
        assert!(Watch::of_call(Some(&third)).step(Stage::Fitting).is_ok());
    }
}
