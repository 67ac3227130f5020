//! Problems 20 to 35, of any size; sizes as in the paper's tables.

use solver::{Scalar, lit};

use crate::problems::Case;
use crate::problems::case::residuals;

residuals!(/// 20.
Watson, |x, out| {
    for i in 1..=29 {
        let t = f64::from(i) / 29.0;
        let (mut slope, mut value) = (lit::<D>(0.0), lit::<D>(0.0));
        for (j, &x) in x.iter().enumerate() {
            value += x * t.powi(j as i32);
            if j > 0 {
                slope += x * (j as f64 * t.powi(j as i32 - 1));
            }
        }
        out.push(slope - value * value - lit::<D>(1.0));
    }
    out.push(x[0]);
    out.push(x[1] - x[0] * x[0] - lit::<D>(1.0));
});
residuals!(/// 21.
ExtendedRosenbrock, |x, out| {
    for pair in x.chunks_exact(2) {
        out.push((pair[1] - pair[0] * pair[0]) * 10.0);
        out.push(lit::<D>(1.0) - pair[0]);
    }
});
residuals!(/// 22.
ExtendedPowellSingular, |x, out| {
    for x in x.chunks_exact(4) {
        out.push(x[0] + x[1] * 10.0);
        out.push((x[2] - x[3]) * 5f64.sqrt());
        out.push((x[1] - x[2] * 2.0).powi(2));
        out.push((x[0] - x[3]).powi(2) * 10f64.sqrt());
    }
});
residuals!(/// 23.
Penalty1, |x, out| {
    let mut sum = lit::<D>(-0.25);
    for &x in x {
        out.push((x - lit::<D>(1.0)) * 1e-5f64.sqrt());
        sum += x * x;
    }
    out.push(sum);
});
residuals!(/// 24.
Penalty2, |x, out| {
    let n = x.len();
    let root = 1e-5f64.sqrt();
    out.push(x[0] - lit::<D>(0.2));
    for i in 1..n {
        let y = ((i as f64 + 1.0) / 10.0).exp() + (i as f64 / 10.0).exp();
        out.push(((x[i] / 10.0).exp() + (x[i - 1] / 10.0).exp() - lit::<D>(y)) * root);
    }
    for &x in &x[1..] {
        out.push(((x / 10.0).exp() - lit::<D>((-0.1f64).exp())) * root);
    }
    let weighted = x.iter().enumerate().map(|(j, &x)| x * x * (n - j) as f64);
    out.push(weighted.fold(lit::<D>(-1.0), |a, b| a + b));
});
residuals!(/// 25.
VariablyDimensioned, |x, out| {
    let mut sum = lit::<D>(0.0);
    for (i, &x) in x.iter().enumerate() {
        let d = x - lit::<D>(1.0);
        out.push(d);
        sum += d * (i as f64 + 1.0);
    }
    out.push(sum);
    out.push(sum * sum);
});
residuals!(/// 26.
Trigonometric, |x, out| {
    let n = x.len() as f64;
    let cosines = x.iter().fold(lit::<D>(0.0), |sum, x| sum + x.cos());
    for (i, &x) in x.iter().enumerate() {
        let i = i as f64 + 1.0;
        out.push(lit::<D>(n) - cosines + (lit::<D>(1.0) - x.cos()) * i - x.sin());
    }
});
residuals!(/// 27.
BrownAlmostLinear, |x, out| {
    let n = x.len();
    let sum = x.iter().fold(lit::<D>(0.0), |a, &b| a + b);
    for &x in &x[..n - 1] {
        out.push(x + sum - lit::<D>(n as f64 + 1.0));
    }
    out.push(x.iter().fold(lit::<D>(1.0), |a, &b| a * b) - lit::<D>(1.0));
});
residuals!(/// 28.
DiscreteBoundaryValue, |x, out| {
    let n = x.len();
    let h = 1.0 / (n as f64 + 1.0);
    for i in 0..n {
        let t = (i as f64 + 1.0) * h;
        let before = if i > 0 { x[i - 1] } else { lit(0.0) };
        let after = if i + 1 < n { x[i + 1] } else { lit(0.0) };
        out.push(x[i] * 2.0 - before - after + (x[i] + (t + 1.0)).powi(3) * (h * h / 2.0));
    }
});
residuals!(/// 29.
DiscreteIntegral, |x, out| {
    let n = x.len();
    let h = 1.0 / (n as f64 + 1.0);
    let t = |i: usize| (i as f64 + 1.0) * h;
    for i in 0..n {
        let mut sum = lit::<D>(0.0);
        for (j, &x) in x.iter().enumerate() {
            let weight = if j <= i { (1.0 - t(i)) * t(j) } else { t(i) * (1.0 - t(j)) };
            sum += (x + (t(j) + 1.0)).powi(3) * weight;
        }
        out.push(x[i] + sum * (h / 2.0));
    }
});
residuals!(/// 30.
BroydenTridiagonal, |x, out| {
    let n = x.len();
    for i in 0..n {
        let before = if i > 0 { x[i - 1] } else { lit(0.0) };
        let after = if i + 1 < n { x[i + 1] } else { lit(0.0) };
        out.push((lit::<D>(3.0) - x[i] * 2.0) * x[i] - before - after * 2.0 + 1.0);
    }
});
residuals!(/// 31.
BroydenBanded, |x, out| {
    let n = x.len();
    for i in 0..n {
        let first = i.saturating_sub(5);
            let band = &x[first..(i + 2).min(n)];
            let others = band.iter().enumerate().filter(|(j, _)| first + j != i);
            let sum = others.fold(lit::<D>(0.0), |sum, (_, &x)| sum + x * (x + 1.0));
            out.push(x[i] * (x[i] * x[i] * 5.0 + 2.0) + 1.0 - sum);
    }
});

