//! The ten problems with bounds that Ceres' tests use.
//!
//! Bounds: Gay, "A trust-region approach to linearly constrained optimization", 1984; minima as in
//! A. Neumaier's list of bound-constrained problems, some computed to more digits. Problems 11 and
//! 12 have three residuals there.

use super::fixed::*;
use crate::problems::Case;

/// Problems 3, 4, 5, 7, 9, 11, 12, 14, 16 and 18 with bounds.
pub fn bounded() -> Vec<Case> {
    vec![
        Case::new(
            "MGH03 bounded",
            PowellBadlyScaled,
            &[0.0, 1.0],
            &[1.512_593_672_438e-10],
        )
        .bounded(&[0.0, 1.0], &[1.0, 9.0]),
        Case::new("MGH04 bounded", BrownBadlyScaled, &[1.0, 1.0], &[0.784e3])
            .bounded(&[0.0, 3e-5], &[1e6, 100.0]),
        Case::new("MGH05 bounded", Beale, &[1.0, 1.0], &[0.0]).bounded(&[0.6, 0.5], &[10.0, 100.0]),
        Case::new(
            "MGH07 bounded",
            HelicalValley,
            &[-1.0, 0.0, 0.0],
            &[0.99042212],
        )
        .bounded(&[-100.0, -1.0, -1.0], &[0.8, 1.0, 1.0]),
        Case::new(
            "MGH09 bounded",
            Gaussian,
            &[0.4, 1.0, 0.0],
            &[1.127_932_769_619e-8],
        )
        .bounded(&[0.398, 1.0, -0.5], &[4.2, 2.0, 0.1]),
        Case::new(
            "MGH11 bounded",
            Gulf(3),
            &[5.0, 2.5, 0.15],
            &[5.828_143_116_789e-5],
        )
        .bounded(&[1e-16, 0.0, 0.0], &[10.0, 10.0, 10.0]),
        Case::new(
            "MGH12 bounded",
            Box3(3),
            &[0.0, 10.0, 20.0],
            &[3.099_815_343_229e-6],
        )
        .bounded(&[0.0, 5.0, 0.0], &[2.0, 9.5, 20.0]),
        Case::new(
            "MGH14 bounded",
            Wood,
            &[-3.0, -1.0, -3.0, -1.0],
            &[0.15567008e1],
        )
        .bounded(&[-100.0; 4], &[0.0, 10.0, 100.0, 100.0]),
        Case::new(
            "MGH16 bounded",
            BrownDennis,
            &[25.0, 5.0, -5.0, -1.0],
            &[0.88860479e5],
        )
        .bounded(&[-10.0, 0.0, -100.0, -20.0], &[100.0, 15.0, 0.0, 0.2]),
        Case::new(
            "MGH18 bounded",
            BiggsExp6,
            &[1.0, 2.0, 1.0, 1.0, 1.0, 1.0],
            &[0.53209865e-3],
        )
        .bounded(
            &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0],
            &[2.0, 8.0, 1.0, 7.0, 5.0, 5.0],
        ),
    ]
}
