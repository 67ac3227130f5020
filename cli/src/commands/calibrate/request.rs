//! The request that the arguments make.

use calib::Recording;
use calib::calibrate::{Frame, GyroBias, NOMINAL_RATES, Request, read_static_means};
use calib::intervals::{Span, read_sections};
use calib::recording::figure;
use calib::residuals::Integrator;
use nalgebra::Vector3;
use sensor::{EffectRef, Sensor};

use super::arguments::{Args, FrameArg, GyroBiasArg, IntegratorArg, Method};
use super::methods;
use crate::commands::shared::inputs::{named_effect, own_effects};
use crate::exit::Failure;
use crate::steps;

/// The request to the library.
pub(super) fn request(args: &Args) -> Result<Request, Failure> {
    let method = methods::method(args)?;
    refuse_unread(args)?;
    let gravity = args.place.gravity()?;
    let (detector, choose_multiplier) = args.detector.detector()?;
    let own = own_effects(&args.effect_file)?;
    refuse_unnamed(&own, &args.effects)?;
    let named = args.effects.iter().map(|name| named_effect(name, &own));
    let effects = named.collect::<Result<Vec<_>, _>>()?;
    let of_another = |effect: &&EffectRef| effect.sensor() != Sensor::Accelerometer;
    if let Some(effect) = effects
        .iter()
        .find(of_another)
        .filter(|_| args.sensor.is_some())
    {
        let why = format!(
            "--effects {}: it is one of the {}, and --sensor accelerometer leaves that out",
            effect.name(),
            effect.sensor().name()
        );
        return Err(Failure::usage(why));
    }
    let nominal_step = match args.nominal_rate {
        Some(rate) if NOMINAL_RATES.contains(&rate) => Some(rate.recip()),
        Some(rate) => {
            return Err(Failure::usage(format!(
                "--nominal-rate {}: a rate from {} to {} Hz expected",
                figure(rate),
                figure(*NOMINAL_RATES.start()),
                figure(*NOMINAL_RATES.end())
            )));
        }
        None => None,
    };
    let static_means: Vec<Vector3<f64>> = match &args.static_means {
        Some(path) => read_static_means(path)?,
        None => Vec::new(),
    };
    Ok(Request {
        method: match method {
            Method::Auto => calib::calibrate::Method::Auto,
            Method::Joint => calib::calibrate::Method::Joint,
            Method::Stepwise | Method::SixPosition => calib::calibrate::Method::Stepwise,
        },
        gravity: gravity.value,
        watch: steps::watch(),
        gravity_source: gravity.source,
        detector,
        choose_multiplier,
        sections: Vec::new(),
        left_out: Vec::new(),
        frame: match args.frame {
            None | Some(FrameArg::Triangular) => Frame::Triangular,
            Some(FrameArg::Symmetric) => Frame::Symmetric,
        },
        integrator: match args.integrator {
            None | Some(IntegratorArg::Exponential) => Integrator::Exponential,
            Some(IntegratorArg::FirstOrderNormalized) => Integrator::FirstOrderNormalized,
            Some(IntegratorArg::FirstOrder) => Integrator::FirstOrder,
        },
        gyro_bias: match args.gyro_bias {
            None | Some(GyroBiasArg::Adjacent) => GyroBias::Adjacent,
            Some(GyroBiasArg::Initial) => GyroBias::Initial,
        },
        nominal_step,
        effects,
        sensors: Vec::new(),
        latitude: args.place.latitude,
        force_device: args.force_device,
        accelerometer_alone: args.sensor.is_some(),
        clock: args.clock.unwrap_or_default().mode(),
        field: args.field,
        static_means,
    })
}

/// Refuses options that others leave nothing to do for.
fn refuse_unread(args: &Args) -> Result<(), Failure> {
    let by_hand = !args.sections.is_empty() && args.gyro_recording.is_empty();
    match args.detector.given().filter(|_| by_hand) {
        Some(option) => Err(Failure::usage(format!(
            "{option} finds static intervals, and --sections gives them"
        ))
        .advise("leave one of the two out")),
        None => Ok(()),
    }
}

/// Refuses a file of effects of which none is named.
fn refuse_unnamed(own: &[EffectRef], named: &[String]) -> Result<(), Failure> {
    let is_named = |effect: &EffectRef| named.iter().any(|name| name == effect.name());
    match own.first() {
        Some(first) if !own.iter().any(is_named) => Err(Failure::usage(
            "--effect-file: none of its effects is fitted",
        )
        .advise(format!("name it, as in --effects {}", first.name()))),
        _ => Ok(()),
    }
}

/// The static intervals picked by hand, of each recording.
pub(super) fn sections(args: &Args, recordings: &[Recording]) -> Result<Vec<Vec<Span>>, Failure> {
    match args.sections.as_slice() {
        [] => Ok(Vec::new()),
        [one] => recordings
            .iter()
            .map(|r| Ok(read_sections(one, r)?))
            .collect(),
        many if many.len() == recordings.len() => many
            .iter()
            .zip(recordings)
            .map(|(path, r)| Ok(read_sections(path, r)?))
            .collect(),
        many => Err(Failure::usage(format!(
            "{} tables of --sections for {} recordings: give one for all or one for each",
            many.len(),
            recordings.len()
        ))),
    }
}
