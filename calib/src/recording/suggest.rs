//! What to propose where column names are not understood.

use crate::shown::shown;

/// The name most like `wanted`, if one is.
pub(super) fn nearest<'a>(wanted: &str, names: &'a [String]) -> Option<&'a String> {
    let likeness =
        |name: &String| strsim::jaro_winkler(&wanted.to_lowercase(), &name.to_lowercase());
    let best = names
        .iter()
        .max_by(|a, b| likeness(a).total_cmp(&likeness(b)))?;
    (likeness(best) > 0.7).then_some(best)
}

/// A `--columns` line ready to paste, with the names most like the plain ones.
pub(super) fn suggestion(names: &[String]) -> String {
    const TIMES: &[&str] = &["t", "time", "timestamp", "clock", "stamp"];
    const ACCELS: &[&str] = &["a?", "acc_?", "accel_?", "a_?", "accelerometer ?", "?"];
    const GYROS: &[&str] = &[
        "g?",
        "gyr_?",
        "gyro_?",
        "r_?",
        "w_?",
        "gyroscope ?",
        "rate_?",
    ];
    let mut taken = Vec::new();
    let time = most_like(names, TIMES, "", &mut taken);
    let triad = |spellings, taken: &mut Vec<usize>| {
        ["x", "y", "z"].map(|axis| most_like(names, spellings, axis, taken))
    };
    let (accel, gyro) = (triad(ACCELS, &mut taken), triad(GYROS, &mut taken));
    let mut entries: Vec<_> = time.iter().map(|column| format!("t={column}")).collect();
    for (sensor, triad) in [("a", accel), ("g", gyro)] {
        if let [Some(x), Some(y), Some(z)] = triad {
            entries.push(format!("{sensor}x={x},{sensor}y={y},{sensor}z={z}"));
        }
    }
    if entries.len() < 2 {
        return "say which is which by number or name, as in --columns 't=1,ax=2,ay=3,az=4'"
            .to_owned();
    }
    format!("say which is which: --columns '{}'", entries.join(","))
}

/// The column most like one of `spellings`, `?` being the axis, unless it is taken or unlike them all.
fn most_like(
    names: &[String],
    spellings: &[&str],
    axis: &str,
    taken: &mut Vec<usize>,
) -> Option<String> {
    let likeness = |name: &str| {
        let name = name.to_lowercase();
        let like = |s: &&str| strsim::jaro_winkler(&s.replace('?', axis), &name);
        spellings.iter().map(like).fold(0.0, f64::max)
    };
    // `acc_x`, `AccX [g]`, `ax_raw`, but not `zeit`.
    let ends = |word: &str| !word.is_empty() && word.ends_with(axis);
    let fits = |name: &String| {
        let name = name.to_lowercase();
        name.split(|c: char| !c.is_alphanumeric()).any(ends)
    };
    let free = (0..names.len()).filter(|i| !taken.contains(i) && fits(&names[*i]));
    let best = free.max_by(|&a, &b| likeness(&names[a]).total_cmp(&likeness(&names[b])))?;
    if likeness(&names[best]) < 0.6 {
        return None;
    }
    taken.push(best);
    // A comma or quote in a name would end the entry; its number says the same.
    let plain = !names[best].contains([',', '\'', '=']);
    Some(if plain {
        shown(&names[best])
    } else {
        (best + 1).to_string()
    })
}
