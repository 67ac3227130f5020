//! A calibration with what the type has in common.

use findings::{Finding, Kind};
use nalgebra::{DMatrix, DVector};
use recording::Error;

use super::belonging::{Belonging, EstimatedType};
use super::{Prior, PriorShare, PriorUse};
use crate::calibration::Calibration;

impl Prior {
    /// Adds the type's information to a calibration whose own covariance is that of its session; writes down what came from
    /// where. A device that is not of the type stays as it is, with a warning.
    ///
    /// # Errors
    /// [`Error::Usage`] where they have no parameter in common, or the accelerometer's frame is not the triangular one.
    pub fn inform(&self, calibration: &mut Calibration) -> Result<(), Error> {
        let symmetric = calibration
            .provenance
            .options
            .as_ref()
            .is_some_and(|o| o.frame == "symmetric");
        if symmetric {
            return Err(Error::usage(Finding::of(Kind::PRIOR_FRAME)));
        }
        let all = &calibration.parameters;
        let common: Vec<(usize, usize)> = self
            .parameters
            .iter()
            .enumerate()
            .filter_map(|(k, name)| Some((all.iter().position(|own| own == name)?, k)))
            .collect();
        if common.is_empty() {
            return Err(Error::usage(Finding::of(Kind::PRIOR_FOREIGN)));
        }
        let n = all.len();
        let c = calibration.covariance_matrix();
        let values = calibration.parameter_values();
        let spread = self.spread();
        let m = common.len();
        let of_common =
            |all: &[Vec<f64>]| DMatrix::from_fn(m, m, |i, j| all[common[i].1][common[j].1]);
        let covariance = of_common(&self.covariance);
        let mean_covariance = of_common(&self.mean_covariance);
        let own = DMatrix::from_fn(m, m, |i, j| c[(common[i].0, common[j].0)]);
        let cross = DMatrix::from_fn(n, m, |i, j| c[(i, common[j].0)]);
        let gap = DVector::from_fn(m, |i, _| self.mean[common[i].1] - values[common[i].0]);
        let total = &covariance * self.widening(m) + &mean_covariance + &own;
        let estimated = EstimatedType {
            covariance: &covariance,
            mean_covariance: &mean_covariance,
            devices: self.devices,
        };
        let judged = estimated.belonging(&gap, &own);
        let Some((judged, solved)) = judged.zip(scaled_solve(&total, &cross, &gap)) else {
            return Err(Error::input(Finding::of(Kind::PRIOR_DEGENERATE)));
        };
        let (shift, shrink) = solved;
        let used = judged.belongs();
        let (after, c_after) = match used {
            true => (&values + shift, &c - shrink),
            false => (values.clone(), c.clone()),
        };
        let share = |&(i, k): &(usize, usize)| PriorShare {
            name: self.parameters[k].clone(),
            prior: self.mean[k],
            prior_std: spread[(k, k)].sqrt(),
            data: values[i],
            data_std: c[(i, i)].sqrt(),
            value: after[i],
            std: c_after[(i, i)].max(0.0).sqrt(),
            by_prior: 1.0 - c_after[(i, i)] / c[(i, i)],
        };
        let shares: Vec<PriorShare> = common.iter().map(share).collect();
        if used {
            calibration.write_parameters(&after, &c_after);
        } else {
            calibration.warnings.push(self.stranger(&judged, &shares));
        }
        calibration.prior = Some(PriorUse {
            devices: self.devices,
            belongs: used,
            p_value: judged.p_value,
            furthest: shares
                .get(judged.furthest)
                .map(|s| (s.name.clone(), -judged.deviation)),
            parameters: shares,
        });
        calibration.seal();
        Ok(())
    }

    /// How much wider a spread has to be that was estimated: the inverse of a covariance of `ν` degrees of freedom in `p` parameters is
    /// too large by `ν/(ν − p − 1)` in the mean (Mardia, Kent and Bibby, *Multivariate Analysis*, 1979, section 3.8).
    fn widening(&self, parameters: usize) -> f64 {
        let freedom = self.devices.saturating_sub(1) as f64;
        freedom / (freedom - parameters as f64 - 1.0).max(1.0)
    }

