//! Progress and cancelling.

use std::ops::ControlFlow;
use std::sync::Arc;

use calib::watch::{Callback, Progress, watched};

use crate::Error;

/// Is told of every step of long work, on the thread that asked for it, and may end it at the next.
///
/// # Examples
/// ```
/// use std::ops::ControlFlow;
/// use stillpoint::{ErrorKind, Recording, Request, Watch, calibrate};
///
/// let (t, accel, gyro, _) = stillpoint::example::session();
/// let recording = Recording::from_arrays(&t, &accel, &gyro, None)?;
/// let patience = Watch::new(|progress| match progress.steps {
///     0..2 => ControlFlow::Continue(()),
///     _ => ControlFlow::Break(()),
/// });
/// let request = Request { watch: Some(patience), ..Request::default() };
/// assert_eq!(calibrate(&[recording], &request).unwrap_err().kind, ErrorKind::Cancelled);
/// # Ok::<(), stillpoint::Error>(())
/// ```
#[derive(Clone)]
pub struct Watch(Callback);

impl Watch {
    /// A watch that calls `told` with every step. Steps are milliseconds apart on recordings of minutes, and seconds on
    /// ten million samples.
    ///
    /// # Examples
    /// ```
    /// use std::ops::ControlFlow;
    /// use std::time::{Duration, Instant};
    ///
    /// // Ends what takes longer than a minute.
    /// let end = Instant::now() + Duration::from_secs(60);
    /// let watch = stillpoint::Watch::new(move |progress| {
    ///     println!("{}: step {}", progress.stage.name(), progress.steps);
    ///     if Instant::now() < end { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    /// });
    /// let spec = "seed = 1\n[motion.still]\nduration = 2.0\n";
    /// assert!(stillpoint::simulate(spec, Some(&watch)).is_ok());
    /// ```
    pub fn new(told: impl Fn(Progress) -> ControlFlow<()> + Send + Sync + 'static) -> Self {
        Self(Arc::new(told))
    }
}

impl std::fmt::Debug for Watch {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Watch")
    }
}

/// Runs `work`, under the watch if there is one, and returns its result.
pub(crate) fn under<T>(
    watch: Option<&Watch>,
    work: impl FnOnce() -> Result<T, calib::Error>,
) -> Result<T, Error> {
    let result = match watch {
        Some(Watch(callback)) => watched(Arc::clone(callback), work),
        None => work(),
    };
    result.map_err(Error::from)
}