/// 32, with `m = 2 n` residuals.
#[derive(Clone, Copy, Debug)]
struct LinearFullRank;

impl<D: Scalar> solver::Residual<D> for LinearFullRank {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        let m = 2 * x.len();
        let sum = x.iter().fold(lit::<D>(0.0), |a, &b| a + b) * (2.0 / m as f64);
        for i in 0..m {
            let own = x.get(i).copied().unwrap_or(lit(0.0));
            out.push(own - sum - lit::<D>(1.0));
        }
    }
}

residuals!(/// 33, with `m = 2 n` residuals.
LinearRankOne, |x, out| {
    let sum = x.iter().enumerate().fold(lit::<D>(0.0), |a, (j, &x)| a + x * (j as f64 + 1.0));
    for i in 1..=2 * x.len() {
        out.push(sum * i as f64 - lit::<D>(1.0));
    }
});
residuals!(/// 34, with `m = 2 n` residuals.
LinearRankOneZeros, |x, out| {
    let (n, m) = (x.len(), 2 * x.len());
    let inner = x.iter().enumerate().take(n - 1).skip(1);
    let sum = inner.fold(lit::<D>(0.0), |a, (j, &x)| a + x * (j as f64 + 1.0));
    for i in 0..m {
        let factor = if i == 0 || i + 1 == m { 0.0 } else { i as f64 };
        out.push(sum * factor - lit::<D>(1.0));
    }
});
residuals!(/// 35.
Chebyquad, |x, out| {
    let n = x.len();
    for i in 1..=n {
        let mut mean = lit::<D>(0.0);
        for &x in x {
            // Shifted Chebyshev polynomial of degree i by its recurrence.
            let s = x * 2.0 - lit::<D>(1.0);
            let (mut before, mut current) = (lit::<D>(1.0), s);
            for _ in 1..i {
                (before, current) = (current, s * current * 2.0 - before);
            }
            mean += current;
        }
        let degree = i as f64;
        let integral = if i % 2 == 0 { -1.0 / (degree * degree - 1.0) } else { 0.0 };
        out.push(mean / n as f64 - lit::<D>(integral));
    }
});

