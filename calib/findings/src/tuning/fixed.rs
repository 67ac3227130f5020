//! A tuning constant as programs have it: the number alone.

/// A number that decides. [`tuning!`](crate::tuning!) states a table of them.
#[derive(Clone, Copy, Debug)]
pub struct Tuning<T>(T);

impl<T: Copy> Tuning<T> {
    /// A constant of this value.
    pub const fn new(value: T) -> Self {
        Self(value)
    }

    /// Its value.
    pub const fn get(&self) -> T {
        self.0
    }
}

/// States tuning constants, each with its meaning.
#[macro_export]
macro_rules! tuning {
    ($($(#[doc = $meaning:literal])* $seen:vis $name:ident: $number:ty = $value:expr;)+) => {
        $(
            $(#[doc = $meaning])*
            $seen const $name: $crate::Tuning<$number> = $crate::Tuning::new($value);
        )+
    };
}
