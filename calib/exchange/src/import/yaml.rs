//! Numbers of a YAML or JSON document, however it writes lists of them.

use nalgebra::Matrix3;
use saphyr::Yaml;

/// A number; PyYAML writes some floats so that YAML 1.2 takes them for text, such as `1e-05`.
fn number(value: &Yaml<'_>) -> Option<f64> {
    let number = value
        .as_floating_point()
        .or(value.as_integer().map(|i| i as f64));
    let number = number.or_else(|| value.as_str()?.trim().parse().ok());
    number.filter(|v| v.is_finite())
}

/// Numbers in order: a list, a list of lists, or the `data` of OpenCV and ROS.
pub(super) fn number_list(value: &Yaml<'_>) -> Option<Vec<f64>> {
    if let Some(data) = value.as_mapping_get("data") {
        return number_list(data);
    }
    let mut all = Vec::new();
    for item in value.as_vec()? {
        match item.as_vec() {
            Some(row) => all.extend(row.iter().map(number).collect::<Option<Vec<f64>>>()?),
            None => all.push(number(item)?),
        }
    }
    Some(all)
}

/// Nine numbers, row by row.
pub(super) fn matrix_of(value: &Yaml<'_>) -> Option<Matrix3<f64>> {
    let rows = value
        .as_vec()
        .filter(|rows| rows.first().is_some_and(|row| row.as_vec().is_some()));
    let is_square = rows.is_none_or(|rows| {
        rows.len() == 3
            && rows
                .iter()
                .all(|row| row.as_vec().is_some_and(|r| r.len() == 3))
    });
    let all = number_list(value).filter(|all| is_square && all.len() == 9)?;
    Some(Matrix3::from_row_slice(&all))
}