/// Problems 20 to 35 with their standard starts.
pub fn scalable() -> Vec<Case> {
    let ramp =
        |n: usize, f: &dyn Fn(f64) -> f64| (1..=n).map(|i| f(i as f64)).collect::<Vec<f64>>();
    let boundary = |n: usize| {
        ramp(n, &|i| {
            let t = i / (n as f64 + 1.0);
            t * (t - 1.0)
        })
    };
    let nodes = |n: usize| ramp(n, &|i| i / (n as f64 + 1.0));
    let rank_one = |m: f64| m * (m - 1.0) / (2.0 * (2.0 * m + 1.0));
    let rank_one_zeros = |m: f64| (m * m + 3.0 * m - 6.0) / (2.0 * (2.0 * m - 3.0));
    vec![
        Case::new("MGH20 Watson 6", Watson, &[0.0; 6], &[2.287_670_053_55e-3]),
        Case::new("MGH20 Watson 9", Watson, &[0.0; 9], &[1.399_760_138e-6]),
        Case::new(
            "MGH21 extended Rosenbrock 10",
            ExtendedRosenbrock,
            &[-1.2, 1.0].repeat(5),
            &[0.0],
        ),
        Case::new(
            "MGH22 extended Powell 12",
            ExtendedPowellSingular,
            &[3.0, -1.0, 0.0, 1.0].repeat(3),
            &[0.0],
        ),
        Case::new(
            "MGH23 penalty I 4",
            Penalty1,
            &ramp(4, &|i| i),
            &[2.249_977_5e-5],
        ),
        Case::new(
            "MGH23 penalty I 10",
            Penalty1,
            &ramp(10, &|i| i),
            &[7.087_651_5e-5],
        ),
        Case::new("MGH24 penalty II 4", Penalty2, &[0.5; 4], &[9.376_293e-6]),
        Case::new(
            "MGH24 penalty II 10",
            Penalty2,
            &[0.5; 10],
            &[2.936_605_4e-4],
        ),
        Case::new(
            "MGH25 variably dimensioned 10",
            VariablyDimensioned,
            &ramp(10, &|i| 1.0 - i / 10.0),
            &[0.0],
        ),
        Case::new(
            "MGH26 trigonometric 10",
            Trigonometric,
            &[0.1; 10],
            &[0.0, 2.795_056_121_88e-5],
        ),
        Case::new(
            "MGH27 Brown almost linear 10",
            BrownAlmostLinear,
            &[0.5; 10],
            &[0.0, 1.0],
        ),
        Case::new(
            "MGH28 boundary value 10",
            DiscreteBoundaryValue,
            &boundary(10),
            &[0.0],
        ),
        Case::new(
            "MGH29 integral equation 10",
            DiscreteIntegral,
            &boundary(10),
            &[0.0],
        ),
        Case::new(
            "MGH30 Broyden tridiagonal 10",
            BroydenTridiagonal,
            &[-1.0; 10],
            &[0.0],
        ),
        Case::new(
            "MGH31 Broyden banded 10",
            BroydenBanded,
            &[-1.0; 10],
            &[0.0],
        ),
        Case::new(
            "MGH32 linear full rank 10",
            LinearFullRank,
            &[1.0; 10],
            &[10.0],
        ),
        Case::new(
            "MGH33 linear rank one 10",
            LinearRankOne,
            &[1.0; 10],
            &[rank_one(20.0)],
        ),
        Case::new(
            "MGH34 linear rank one, zeros 10",
            LinearRankOneZeros,
            &[1.0; 10],
            &[rank_one_zeros(20.0)],
        ),
        Case::new("MGH35 Chebyquad 7", Chebyquad, &nodes(7), &[0.0]),
        Case::new(
            "MGH35 Chebyquad 8",
            Chebyquad,
            &nodes(8),
            &[3.516_873_725_6e-3],
        ),
        Case::new(
            "MGH35 Chebyquad 10",
            Chebyquad,
            &nodes(10),
            &[4.772_713_9e-3, 6.503_954_8e-3],
        ),
    ]
}
