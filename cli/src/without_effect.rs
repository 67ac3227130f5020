//! The options that change no result, each with the reason. Every other option changes it, or is refused where it would not.

/// An option that changes no result.
#[derive(Clone, Copy, Debug)]
pub struct WithoutEffect {
    /// The command; every command that has the option where it is empty.
    pub command: &'static str,
    /// Name of the option, with dashes.
    pub option: &'static str,
    /// Why nothing changes by it.
    pub reason: &'static str,
}

/// All of them.
pub static WITHOUT_EFFECT: &[WithoutEffect] = &[
    of("", "--quiet", "says less beside the result"),
    of("", "--verbose", "says more beside the result"),
    of("", "--color", "the colour of words on a terminal"),
    of(
        "",
        "--force",
        "replaces a file that is there; without one there is nothing to replace",
    ),
    of(
        "",
        "--skip-existing",
        "keeps a file that is there; without one there is nothing to keep",
    ),
    of("batch", "--jobs", "shares the work; the bytes are the same"),
    of(
        "batch",
        "--resume",
        "keeps devices that are complete; the bytes are the same",
    ),
    of(
        "info",
        "--flip",
        "shows how readings are read, not the readings",
    ),
    of(
        "allan",
        "--flip",
        "the sign of a reading changes no deviation",
    ),
    of("segment", "--mag-unit", "a magnetometer has no part in it"),
    of("bias", "--mag-unit", "a magnetometer has no part in it"),
    of("reckon", "--mag-unit", "a magnetometer has no part in it"),
    of("evaluate", "--mag-unit", "a magnetometer has no part in it"),
    of("discover", "--mag-unit", "a magnetometer has no part in it"),
    of("plan", "--mag-unit", "a magnetometer has no part in it"),
    of("allan", "--mag-unit", "a magnetometer has no part in it"),
    of("live", "--mag-unit", "a magnetometer has no part in it"),
    of(
        "plan",
        "--gyro-unit",
        "a plan goes by the readings of the accelerometer",
    ),
    of(
        "live",
        "--placements",
        "guides the session; what was recorded is calibrated",
    ),
    of(
        "live",
        "--hold",
        "guides the session; what was recorded is calibrated",
    ),
    of(
        "live",
        "--baud",
        "the speed of a serial port; other sources have none",
    ),
    of("live", "--poll", "how often a source is asked for more"),
    of("live", "--web", "shows the session as a page"),
];

const fn of(command: &'static str, option: &'static str, reason: &'static str) -> WithoutEffect {
    WithoutEffect {
        command,
        option,
        reason,
    }
}

/// The reason why an option of a command changes no result; `None` where it does.
pub fn reason(command: &str, option: &str) -> Option<&'static str> {
    let is_it = |own: &&WithoutEffect| {
        own.option == option && (own.command.is_empty() || own.command == command)
    };
    WITHOUT_EFFECT.iter().find(is_it).map(|own| own.reason)
}
