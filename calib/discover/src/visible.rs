//! What recordings of this kind cannot show, and which recording would.

/// What no hand-held recording shows: it is taken up by a parameter that is free.
pub const NEVER_VISIBLE: [&str; 5] = [
    "a wrong value of local gravity: it is a common scale of the accelerometer",
    "a clock that runs fast or slow: it is a common scale of the gyroscope",
    "the distance between the accelerometer's axes (size effect): the rests do not turn",
    "a delay common to the three axes of the gyroscope: turns begin and end at rest",
    "isotropic g-sensitivity against the vertical part of the earth's rate, where no latitude is given",
];

/// A recording that tells a named effect from what cannot be told from it in this one.
pub fn told_apart_by(name: &str, ties: &[String]) -> Option<String> {
    if ties.is_empty() {
        return None;
    }
    let mut all: Vec<&str> = ties.iter().map(String::as_str).collect();
    all.push(name);
    let has = |part: &str| all.iter().any(|n| n.contains(part));
    let what = if has("temperature_rate") || has("thermal_hysteresis") {
        "a recording in which the temperature rises and falls at least twice, slowly and fast"
    } else if has("temperature") && (has("drift") || has("warmup") || has("step")) {
        "a recording in which temperature rises and falls: warm the device, then let it cool while you turn it"
    } else if has("drift") || has("warmup") || has("step") {
        "a recording twice as long, that begins with five minutes at rest right after switching on and returns to \
         its first placement several times"
    } else if has("quadratic") && has("asymmetry") {
        "more placements between the faces: tilts of 20 to 70 degrees on every axis (or turns of very different \
         speed, for the gyroscope)"
    } else if has("cubic") || has("gyro_quadratic") || has("gyro_asymmetry") {
        "turns of very different speed, from slow (20 deg/s) to as fast as the range allows, both ways about every axis"
    } else if has("hysteresis") {
        "the same placements reached from different sides, in mixed order"
    } else if has("g_sensitivity") || has("g2_sensitivity") || has("earth_rate") {
        "longer rests (30 s) in at least twelve orientations, and the latitude given"
    } else {
        "a second recording of the same kind with placements in another order"
    };
    Some(what.into())
}
