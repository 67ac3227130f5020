//! Colours of plots on light and on dark pages.

use plotters::style::RGBColor;

/// The page that a plot is drawn for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Theme {
    /// Dark ink on white.
    Light,
    /// Light ink on near black.
    Dark,
}

/// Distinguishable with every kind of colour vision (Okabe and Ito, Color universal design, 2008);
/// black, which comes first there, is the ink here.
const SERIES: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(128, 128, 128),
];

/// The dark blue is lost on black: its lighter sister takes its place there.
const FIRST_ON_DARK: RGBColor = RGBColor(86, 180, 233);
const SIXTH_ON_DARK: RGBColor = RGBColor(100, 143, 255);

impl Theme {
    pub(super) fn background(self) -> RGBColor {
        match self {
            Self::Light => RGBColor(255, 255, 255),
            Self::Dark => RGBColor(22, 24, 28),
        }
    }

    pub(super) fn ink(self) -> RGBColor {
        match self {
            Self::Light => RGBColor(32, 33, 36),
            Self::Dark => RGBColor(226, 228, 233),
        }
    }

    pub(super) fn grid(self) -> RGBColor {
        match self {
            Self::Light => RGBColor(208, 211, 217),
            Self::Dark => RGBColor(66, 71, 80),
        }
    }

    pub(super) fn fine_grid(self) -> RGBColor {
        match self {
            Self::Light => RGBColor(237, 239, 242),
            Self::Dark => RGBColor(36, 39, 45),
        }
    }

    pub(super) fn series(self, k: usize) -> RGBColor {
        match (self, k % SERIES.len()) {
            (Self::Dark, 0) => FIRST_ON_DARK,
            (Self::Dark, 5) => SIXTH_ON_DARK,
            (_, k) => SERIES[k],
        }
    }
}
