//! The time, where there is a clock: a browser's WebAssembly has none and is never asked.

#[cfg(not(all(target_family = "wasm", target_os = "unknown")))]
mod with {
    use std::time::{Duration, Instant};

    /// The moment after a duration from now, if it can be told.
    pub(crate) fn after(limit: Duration) -> Option<Moment> {
        Instant::now().checked_add(limit).map(Moment)
    }

    /// A moment.
    #[derive(Clone, Copy, Debug)]
    pub(crate) struct Moment(Instant);

    impl Moment {
        /// True once it is over.
        pub fn is_past(self) -> bool {
            Instant::now() >= self.0
        }
    }

    /// Result of `f` and the seconds it took.
    pub(crate) fn timed<T>(f: impl FnOnce() -> T) -> (T, f64) {
        let clock = Instant::now();
        let value = f();
        (value, clock.elapsed().as_secs_f64())
    }
}

#[cfg(all(target_family = "wasm", target_os = "unknown"))]
mod with {
    use std::time::Duration;

    /// Without a clock no limit is ever reached.
    pub(crate) fn after(_: Duration) -> Option<Moment> {
        None
    }

    /// A moment that is never over.
    #[derive(Clone, Copy, Debug)]
    pub(crate) struct Moment;

    impl Moment {
        /// Never.
        pub fn is_past(self) -> bool {
            false
        }
    }

    /// Result of `f`; the time is not a number.
    pub(crate) fn timed<T>(f: impl FnOnce() -> T) -> (T, f64) {
        (f(), f64::NAN)
    }
}

pub(crate) use with::{Moment, after, timed};
