//! Systems of equations: CUTEst, MINPACK-2 (Averick, Carter, Moré and Xue, 1992), Moré's collection of
//! 1990, and singular ones.

use solver::{Residual, Scalar, lit};

use crate::problems::Case;
use crate::problems::case::residuals;

/// YATP1 and YATP2, Toint 2003: `n × n` unknowns with row and column conditions, and multipliers.
#[derive(Clone, Copy, Debug)]
struct Yatp {
    size: usize,
    second: bool,
}

impl<D: Scalar> Residual<D> for Yatp {
    fn residuals(&self, v: &[D], out: &mut Vec<D>) {
        let n = self.size;
        let (x, multipliers) = v.split_at(n * n);
        let (y, z) = multipliers.split_at(n);
        let part = |x: D| {
            if self.second {
                x + x.sin()
            } else {
                x.sin() / x
            }
        };
        for i in 0..n {
            for j in 0..n {
                let (x, both) = (x[i * n + j], y[i] + z[j]);
                out.push(if self.second {
                    x - both * (x.cos() + 1.0) - lit::<D>(1.0)
                } else {
                    x.powi(3) - x * x * 10.0 - both * (x * x.cos() - x.sin())
                });
            }
        }
        for i in 0..n {
            let row = (0..n).fold(lit::<D>(-1.0), |s, j| s + part(x[i * n + j]));
            let column = (0..n).fold(lit::<D>(-1.0), |s, j| s + part(x[j * n + i]));
            out.extend([row, column]);
        }
    }
}

/// EIGENA, EIGENB, EIGENC: `A = Qᵀ D Q` with `Qᵀ Q = I`, lower triangles.
#[derive(Clone, Copy, Debug)]
struct Eigen(fn(usize, usize) -> f64);

impl<D: Scalar> Residual<D> for Eigen {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        let p = 4;
        let (q, d) = x.split_at(p * p);
        for i in 0..p {
            for j in 0..=i {
                let (mut first, mut second) = (lit::<D>(0.0), lit::<D>(0.0));
                for k in 0..p {
                    let product = q[k * p + i] * q[k * p + j];
                    first += product * d[k];
                    second += product;
                }
                out.push(first - lit::<D>((self.0)(i, j)));
                out.push(second - lit::<D>(if i == j { 1.0 } else { 0.0 }));
            }
        }
    }
}

/// MSQRTA and MSQRTB: a square root of a matrix.
#[derive(Clone, Copy, Debug)]
struct MatrixRoot {
    zero: bool,
}

impl<D: Scalar> Residual<D> for MatrixRoot {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        let p = 4;
        let known = |k: usize| match k {
            8 if self.zero => 0.0,
            k => ((k + 1) as f64).powi(2).sin(),
        };
        for i in 0..p {
            for j in 0..p {
                let mut sum = lit::<D>(0.0);
                for k in 0..p {
                    sum += x[i * p + k] * x[k * p + j];
                    sum -= lit::<D>(known(i * p + k) * known(k * p + j));
                }
                out.push(sum);
            }
        }
    }
}

