//! Columns that the user says the roles of, by name or by number.

use findings::{Finding, Kind};

use super::affine::{self, Affine};
use super::suggest::nearest;
use crate::recording::options::{ColumnMap, Role};
use crate::shown::shown;

/// Refuses one column for two roles.
///
/// # Errors
/// Both.
pub(crate) fn refuse_twins(names: &[String], map: &ColumnMap) -> Result<(), Box<Finding>> {
    // A column that is not there is for another to refuse.
    let roles = roles_by_map(names, map).unwrap_or_default();
    for (i, (role, column)) in roles.iter().enumerate() {
        if let Some(other) = roles[..i].iter().position(|(_, other)| other == column) {
            let given = |i: usize| format!("{}={}", map.0[i].0.name(), shown(&map.0[i].1));
            return Err(Finding::of(Kind::COLUMN_FOR_TWO)
                .detail("given", format!("{},{}", given(other), given(i)))
                .count("column", column + 1)
                .detail("first", roles[other].0.name())
                .detail("second", role.name())
                .into());
        }
    }
    Ok(())
}

/// The column called `wanted`, or numbered so from 1.
fn column(names: &[String], wanted: &str) -> Option<usize> {
    let by_name = names.iter().position(|name| name.trim() == wanted);
    let number = || wanted.parse::<usize>().ok();
    by_name.or_else(|| {
        number()
            .filter(|n| (1..=names.len()).contains(n))
            .map(|n| n - 1)
    })
}

/// Returns the user's scales and offsets. An expression that is also the name of a column is read as the name.
pub(crate) fn affines(names: &[String], map: &ColumnMap) -> Vec<(Role, Affine)> {
    let of = |(role, wanted): &(Role, String)| {
        let (_, affine) = affine::take_apart(wanted)?;
        column(names, wanted).is_none().then_some((*role, affine))
    };
    map.0.iter().filter_map(of).collect()
}

/// Columns by name first, then by number from 1.
pub(crate) fn roles_by_map(
    names: &[String],
    map: &ColumnMap,
) -> Result<Vec<(Role, usize)>, Box<Finding>> {
    let find = |wanted: &str| {
        column(names, wanted).or_else(|| column(names, affine::take_apart(wanted)?.0))
    };
    let mut roles = Vec::new();
    for (role, wanted) in &map.0 {
        let column = find(wanted).ok_or_else(|| {
            let missing = Finding::of(Kind::NO_SUCH_COLUMN)
                .detail("role", role.name())
                .detail("wanted", shown(wanted))
                .count("count", names.len());
            match nearest(wanted, names) {
                Some(nearest) => missing.detail("nearest", shown(nearest)),
                None => missing,
            }
        })?;
        roles.push((*role, column));
    }
    Ok(roles)
}
