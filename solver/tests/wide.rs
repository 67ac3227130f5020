//! The dual numbers of the graph beside those of num-dual.

use stillpoint_solver::scalar::{derivatives, jet};
use stillpoint_solver::{DualNum, LANES, Scalar, Wide};

/// Every function of a scalar, at `x` (in (0, 1)) and `y`.
fn all<D: Scalar>(x: D, y: D) -> Vec<D> {
    let sum: D = [x, y, x].into_iter().sum();
    let product: D = [x, y, x].into_iter().product();
    let mut changed = x;
    changed += y;
    changed *= y;
    changed -= x;
    changed /= y;
    changed += 2.0;
    changed *= 3.0;
    changed -= 0.5;
    changed /= 7.0;
    let (sine, cosine) = x.sin_cos();
    vec![
        x + y,
        x - y,
        x * y,
        x / y,
        x + 2.0,
        x - 2.0,
        x * 2.0,
        x / 2.0,
        -x,
        sum,
        product,
        changed,
        sine,
        cosine,
        x.recip(),
        x.powi(-3),
        x.powi(0),
        x.powi(1),
        x.powi(2),
        x.powi(5),
        x.powf(2.5),
        x.powf(0.0),
        x.powf(1.0),
        x.powf(2.0),
        x.powd(y),
        x.sqrt(),
        x.cbrt(),
        x.exp(),
        x.exp2(),
        x.exp_m1(),
        x.ln(),
        x.log(3.0),
        x.log2(),
        x.log10(),
        x.ln_1p(),
        x.sin(),
        x.cos(),
        x.tan(),
        x.asin(),
        x.acos(),
        x.atan(),
        DualNum::atan2(&x, y),
        x.sinh(),
        x.cosh(),
        x.tanh(),
        x.asinh(),
        (x + 1.0).acosh(),
        x.atanh(),
        x.sph_j0(),
        x.sph_j1(),
        x.sph_j2(),
        x.mul_add(y, x),
        num_traits::Signed::abs(&-x),
        num_traits::Signed::signum(&-x),
        num_traits::Signed::abs_sub(&x, &y),
    ]
}

#[test]
fn every_function_of_a_wide_number_is_that_of_num_dual() {
    // Nearer to zero the spherical Bessel functions cancel, in num-dual as here.
    for (x, y) in [(0.3, 1.7), (0.8, -0.4), (0.4, 0.02)] {
        let (of_x, of_y) = ([1.0, 0.25, 0.0, -2.0], [-0.5, 1.0, 0.0, 0.3]);
        let wide = |re, slopes| Wide::<LANES> { re, slopes };
        let found = all(wide(x, of_x), wide(y, of_y));
        let wanted = all(jet(x, of_x), jet(y, of_y));
        for (k, (found, wanted)) in found.iter().zip(&wanted).enumerate() {
            let values = [(found.re, wanted.re)].into_iter();
            let slopes = found.slopes.into_iter().zip(derivatives(wanted));
            for (a, b) in values.chain(slopes) {
                let near = (a - b).abs() <= 1e-12 * (1.0 + b.abs());
                assert!(near || a.is_nan() && b.is_nan(), "{k}: {a} {b}");
            }
        }
    }
}

#[test]
fn what_is_held_has_no_derivative_where_a_function_is_steep() {
    let x = Wide::<2> {
        re: 0.0,
        slopes: [0.0, 1.0],
    };
    assert_eq!(x.sqrt().slopes, [0.0, f64::INFINITY]);
}
