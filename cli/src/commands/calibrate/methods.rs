//! Options of `calibrate` that only some methods use.

use super::arguments::Args;
pub use super::arguments::Method;
use crate::exit::Failure;

/// An option that not every method follows.
pub struct OfMethods {
    /// Name of the option, with dashes.
    pub option: &'static str,
    /// The methods that follow it.
    pub methods: &'static [Method],
    given: fn(&Args) -> bool,
}

const STEPWISE: &[Method] = &[Method::Stepwise];
const BOTH: &[Method] = &[Method::Stepwise, Method::Joint];
const SIX_POSITION: &[Method] = &[Method::SixPosition];

/// The options that are not every method's.
pub static OF_METHODS: [OfMethods; 17] = [
    of("--integrator", STEPWISE, |args| args.integrator.is_some()),
    of("--gyro-bias", STEPWISE, |args| args.gyro_bias.is_some()),
    of("--nominal-rate", STEPWISE, |args| {
        args.nominal_rate.is_some()
    }),
    of("--static-means", STEPWISE, |args| {
        args.static_means.is_some()
    }),
    of("--first-order", SIX_POSITION, |args| args.first_order),
    of("--frame", BOTH, |args| args.frame.is_some()),
    of("--clock", BOTH, |args| args.clock.is_some()),
    of("--mag-unit", BOTH, |args| args.read.mag_unit.is_some()),
    of("--field", BOTH, |args| args.field.is_some()),
    of("--effects", BOTH, |args| !args.effects.is_empty()),
    of("--effect-file", BOTH, |args| !args.effect_file.is_empty()),
    of("--prior", BOTH, |args| args.prior.is_some()),
    of("--gyro-recording", BOTH, |args| {
        !args.gyro_recording.is_empty()
    }),
    of("--sections", BOTH, |args| !args.sections.is_empty()),
    of("--leave-out", BOTH, |args| !args.leave_out.is_empty()),
    of("--sensor", BOTH, |args| args.sensor.is_some()),
    of("--force-device", BOTH, |args| args.force_device),
];

const fn of(
    option: &'static str,
    methods: &'static [Method],
    given: fn(&Args) -> bool,
) -> OfMethods {
    OfMethods {
        option,
        methods,
        given,
    }
}

impl OfMethods {
    /// Its methods, as they are named.
    pub fn in_words(&self) -> String {
        let names: Vec<&str> = self.methods.iter().map(|method| name(*method)).collect();
        names.join(" or ")
    }
}

/// The method: the one that was named, or where none was the stepwise one if an option is its alone.
///
/// # Errors
/// Status 2 for an option that the method does not follow.
pub(super) fn method(args: &Args) -> Result<Method, Failure> {
    let given = || OF_METHODS.iter().filter(|own| (own.given)(args));
    let named = match args.method {
        Method::Auto if given().any(|own| own.methods == STEPWISE) => Method::Stepwise,
        named => named,
    };
    let follows = |own: &&OfMethods| match named {
        Method::Auto => own.methods != SIX_POSITION,
        named => own.methods.contains(&named),
    };
    let Some(other) = given().find(|own| !follows(own)) else {
        return Ok(named);
    };
    let (option, methods) = (other.option, other.in_words());
    let why = match args.method {
        Method::Auto => {
            format!("{option} is of the {methods} method: add --method {methods}, or leave it out")
        }
        named => format!(
            "{option} means nothing to --method {}: take --method {methods}, or leave it out",
            name(named)
        ),
    };
    Err(Failure::usage(why))
}

fn name(method: Method) -> &'static str {
    match method {
        Method::Auto => "auto",
        Method::Stepwise => "stepwise",
        Method::Joint => "joint",
        Method::SixPosition => "six-position",
    }
}