residuals!(/// Human heart dipole of MINPACK-2.
Dipole, |x, out| {
    let [a, b, c, d, t, u, v, w] = [x[0], x[1], x[2], x[3], x[4], x[5], x[6], x[7]];
    let (ts, us, vs, ws) = (t * t, u * u, v * v, w * w);
    out.push(a + b - lit::<D>(0.485));
    out.push(c + d + 0.0019);
    out.push(t * a + u * b - v * c - w * d + 0.0581);
    out.push(v * a + w * b + t * c + u * d - lit::<D>(0.015));
    out.push(a * (ts - vs) - c * t * v * 2.0 + b * (us - ws) - d * u * w * 2.0 - lit::<D>(0.105));
    out.push(c * (ts - vs) + a * t * v * 2.0 + d * (us - ws) + b * u * w * 2.0 - lit::<D>(0.0406));
    out.push(a * t * (ts - vs * 3.0) + c * v * (vs - ts * 3.0) + b * u * (us - ws * 3.0)
        + d * w * (ws - us * 3.0) - lit::<D>(0.167));
    out.push(c * t * (ts - vs * 3.0) - a * v * (vs - ts * 3.0) + d * u * (us - ws * 3.0)
        - b * w * (ws - us * 3.0) + 0.399);
});
residuals!(/// Combustion of propane, reduced, of MINPACK-2.
Propane, |x, out| {
    let [r, r5, r6, r7] = [10.0, 0.193, 4.10622e-4, 5.45177e-4];
    let [r8, r9, r10] = [4.4975e-7, 3.40735e-5, 9.615e-7];
    let (x1, x2, x3, x4, x5) = (x[0], x[1], x[2], x[3], x[4]);
    out.push(x1 * x2 + x1 - x5 * 3.0);
    out.push(x1 * x2 * 2.0 + x1 + x2 * x2 * (3.0 * r10) + x2 * x3 * x3 + x2 * x3 * r7 + x2 * x4 * r9
        + x2 * r8 - x5 * r);
    out.push(x2 * x3 * x3 * 2.0 + x2 * x3 * r7 + x3 * x3 * (2.0 * r5) + x3 * r6 - x5 * 8.0);
    out.push(x2 * x4 * r9 + x4 * x4 * 2.0 - x5 * (4.0 * r));
    out.push(x1 * x2 + x1 + x2 * x2 * r10 + x2 * x3 * x3 + x2 * x3 * r7 + x2 * x4 * r9 + x2 * r8
        + x3 * x3 * r5 + x3 * r6 + x4 * x4 - lit::<D>(1.0));
});
residuals!(/// CHANDHEQ: Chandrasekhar's H-equation with c = 1, singular at its solution.
Chandrasekhar, |x, out| {
    let n = x.len() as f64;
    for (i, xi) in x.iter().enumerate() {
        let u = (i as f64 + 1.0) / n;
        let sum = x.iter().enumerate().map(|(j, xj)| {
            let w = (j as f64 + 1.0) / n;
            *xj * (0.5 / n * u / (u + w))
        });
        out.push(*xi - *xi * sum.fold(lit::<D>(0.0), |s, t| s + t) - lit::<D>(1.0));
    }
});
residuals!(/// Bratu's problem in one dimension near its turning point, `λ = 3.5`.
Bratu, |x, out| {
    let n = x.len();
    let h = 1.0 / (n as f64 + 1.0);
    for i in 0..n {
        let left = if i > 0 { x[i - 1] } else { lit::<D>(0.0) };
        let right = if i + 1 < n { x[i + 1] } else { lit::<D>(0.0) };
        out.push(x[i] * 2.0 - left - right - x[i].exp() * (3.5 * h * h));
    }
});
residuals!(/// MANCINO.
Mancino, |x, out| {
    for (i, xi) in x.iter().enumerate() {
        let number = i as f64 + 1.0;
        let mut sum = *xi * 1400.0 + (number - 50.0).powi(3);
        for j in 1..=x.len() {
            let v = (*xi * *xi + number / j as f64).sqrt();
            let log = v.ln();
            sum += v * (log.sin().powi(5) + log.cos().powi(5));
        }
        out.push(sum);
    }
});
residuals!(/// S308 (Schittkowski 1987, 308).
S308, |x, out| {
    out.extend([x[0] * x[0] + x[0] * x[1] + x[1] * x[1], x[0].sin(), x[1].cos()]);
});
residuals!(/// HIMMELBD, which has no root.
HimmelblauD, |x, out| {
    out.push(x[0] * x[0] + x[1] * 12.0 - lit::<D>(1.0));
    out.push((x[0] * x[0] + x[1] * x[1]) * 49.0 + x[0] * 84.0 + x[1] * 2324.0 - lit::<D>(681.0));
});
residuals!(/// GOTTFR.
Gottfried, |x, out| {
    let one = lit::<D>(1.0);
    out.push(x[0] - (x[0] + x[1] * 3.0) * (one - x[0]) * 0.1136);
    out.push(x[1] + (x[0] * 2.0 - x[1]) * (one - x[1]) * 7.5);
});
residuals!(/// HYPCIR.
HyperbolaCircle, |x, out| {
    out.push(x[0] * x[1] - lit::<D>(1.0));
    out.push(x[0] * x[0] + x[1] * x[1] - lit::<D>(4.0));
});
residuals!(/// CLUSTER.
Cluster, |x, out| {
    out.push((x[0] - x[1] * x[1]) * (x[0] - x[1].sin()));
    out.push((x[1].cos() - x[0]) * (x[1] - x[0].cos()));
});
residuals!(/// RECIPE, singular at its root.
Recipe, |x, out| {
    out.extend([x[0] - lit::<D>(5.0), x[1] * x[1], x[2] / (x[1] - x[0])]);
});
residuals!(/// BOOTH.
Booth, |x, out| {
    out.extend([x[0] + x[1] * 2.0 - lit::<D>(7.0), x[0] * 2.0 + x[1] - lit::<D>(5.0)]);
});
residuals!(/// ZANGWIL3.
Zangwill, |x, out| {
    out.extend([x[0] - x[1] + x[2], x[1] - x[0] + x[2], x[0] + x[1] - x[2]]);
});
residuals!(/// POWER: one residual, whose gradient vanishes where it does.
Power, |x, out| {
    let each = x.iter().enumerate().map(|(i, x)| *x * *x * (i as f64 + 1.0));
    out.push(each.fold(lit::<D>(0.0), |s, t| s + t));
});
residuals!(/// QING.
Qing, |x, out| {
    out.extend(x.iter().enumerate().map(|(i, x)| *x * *x - lit::<D>(i as f64 + 1.0)));
});
residuals!(/// WAYSEA1.
Wayburn1, |x, out| {
    out.push(x[0].powi(6) + x[1].powi(4) - lit::<D>(17.0));
    out.push(x[0] * 2.0 + x[1] - lit::<D>(4.0));
});
residuals!(/// WAYSEA2.
Wayburn2, |x, out| {
    let (a, b) = (x[0] - lit::<D>(0.3125), x[1] - lit::<D>(1.625));
    out.push(lit::<D>(1.613) - (a * a + b * b) * 4.0);
    out.push(x[1] - lit::<D>(1.0));
});
residuals!(/// PRICE4.
Price, |x, out| {
    out.push(x[0].powi(3) * x[1] * 2.0 - x[1].powi(3));
    out.push(x[0] * 6.0 - x[1] * x[1] + x[1]);
});
residuals!(/// Boggs, "The solution of nonlinear systems of equations by A-stable integration", 1971.
Boggs, |x, out| {
    out.push(x[0] * x[0] - x[1] + 1.0);
    out.push(x[0] - (x[1] * (0.5 * std::f64::consts::PI)).cos());
});
residuals!(/// Inverse position of a robot: Tsai and Morgan, 1985.
Robot, |x, out| {
    out.push(x[0] * x[2] * 0.004731 - x[1] * x[2] * 0.3578 - x[0] * 0.1238 + x[6] - x[1] * 0.001637
        - x[3] * 0.9338 - lit::<D>(0.3571));
    out.push(x[0] * x[2] * 0.2238 + x[1] * x[2] * 0.7623 + x[0] * 0.2638 - x[6] - x[1] * 0.07745
        - x[3] * 0.6734 - lit::<D>(0.6022));
    out.push(x[5] * x[7] + x[0] * 0.3578 + x[1] * 0.004731);
    out.push(x[1] * 0.2238 - x[0] * 0.7623 + 0.3461);
    for pair in x.chunks(2) {
        out.push(pair[0] * pair[0] + pair[1] * pair[1] - lit::<D>(1.0));
    }
});
residuals!(/// Neurophysiology: Verschelde, Verlinden and Cools, 1994, with zero moments.
Neurophysiology, |x, out| {
    out.push(x[0] * x[0] + x[2] * x[2] - lit::<D>(1.0));
    out.push(x[1] * x[1] + x[3] * x[3] - lit::<D>(1.0));
    out.push(x[4] * x[2].powi(3) + x[5] * x[3].powi(3));
    out.push(x[4] * x[0].powi(3) + x[5] * x[1].powi(3));
    out.push(x[4] * x[0] * x[2] * x[2] + x[5] * x[3] * x[3] * x[1]);
    out.push(x[4] * x[0] * x[0] * x[2] + x[5] * x[1] * x[1] * x[3]);
});
residuals!(/// A singular root: Decker and Kelley, "Newton's method at singular points", 1980.
DeckerKelley, |x, out| {
    out.push(x[0] + x[0] * x[1] + x[1] * x[1]);
    out.push(x[0] * x[0] - x[0] * 2.0 + x[1] * x[1]);
});

