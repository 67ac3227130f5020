//! Logs of flight controllers.

use super::Rows;

fn message(kind: u8, body: &[u8]) -> Vec<u8> {
    let mut bytes = (body.len() as u16).to_le_bytes().to_vec();
    bytes.push(kind);
    bytes.extend(body);
    bytes
}

/// A topic of a PX4 log: its name, instance and rows.
pub type Px4Topic<'a> = (&'a str, u8, &'a Rows);

/// A PX4 log with `sensor_accel` and `sensor_gyro`, parameters, and a dropout at its end.
pub fn ulog(topics: &[Px4Topic<'_>], parameters: &[(&str, f32)]) -> Vec<u8> {
    let mut file = b"ULog\x01\x12\x35\x01".to_vec();
    file.extend([0; 8]);
    file.extend(message(b'B', &[0; 40]));
    for name in ["sensor_accel", "sensor_gyro"] {
        let format = format!(
            "{name}:uint64_t timestamp;uint64_t timestamp_sample;uint32_t device_id;float x;float y;float z;float temperature;uint32_t error_count;uint8_t[4] _padding0;"
        );
        file.extend(message(b'F', format.as_bytes()));
    }
    for (name, value) in parameters {
        let key = format!("float {name}");
        let mut body = vec![key.len() as u8];
        body.extend(key.as_bytes());
        body.extend(value.to_le_bytes());
        file.extend(message(b'P', &body));
    }
    for (id, (name, instance, rows)) in (0u16..).zip(topics) {
        let mut body = vec![*instance];
        body.extend(id.to_le_bytes());
        body.extend(name.as_bytes());
        file.extend(message(b'A', &body));
        for (stamp, value) in *rows {
            let micros = (*stamp / 1000) as u64;
            let mut body = id.to_le_bytes().to_vec();
            body.extend((micros + 400).to_le_bytes());
            body.extend(micros.to_le_bytes());
            body.extend(1_310_988u32.to_le_bytes());
            body.extend(value.iter().flat_map(|v| (*v as f32).to_le_bytes()));
            body.extend(35f32.to_le_bytes());
            body.extend([0; 8]);
            file.extend(message(b'D', &body));
        }
    }
    file.extend(message(b'O', &120u16.to_le_bytes()));
    file
}

fn format_of(id: u8, length: u8, name: &str, types: &str, labels: &str) -> Vec<u8> {
    let mut bytes = vec![0xa3, 0x95, 128, id, length];
    for (text, size) in [(name, 4), (types, 16), (labels, 64)] {
        let mut field = text.as_bytes().to_vec();
        field.resize(size, 0);
        bytes.extend(field);
    }
    bytes
}

/// An ArduPilot log with `IMU`: rows of stamps, ns, forces and rates as the device corrected them, and parameters.
pub fn ardupilot(rows: &[super::ImuRow], parameters: &[(&str, f32)]) -> Vec<u8> {
    let mut file = format_of(128, 89, "FMT", "BBnNZ", "Type,Length,Name,Format,Columns");
    file.extend(format_of(64, 31, "PARM", "QNf", "TimeUS,Name,Value"));
    file.extend(format_of(
        65,
        3 + 8 + 1 + 24 + 4,
        "IMU",
        "QBfffffff",
        "TimeUS,I,GyrX,GyrY,GyrZ,AccX,AccY,AccZ,T",
    ));
    for (name, value) in parameters {
        let mut field = name.as_bytes().to_vec();
        field.resize(16, 0);
        file.extend([0xa3, 0x95, 64]);
        file.extend([0; 8]);
        file.extend(field);
        file.extend(value.to_le_bytes());
    }
    for (stamp, force, rate) in rows {
        file.extend([0xa3, 0x95, 65]);
        file.extend(((*stamp / 1000) as u64).to_le_bytes());
        file.push(0);
        file.extend(
            rate.iter()
                .chain(force)
                .flat_map(|v| (*v as f32).to_le_bytes()),
        );
        file.extend(44f32.to_le_bytes());
    }
    file
}
