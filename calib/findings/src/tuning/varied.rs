//! A tuning constant as the study of them has it: one of them times a factor, in the whole process.

use std::sync::{Mutex, OnceLock};

/// The one that is varied, and by what factor.
static VARIED: OnceLock<(String, f64)> = OnceLock::new();

/// Those that were asked for, with their values.
static REACHED: Mutex<Vec<(&'static str, f64)>> = Mutex::new(Vec::new());

/// A number that decides. [`tuning!`](crate::tuning!) states a table of them.
#[derive(Debug)]
pub struct Tuning<T> {
    name: &'static str,
    value: T,
    used: OnceLock<T>,
}

/// A number that a study can vary.
pub trait Vary: Copy {
    /// The number times a factor, whole where it counts.
    fn times(self, factor: f64) -> Self;

    /// The number, for a table.
    fn number(self) -> f64;
}

impl Vary for f64 {
    fn times(self, factor: f64) -> Self {
        self * factor
    }

    fn number(self) -> f64 {
        self
    }
}

macro_rules! whole {
    ($($number:ty)+) => {
        $(impl Vary for $number {
            fn times(self, factor: f64) -> Self {
                (self as f64 * factor).round() as Self
            }

            fn number(self) -> f64 {
                self as f64
            }
        })+
    };
}

whole!(usize i32 u32 u64);

impl<T: Vary> Tuning<T> {
    /// A constant of this name and value.
    pub const fn new(name: &'static str, value: T) -> Self {
        Self {
            name,
            value,
            used: OnceLock::new(),
        }
    }

    /// Its value, times the factor where it is the one that is varied.
    pub fn get(&self) -> T {
        *self.used.get_or_init(|| {
            if let Ok(mut reached) = REACHED.lock() {
                reached.push((self.name, self.value.number()));
            }
            match VARIED.get() {
                Some((name, factor)) if name == self.name => self.value.times(*factor),
                _ => self.value,
            }
        })
    }
}

/// Varies a constant by a factor. It has to be said before the constant is asked for, once in a process.
pub fn vary(name: &str, factor: f64) {
    let _ = VARIED.set((name.to_owned(), factor));
}

/// The constants that were asked for so far, with their values, by name.
pub fn reached() -> Vec<(&'static str, f64)> {
    let mut reached = REACHED.lock().map(|all| all.clone()).unwrap_or_default();
    reached.sort_by(|a, b| a.0.cmp(b.0));
    reached
}

/// States tuning constants, each with its meaning.
#[macro_export]
macro_rules! tuning {
    ($($(#[doc = $meaning:literal])* $seen:vis $name:ident: $number:ty = $value:expr;)+) => {
        $(
            $(#[doc = $meaning])*
            $seen static $name: $crate::Tuning<$number> =
                $crate::Tuning::new(concat!(module_path!(), "::", stringify!($name)), $value);
        )+
    };
}
