//! Placements and turns as a person makes them.

/// `7 placements, 6 of which differ by more than 20°`.
pub fn placements(count: usize, distinct: usize) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} placement{plural}, {distinct} of which differ by more than 20°")
}

/// `no placement has z up, z down`.
pub fn no_placement(faces: &str) -> String {
    format!("no placement has {faces}")
}

/// `add 2 placements: 1) z up, 2) x down`.
pub fn add_placements(placements: &[String]) -> String {
    format!("add {}", counted("placement", placements))
}

/// `add 2 turns: 1) …, 2) …`.
pub fn add_turns(turns: &[String]) -> String {
    format!("add {}", counted("turn", turns))
}

fn counted(thing: &str, all: &[String]) -> String {
    let plural = if all.len() == 1 { "" } else { "s" };
    format!("{} {thing}{plural}: {}", all.len(), numbered(all))
}

/// `1) z up, 2) x down`.
pub fn numbered(all: &[String]) -> String {
    let each = (1..).zip(all).map(|(k, own)| format!("{k}) {own}"));
    each.collect::<Vec<_>>().join(", ")
}

/// `z up (a phone: flat on its back, screen up)`.
pub fn placement(axes: &str, of_a_phone: &str) -> String {
    format!("{axes} (a phone: {of_a_phone})")
}

/// A phone that lies flat.
pub fn flat(screen_up: bool) -> &'static str {
    match screen_up {
        true => "flat on its back, screen up",
        false => "flat on its screen",
    }
}

/// No turn at all.
pub fn leave() -> &'static str {
    "leave it as it is"
}

/// A turn by `amount` about an axis of the device.
pub fn turn(amount: &str, axis: &str, until: &str) -> String {
    format!("turn it {amount} about {axis} {until}")
}

/// A whole turn; without an axis end over end.
pub fn turn_round(axis: Option<&str>) -> String {
    match axis {
        Some(axis) => format!("turn it once all the way round about {axis}"),
        None => "turn it once all the way round, end over end".into(),
    }
}

/// A whole turn and more.
pub fn turn_round_and(axis: &str, more: &str, until: &str) -> String {
    format!("turn once round about {axis}, then {more} more {until}")
}

/// A turn in two legs.
pub fn turn_by_way_of(first: &str, axis: &str, until: &str) -> String {
    format!("turn it {first}, then about {axis} {until}")
}

/// A spin about the vertical, then a turn.
pub fn spin_and(amount: &str, axis: &str, until: &str) -> String {
    format!("spin it half round, then {amount} about {axis} {until}")
}

/// A turn about an axis that has no name.
pub fn turn_aslant(onto_a_corner: bool, spun: bool) -> String {
    let there = match onto_a_corner {
        true => "onto a corner",
        false => "the shortest way",
    };
    match spun {
        true => format!("spin it half round, then turn it {there}"),
        false => format!("turn it {there}"),
    }
}
