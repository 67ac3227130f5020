//! ArduPilot's `IMU` message as a table, as mavlogdump and Mission Planner export it.

use findings::{Finding, Kind};

/// Columns of the message that no other table has beside `GyrX` and `AccX`: counts of errors, health, rates.
const OWN: [&str; 6] = ["EG", "EA", "GH", "AH", "GHz", "AHz"];

/// Builds the finding about readings that ArduPilot had corrected.
pub(crate) fn corrected() -> Finding {
    Finding::of(Kind::CORRECTED_BY_SYSTEM)
        .detail("system", "ArduPilot")
        .detail("columns", "IMU")
        .detail("raw", "The .BIN log")
}

/// Returns true if the names are the columns of ArduPilot's message `IMU`.
pub(crate) fn is_imu(names: &[String]) -> bool {
    let has = |wanted: &str| names.iter().any(|name| name == wanted);
    has("GyrX") && has("AccX") && OWN.iter().filter(|name| has(name)).count() > 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_message_is_known_by_columns_that_it_has_beside_the_readings() {
        let names = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<_>>();
        assert!(is_imu(&names(
            "timestamp,TimeUS,I,GyrX,GyrY,GyrZ,AccX,AccY,AccZ,EG,EA,T,GH,AH,GHz,AHz"
        )));
        assert!(!is_imu(&names("t,AccX,AccY,AccZ,GyrX,GyrY,GyrZ,T")));
    }
}