    fn stranger(&self, judged: &Belonging, shares: &[PriorShare]) -> Finding {
        let name = shares.get(judged.furthest).map_or("", |s| s.name.as_str());
        Finding::of(Kind::NOT_OF_TYPE)
            .detail("parameter", name)
            .number("distance", judged.deviation.abs(), "1")
            .detail("p", format!("{:.1e}", judged.p_value))
    }
}

/// `C Sᵀ (…)⁻¹ (μ − S y)` and `C Sᵀ (…)⁻¹ S C`, solved with unit diagonal: parameters differ by orders of magnitude.
fn scaled_solve(
    total: &DMatrix<f64>,
    cross: &DMatrix<f64>,
    gap: &DVector<f64>,
) -> Option<(DVector<f64>, DMatrix<f64>)> {
    let m = gap.len();
    let scale = DVector::from_fn(m, |k, _| total[(k, k)].sqrt());
    let unit = DMatrix::from_fn(m, m, |i, j| total[(i, j)] / (scale[i] * scale[j]));
    let cross = DMatrix::from_fn(cross.nrows(), m, |i, j| cross[(i, j)] / scale[j]);
    let factor = unit.cholesky()?;
    let shift = &cross * factor.solve(&gap.component_div(&scale));
    let shrink = &cross * factor.solve(&cross.transpose());
    Some((shift, shrink))
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::methods::six_position::{Face, Placement, Six, SixPosition};
    use crate::prior::PRIOR_SCHEMA;

    fn calibration() -> Calibration {
        let placements = Face::ALL.map(|face| Placement {
            label: face.name().into(),
            accelerometer: face.direction() * 9.81 + Vector3::new(0.1, 0.2, 0.3),
            gyroscope: None,
        });
        let six = Six::sort(placements.to_vec(), 9.80665).unwrap();
        let mut calibration = SixPosition::solve(&six, 9.80665)
            .calibration(false)
            .unwrap();
        let n = calibration.parameters.len();
        calibration.covariance = (0..n)
            .map(|i| (0..n).map(|j| f64::from(u8::from(i == j)) * 1e-4).collect())
            .collect();
        calibration
    }

    fn prior(mean: f64, variance: f64) -> Prior {
        Prior {
            schema: PRIOR_SCHEMA.into(),
            created_by: String::new(),
            devices: 100,
            outsiders: Vec::new(),
            without: 0,
            effects: Vec::new(),
            parameters: vec!["accel.b_x".into()],
            mean: vec![mean],
            covariance: vec![vec![variance]],
            mean_covariance: vec![vec![0.0]],
        }
    }

    #[test]
    fn two_values_of_equal_weight_meet_half_way() {
        let mut calibration = calibration();
        let data = calibration.accelerometer.as_ref().unwrap().bias[0];
        prior(data + 0.02, 1e-4).inform(&mut calibration).unwrap();
        let triad = calibration.accelerometer.as_ref().unwrap();
        // Of a spread that a hundred devices tell: 99/97 of it.
        let by_prior = 1.0 / (1.0 + 99.0 / 97.0);
        assert!((triad.bias[0] - data - 0.02 * by_prior).abs() < 1e-12);
        assert!((triad.bias_std[0].unwrap() - 0.01 * (1.0 - by_prior).sqrt()).abs() < 1e-12);
        let used = calibration.prior.as_ref().unwrap();
        assert!(used.belongs && (used.parameters[0].by_prior - by_prior).abs() < 1e-12);
        assert_eq!(calibration.was_edited(), Some(false));
    }

    #[test]
    fn a_stranger_is_flagged_and_not_pulled_in() {
        let mut calibration = calibration();
        let before = calibration.clone();
        let data = before.accelerometer.as_ref().unwrap().bias[0];
        prior(data + 0.2, 1e-4).inform(&mut calibration).unwrap();
        assert_eq!(calibration.accelerometer, before.accelerometer);
        assert!(!calibration.prior.as_ref().unwrap().belongs);
        assert!(
            calibration
                .warnings
                .last()
                .unwrap()
                .text(findings::Front::CommandLine)
                .contains(
                    "accel.b_x (the accelerometer's bias on x) lies 14.1 standard deviations"
                )
        );
    }
}
