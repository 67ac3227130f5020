//! `/config`: which buffers hold which sensor.

use calib::recording::shown::shown;
use serde_json::Value;

/// Longest name of a buffer, bytes, and most sets of an export: every request names them.
const LONGEST: usize = 100;
const SETS: usize = 64;

/// The buffers of one sensor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Buffers {
    /// x, y, z.
    pub(super) values: [String; 3],
    /// Time.
    pub(super) time: String,
}

/// Experiment that is open on the phone.
#[derive(Clone, Debug)]
pub(super) struct Experiment {
    pub(super) title: String,
    inputs: Vec<(String, Option<Buffers>)>,
    /// Number of buffer sets in its export.
    pub(super) export_sets: usize,
}

impl Experiment {
    /// Reads the answer to `/config`; `None` where it is another document.
    pub(super) fn parse(text: &[u8]) -> Option<Self> {
        let document: Value = serde_json::from_slice(text).ok()?;
        let inputs = document.get("inputs")?.as_array()?;
        let input = |input: &Value| {
            let source = input.get("source")?.as_str()?.to_owned();
            Some((source, input.get("outputs").and_then(buffers)))
        };
        let title = ["localTitle", "title"]
            .iter()
            .find_map(|key| document.get(key)?.as_str());
        Some(Self {
            title: shown(title.unwrap_or("")),
            inputs: inputs.iter().filter_map(input).collect(),
            export_sets: document
                .get("export")
                .and_then(Value::as_array)
                .map_or(0, Vec::len)
                .min(SETS),
        })
    }

    /// The buffers of an input, by phyphox's name of it.
    pub(super) fn sensor(&self, source: &str) -> Option<&Buffers> {
        let of =
            |(name, buffers): &'_ (String, Option<Buffers>)| name == source && buffers.is_some();
        self.inputs
            .iter()
            .find(|input| of(input))
            .and_then(|(_, buffers)| buffers.as_ref())
    }

    /// The names of its inputs.
    pub(super) fn found(&self) -> String {
        let names: Vec<&str> = self.inputs.iter().map(|(name, _)| name.as_str()).collect();
        if names.is_empty() {
            "none".to_owned()
        } else {
            shown(&names.join(", "))
        }
    }
}

/// `[{"x": "accX"}, {"y": "accY"}, …, {"t": "acc_time"}]`, in any order.
fn buffers(outputs: &Value) -> Option<Buffers> {
    let name = |of: &str| {
        let named = outputs
            .as_array()?
            .iter()
            .find_map(|output| output.get(of)?.as_str());
        named
            .filter(|name| name.len() <= LONGEST)
            .map(str::to_owned)
    };
    Some(Buffers {
        values: [name("x")?, name("y")?, name("z")?],
        time: name("t")?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn buffers_are_found_by_input_and_axis() {
        let text = r#"{"title": "Acceleration (with g)", "buffers": [], "inputs": [
            {"source": "linear_acceleration", "outputs": [{"x": "l"}, {"abs": "a"}]},
            {"source": "accelerometer", "outputs": [{"t": "acc_time"}, {"y": "accY"}, {"x": "accX"}, {"z": "accZ"}]}],
            "export": [{"set": "Accelerometer", "sources": []}]}"#;
        let experiment = Experiment::parse(text.as_bytes()).unwrap();
        let buffers = experiment.sensor("accelerometer").unwrap();
        assert_eq!(buffers.values, ["accX", "accY", "accZ"]);
        assert_eq!(buffers.time, "acc_time");
        assert!(
            experiment.sensor("gyroscope").is_none()
                && experiment.sensor("linear_acceleration").is_none()
        );
        assert_eq!(
            (experiment.found().as_str(), experiment.export_sets),
            ("linear_acceleration, accelerometer", 1)
        );
        assert!(Experiment::parse(b"<html>").is_none());
    }
}