/// MANCINO's start.
fn mancino_start(n: usize) -> Vec<f64> {
    let each = |i: usize| {
        let number = i as f64;
        let sum: f64 = (1..=n)
            .map(|j| {
                let v = (number / j as f64).sqrt();
                v * (v.ln().sin().powi(5) + v.ln().cos().powi(5))
            })
            .sum();
        -8.710996e-4 * ((number - 50.0).powi(3) + sum)
    };
    (1..=n).map(each).collect()
}

/// Thirty systems.
pub fn equations() -> Vec<Case> {
    let yatp = |size: usize, second: bool| {
        let mut start = vec![if second { 10.0 } else { 6.0 }; size * size];
        start.resize(size * (size + 2), 0.0);
        let name = format!("YATP{} {size}", 1 + usize::from(second));
        Case::new(&name, Yatp { size, second }, &start, &[])
    };
    let eigen = |name: &str, matrix: fn(usize, usize) -> f64| {
        let mut start: Vec<f64> = (0..16)
            .map(|k| if k % 5 == 0 { 1.0 } else { 0.0 })
            .collect();
        start.resize(20, 1.0);
        Case::new(name, Eigen(matrix), &start, &[])
    };
    let root = |name: &str, zero: bool| {
        let start: Vec<f64> = (1..=16)
            .map(|k: i32| 0.2 * f64::from(k * k).sin())
            .collect();
        Case::new(name, MatrixRoot { zero }, &start, &[])
    };
    let dipole = [
        0.299, 0.186, -0.0273, 0.0254, -0.474, 0.474, -0.0892, 0.0892,
    ];
    vec![
        yatp(3, false),
        yatp(3, true),
        yatp(5, true),
        eigen("EIGENA", |i, j| if i == j { i as f64 + 1.0 } else { 0.0 }),
        eigen("EIGENB", |i, j| {
            if i == j {
                2.0
            } else if i == j + 1 {
                -1.0
            } else {
                0.0
            }
        }),
        eigen("EIGENC", |i, j| {
            if i == j {
                4.0 - i as f64
            } else if i == j + 1 {
                1.0
            } else {
                0.0
            }
        }),
        root("MSQRTA", true),
        root("MSQRTB", false),
        Case::new("Heart dipole", Dipole, &dipole, &[]),
        Case::new("Propane", Propane, &[1.0; 5], &[]),
        Case::new("CHANDHEQ", Chandrasekhar, &[1.0; 20], &[]),
        Case::new("BRATU1D", Bratu, &[0.0; 20], &[]),
        Case::new("MANCINO", Mancino, &mancino_start(20), &[]),
        Case::new("S308", S308, &[3.0, 0.1], &[]),
        Case::new("HIMMELBD", HimmelblauD, &[1.0, 1.0], &[]),
        Case::new("GOTTFR", Gottfried, &[0.5, 0.5], &[]),
        Case::new("HYPCIR", HyperbolaCircle, &[0.0, 1.0], &[]),
        Case::new("CLUSTER", Cluster, &[0.0, 0.0], &[]),
        Case::new("RECIPE", Recipe, &[2.0, 5.0, 1.0], &[]),
        Case::new("BOOTH", Booth, &[0.0, 0.0], &[]),
        Case::new("ZANGWIL3", Zangwill, &[100.0, -1.0, 2.5], &[]),
        Case::new("POWER", Power, &[1.0; 10], &[]),
        Case::new("QING", Qing, &[1.0; 10], &[]),
        Case::new("WAYSEA1", Wayburn1, &[1.0, 1.0], &[]),
        Case::new("WAYSEA2", Wayburn2, &[5.0, 5.0], &[]),
        Case::new("PRICE4", Price, &[1.0, 0.5], &[]),
        Case::new("Boggs", Boggs, &[1.0, 0.0], &[]),
        Case::new("Robot", Robot, &[1.0; 8], &[]),
        Case::new("Neurophysiology", Neurophysiology, &[0.5; 6], &[]),
        Case::new("Decker-Kelley", DeckerKelley, &[0.03, 0.03], &[]),
    ]
}
