//! A direction in words.

/// A component above this is named, of a unit vector: edges have .71 of two, corners .58 of three.
const NAMED: f64 = 0.36;

/// `+x −y` for a direction between the two axes.
pub fn words(at: &[f64; 3]) -> String {
    let names = [["+x", "−x"], ["+y", "−y"], ["+z", "−z"]];
    let part = |k: usize| (at[k].abs() > NAMED).then(|| names[k][usize::from(at[k] < 0.0)]);
    (0..3).filter_map(part).collect::<Vec<_>>().join(" ")
}
