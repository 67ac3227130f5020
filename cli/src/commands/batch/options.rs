//! The options of a batch.

use batch::Options;
use calib::calibrate::{Method, Request};
use calib::discover;
use calib::prior::Prior;
use sensor::EffectRef;

use super::args::{Args, BatchMethod};
use crate::commands::shared::inputs::named_effect;
use crate::exit::Failure;

/// Refuses options that the search for effects leaves nothing to do for.
fn refuse_with_discover(args: &Args) -> Result<(), Failure> {
    let decided = [
        ("--method", !matches!(args.method, BatchMethod::Auto)),
        ("--effects", !args.effects.is_empty()),
    ];
    match decided
        .into_iter()
        .find(|(_, given)| args.discover && *given)
    {
        Some((option, _)) => Err(Failure::usage(format!(
            "{option} means nothing with --discover, which finds the effects of each device in the joint fit"
        ))
        .advise("leave one of the two out")),
        None => Ok(()),
    }
}

/// Builds the options that all devices share from the arguments.
pub fn of(args: &Args) -> Result<Options, Failure> {
    refuse_with_discover(args)?;
    let gravity = args.place.gravity()?;
    let (detector, choose_multiplier) = args.detector.detector()?;
    let prior = args.prior.as_deref().map(Prior::read).transpose()?;
    let mut effects = Vec::new();
    let of_prior = prior.iter().flat_map(|p| &p.effects);
    for name in args.effects.iter().chain(of_prior) {
        let effect = named_effect(name, &[])?;
        if !effects.iter().any(|own: &EffectRef| own.name() == name) {
            effects.push(effect);
        }
    }
    let request = Request {
        method: match args.method {
            BatchMethod::Auto => Method::Auto,
            BatchMethod::Stepwise => Method::Stepwise,
            BatchMethod::Joint => Method::Joint,
        },
        gravity: gravity.value,
        gravity_source: gravity.source,
        latitude: args.place.latitude,
        detector,
        choose_multiplier,
        effects,
        clock: args.clock.mode(),
        ..Request::default()
    };
    let read = args.read.clone().into();
    let limits = args.limits.read()?;
    let text = format!(
        "{}\n{request:?}\n{read:?}\n{}\n{limits:?}\n{prior:?}",
        concat!("stillpoint ", env!("CARGO_PKG_VERSION")),
        args.discover
    );
    let discover = args.discover.then(|| discover::Request {
        clock: args.clock.mode(),
        ..discover::Request::new(gravity.value)
    });
    Ok(Options {
        request,
        read,
        discover,
        limits,
        prior,
        text,
    })
}
