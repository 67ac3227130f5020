//! Lists of three numbers whose order a name beside them states: `"name": "Accelerometer (z,x,y)"` of a camera's streams.

use serde_json::Value;

/// Key of the name.
const NAME: &str = "name";

/// Puts the lists of three of all records in a document in the order x, y, z, where the name beside the records states another.
pub(super) fn in_order(value: &mut Value) {
    match value {
        Value::Object(members) => {
            let order = members.get(NAME).and_then(Value::as_str).and_then(order_of);
            for member in members.values_mut() {
                match (order, member) {
                    (Some(order), Value::Array(records)) => {
                        records.iter_mut().for_each(|record| put(record, order));
                    }
                    (_, member) => in_order(member),
                }
            }
        }
        Value::Array(values) if values.first().is_some_and(Value::is_object) => {
            values.iter_mut().for_each(in_order);
        }
        _ => {}
    }
}

/// The places of x, y and z by the parentheses that end a name.
fn order_of(name: &str) -> Option<[usize; 3]> {
    let (_, order) = name.trim().strip_suffix(')')?.rsplit_once('(')?;
    let axes: Vec<String> = order
        .split(',')
        .map(|axis| axis.trim().to_lowercase())
        .collect();
    let place = |wanted: &str| axes.iter().position(|axis| axis == wanted);
    let order = [place("x")?, place("y")?, place("z")?];
    (axes.len() == order.len()).then_some(order)
}

fn put(record: &mut Value, order: [usize; 3]) {
    let Value::Object(members) = record else {
        return;
    };
    for member in members.values_mut() {
        if let Value::Array(numbers) = member
            && numbers.len() == order.len()
        {
            let sorted = order.map(|place| numbers[place].clone());
            numbers.clone_from_slice(&sorted);
        }
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn lists_are_put_in_the_order_that_their_name_states() {
        for (name, expected) in [
            ("Accelerometer (z,x,y)", json!([1.0, 2.0, 3.0])),
            ("Accelerometer (x,y,z)", json!([3.0, 1.0, 2.0])),
            ("Accelerometer (m/s2)", json!([3.0, 1.0, 2.0])),
            ("Accelerometer", json!([3.0, 1.0, 2.0])),
        ] {
            let mut document = json!({"1": {"ACCL": {"name": name, "samples": [{"value": [3.0, 1.0, 2.0], "cts": 0.0}]}}});
            in_order(&mut document);
            assert_eq!(
                document["1"]["ACCL"]["samples"][0]["value"], expected,
                "{name}"
            );
        }
    }
}
