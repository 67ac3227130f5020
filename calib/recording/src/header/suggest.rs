//! What to propose where column names are not understood.

use sensor::Sensor;

use crate::recording::options::Role;
use crate::shown::shown;

/// Names less like any spelling are not proposed.
const LIKE: f64 = 0.6;

/// The name most like `wanted`, if one is.
pub(crate) fn nearest<'a>(wanted: &str, names: &'a [String]) -> Option<&'a String> {
    let likeness =
        |name: &String| strsim::jaro_winkler(&wanted.to_lowercase(), &name.to_lowercase());
    let best = names
        .iter()
        .max_by(|a, b| likeness(a).total_cmp(&likeness(b)))?;
    (likeness(best) > 0.7).then_some(best)
}

/// A `--columns` line ready to paste: columns that have roles, and of `unclear` three for the sensor that has none.
pub(crate) fn completed(
    roles: &[(Role, String)],
    names: &[String],
    unclear: &[String],
    missing: Sensor,
) -> Option<String> {
    let mut taken = Vec::new();
    let triad = match (unclear, one_stem(unclear, &["?"], 0.0, &mut taken)) {
        (_, Some(triad)) => triad.map(|at| unclear[at].clone()).to_vec(),
        ([_, _, _], None) => unclear.to_vec(),
        _ => return None,
    };
    let called = |name: &String| {
        let at = names.iter().position(|other| other == name);
        at.map_or_else(|| name.clone(), |at| entry(names, at))
    };
    let known = roles
        .iter()
        .filter(|(role, _)| !matches!(role, Role::Field(_)));
    let known = known.map(|(role, name)| format!("{}={}", role.name(), called(name)));
    let role = |axis| Role::axis(missing, axis);
    let axes = triad.iter().enumerate();
    let added = axes.map(|(axis, name)| format!("{}={}", role(axis).name(), called(name)));
    let entries: Vec<String> = known.chain(added).collect();
    Some(asked(&entries))
}

/// A `--columns` line ready to paste, with the names most like the plain ones.
pub(crate) fn suggestion(names: &[String]) -> String {
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
        one_stem(names, spellings, LIKE, taken).map_or_else(
            || ["x", "y", "z"].map(|axis| most_like(names, spellings, axis, taken)),
            |columns| columns.map(|at| Some(entry(names, at))),
        )
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
    asked(&entries)
}

fn asked(entries: &[String]) -> String {
    format!("say which is which: --columns '{}'", entries.join(","))
}

/// The free columns most like `spellings` of those that differ by their axis alone.
fn one_stem(
    names: &[String],
    spellings: &[&str],
    floor: f64,
    taken: &mut Vec<usize>,
) -> Option<[usize; 3]> {
    let lower: Vec<String> = names.iter().map(|name| name.to_lowercase()).collect();
    let free = |at: &usize| !taken.contains(at);
    let triads = (0..names.len()).filter(free).flat_map(|at| {
        let name = &lower[at];
        let of_axis = |place: usize, axis: &str| {
            let other = format!("{}{axis}{}", &name[..place], &name[place + 1..]);
            (0..lower.len())
                .filter(free)
                .find(|other_at| lower[*other_at] == other)
        };
        name.match_indices('x')
            .filter_map(|(place, _)| Some([at, of_axis(place, "y")?, of_axis(place, "z")?]))
            .collect::<Vec<_>>()
    });
    let likeness = |[at, ..]: &[usize; 3]| likeness(&lower[*at], spellings, "x");
    // Of several alike the first.
    let best = triads.reduce(|best, other| match likeness(&other) > likeness(&best) {
        true => other,
        false => best,
    })?;
    if likeness(&best) < floor {
        return None;
    }
    taken.extend(best);
    Some(best)
}

/// How much a name in small letters is like the most alike of `spellings`, `?` being the axis.
fn likeness(name: &str, spellings: &[&str], axis: &str) -> f64 {
    let like = |s: &&str| strsim::jaro_winkler(&s.replace('?', axis), name);
    spellings.iter().map(like).fold(0.0, f64::max)
}

/// What `--columns` calls a column.
fn entry(names: &[String], at: usize) -> String {
    // A comma or quote in a name would end the entry, and of two of one name it would be the first; its number says
    // which.
    let plain = !names[at].contains([',', '\'', '=']);
    let alone = names.iter().filter(|name| **name == names[at]).count() == 1;
    match plain && alone {
        true => shown(&names[at]),
        false => (at + 1).to_string(),
    }
}

/// The column most like one of `spellings`, `?` being the axis, unless it is taken or unlike them all.
fn most_like(
    names: &[String],
    spellings: &[&str],
    axis: &str,
    taken: &mut Vec<usize>,
) -> Option<String> {
    let likeness = |name: &str| likeness(&name.to_lowercase(), spellings, axis);
    // `acc_x`, `AccX [g]`, `ax_raw`, but not `zeit`.
    let ends = |word: &str| !word.is_empty() && word.ends_with(axis);
    let fits = |name: &String| {
        let name = name.to_lowercase();
        name.split(|c: char| !c.is_alphanumeric()).any(ends)
    };
    let free = (0..names.len()).filter(|i| !taken.contains(i) && fits(&names[*i]));
    let best = free.max_by(|&a, &b| likeness(&names[a]).total_cmp(&likeness(&names[b])))?;
    if likeness(&names[best]) < LIKE {
        return None;
    }
    taken.push(best);
    Some(entry(names, best))
}
