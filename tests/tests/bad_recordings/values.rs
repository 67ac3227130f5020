//! Section D: values and units.

use super::*;

/// The usual rows with accelerometer and gyroscope times a factor each.
fn scaled(header: &str, accel: f64, gyro: f64) -> String {
    let line = |row: &String| {
        let v: Vec<f64> = row.split(',').map(|c| c.parse().unwrap()).collect();
        let value = |i: usize| v[i] * if i < 4 { accel } else { gyro };
        let cells: Vec<_> = (1..7).map(|i| value(i).to_string()).collect();
        format!("{},{}", v[0], cells.join(","))
    };
    file(header, &rows(200).iter().map(line).collect::<Vec<_>>())
}

#[test]
fn row_80_units_of_the_header_are_converted_and_g_is_recognised() {
    let usual = read(scaled(HEADER, 1.0, 1.0), &ReadOptions::default()).unwrap();
    let usual = usual.accelerometer.unwrap();
    for (unit, factor) in [
        ("g", 1.0 / 9.80665),
        ("mg", 1000.0 / 9.80665),
        ("cm/s^2", 100.0),
        ("m/s²", 1.0),
    ] {
        let header = format!("t,ax ({unit}),ay ({unit}),az ({unit}),gx,gy,gz");
        let recording = read(scaled(&header, factor, 1.0), &ReadOptions::default()).unwrap();
        assert_eq!(
            recording.warnings.texts(findings::Front::CommandLine),
            Vec::<String>::new(),
            "{unit}"
        );
        let accel = recording.accelerometer.unwrap();
        // Two roundings per value, at 10 m/s².
        assert!(
            accel
                .values
                .iter()
                .zip(&usual.values)
                .all(|(a, b)| (a - b).amax() < 1e-14),
            "{unit}"
        );
    }
    warned(
        scaled(HEADER, 1.0 / 9.80665, 1.0),
        &["accelerometer is taken as g", "--accel-unit"],
    );
    warned(
        scaled(HEADER, 1000.0, 1.0),
        &["accelerometer is taken as raw counts"],
    );
}

#[test]
fn row_80_a_row_of_units_under_the_header_is_used() {
    let rows = rows(200);
    let units = "s,m/s^2,m/s^2,m/s^2,rad/s,rad/s,rad/s";
    for (header, units) in [
        (HEADER, units),
        (HEADER, "[s],[m/s²],[m/s²],[m/s²],(rad/s),(rad/s),(rad/s)"),
        (HEADER, ",-,-,-,rad/s,rad/s,rad/s"),
        ("# a log\n#t,ax,ay,az,gx,gy,gz", &format!("#{units}")),
    ] {
        read_as_usual(file(&format!("{header}\n{units}"), &rows), 200);
    }
    // A comment is no row of units for holding one.
    read_as_usual(file(&format!("{HEADER}\n# g"), &rows), 200);
    let degrees = units.replace("rad", "deg");
    let recording = read(
        file(&format!("{HEADER}\n{degrees}"), &rows),
        &ReadOptions::default(),
    );
    let z = recording.unwrap().gyroscope.unwrap().values[0].z;
    assert_eq!(z, 2f64.to_radians());
    // Line numbers hold, the header is known again.
    let mut repeated = rows.clone();
    repeated[9] = HEADER.to_owned();
    refused(
        file(&format!("{HEADER}\n{units}"), &repeated),
        "12:1",
        &["header of line 1 comes again"],
    );
}

#[test]
fn row_80_a_row_of_units_that_contradicts_is_refused_or_overruled() {
    let text = |units: &str| file(&format!("{HEADER}\n{units}"), &rows(200));
    for units in [
        "s,m/s^2,g,m/s^2,rad/s,rad/s,rad/s",
        "s,yd/s^2,yd/s^2,yd/s^2,rad/s,rad/s,rad/s",
        "s,rad/s,m/s^2,m/s^2,rad/s,rad/s,rad/s",
    ] {
        refused(text(units), "2", &["a row of units", "--accel-unit"]);
    }
    let options = ReadOptions {
        accel_unit: Some("m/s^2".parse().unwrap()),
        ..ReadOptions::default()
    };
    let overruled = "s,g,g,g,rad/s,rad/s,rad/s";
    let words = ["accelerometer is taken as m/s^2", "says g"];
    assert_same_samples(&warned_with(text(overruled), &options, &words), 200);
    let unknown = "s,yd/s^2,yd/s^2,yd/s^2,rad/s,rad/s,rad/s";
    let recording = read(text(unknown), &options).unwrap();
    assert_eq!(
        recording.warnings.texts(findings::Front::CommandLine),
        Vec::<String>::new()
    );
}

#[test]
fn row_81_degrees_are_converted_when_stated_or_when_a_hand_cannot_turn_so_fast() {
    let degrees = scaled(
        "t,ax,ay,az,gx [deg/s],gy [deg/s],gz [deg/s]",
        1.0,
        1f64.to_degrees(),
    );
    let recording = read(degrees, &ReadOptions::default()).unwrap();
    assert!((recording.gyroscope.unwrap().values[0].z - 2.0).abs() < 1e-14);
    let suffixed = scaled(
        "time_s,ax_g,ay_g,az_g,gx_dps,gy_dps,gz_dps",
        1.0 / 9.80665,
        100.0,
    );
    let recording = read(suffixed, &ReadOptions::default()).unwrap();
    assert_eq!(
        recording.warnings.texts(findings::Front::CommandLine),
        Vec::<String>::new()
    );
    assert!((recording.gyroscope.unwrap().values[0].z - 200f64.to_radians()).abs() < 1e-14);
    let recording = warned(scaled(HEADER, 1.0, 150.0), &["gyroscope is taken as deg/s"]);
    assert!((recording.gyroscope.unwrap().values[0].z - 300f64.to_radians()).abs() < 1e-14);
}

#[test]
fn rows_82_and_83_columns_go_by_name() {
    let lines: Vec<String> = rows(200)
        .iter()
        .map(|row| row.split(',').rev().collect::<Vec<_>>().join(","))
        .collect();
    read_as_usual(file("gz,gy,gx,az,ay,ax,t", &lines), 200);
    read_as_usual(
        file(
            "field.angular_velocity.z,field.angular_velocity.y,field.angular_velocity.x,field.linear_acceleration.z,field.linear_acceleration.y,field.linear_acceleration.x,%time",
            &lines,
        ),
        200,
    );
    read_as_usual(
        file(
            "w_RS_S_z [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_x [rad s^-1],a_RS_S_z [m s^-2],a_RS_S_y [m s^-2],a_RS_S_x [m s^-2],t",
            &lines,
        ),
        200,
    );
}

#[test]
fn row_89_absurd_sizes_are_refused() {
    let mut lines = rows(50);
    lines[3] = format!("0.03,1{},0,0,0,0,0", "0".repeat(300));
    let error = read(file(HEADER, &lines), &ReadOptions::default()).unwrap_err();
    assert!(error.to_string().len() < 200, "{error}");
    let mut lines = rows(200);
    lines[5] = "0.05,1e300,0,0,0,0,0".to_owned();
    refused(file(HEADER, &lines), "7:6", &["`1e300`", "unit"]);
    refused(
        scaled(HEADER, 1.0, 1e-300),
        "",
        &["gyroscope x", "wrong unit"],
    );
}

#[test]
fn rows_90_and_91_an_axis_that_never_changes_is_refused() {
    for (value, why) in [("3.25", "stuck"), ("0", "disconnected")] {
        let lines: Vec<_> = rows(200)
            .iter()
            .map(|row| {
                let mut cells: Vec<_> = row.split(',').collect();
                cells[2] = value;
                cells.join(",")
            })
            .collect();
        refused(
            file(HEADER, &lines),
            "2",
            &["accelerometer y", "line 201", why],
        );
    }
}

#[test]
fn a_gyroscope_that_stops_while_the_accelerometer_goes_on_is_refused() {
    let mut lines = rows(600);
    for line in &mut lines[300..] {
        let force: Vec<&str> = line.split(',').take(4).collect();
        *line = format!("{},0,0,0", force.join(","));
    }
    refused(
        file(HEADER, &lines),
        "",
        &[
            "the gyroscope reads 0 on all axes from t = 3.00 s",
            "disconnected",
        ],
    );
}

#[test]
fn row_92_saturated_rows_are_counted() {
    let limit = 250f64.to_radians();
    let lines: Vec<_> = (0..400)
        .map(|i| {
            let row = row(0.01 * i as f64, i);
            let head = row.rsplit_once(',').unwrap().0.to_owned();
            let rate = (6.0 * (i as f64 * 0.031).sin()).clamp(-limit, limit);
            format!("{head},{rate:.6}")
        })
        .collect();
    let recording = warned(file(HEADER, &lines), &["gyroscope z is saturated at 4.36"]);
    assert_eq!(recording.gyroscope.unwrap().len(), 400);
}

#[test]
fn row_95_an_accelerometer_without_gravity_is_refused() {
    refused(scaled(HEADER, 0.01, 1.0), "", &["gravity has been removed"]);
}

#[test]
fn row_98_temperatures_are_converted_or_left_out() {
    let with = |header: &str, reading: f64| {
        let lines: Vec<_> = rows(200)
            .iter()
            .map(|row| format!("{row},{reading}"))
            .collect();
        read(
            file(&format!("{HEADER},{header}"), &lines),
            &ReadOptions::default(),
        )
        .unwrap()
    };
    assert_eq!(with("temp", 25.0).temperature.unwrap().celsius[7], 25.0);
    assert!((with("temp [K]", 298.15).temperature.unwrap().celsius[7] - 25.0).abs() < 1e-12);
    assert!((with("temp (°F)", 77.0).temperature.unwrap().celsius[7] - 25.0).abs() < 1e-12);
    let counts = with("temp", 298.15);
    assert!(
        counts.temperature.is_none()
            && counts.warnings.texts(findings::Front::CommandLine)[0].contains("temperatures")
    );
}

#[test]
fn rows_101_and_102_one_sensor_alone_is_a_recording() {
    let keep = |columns: [usize; 4]| -> Vec<String> {
        let cut = |row: &String| {
            let cells: Vec<_> = row.split(',').collect();
            columns.map(|i| cells[i]).join(",")
        };
        rows(200).iter().map(cut).collect()
    };
    let accel = warned(file("t,ax,ay,az", &keep([0, 1, 2, 3])), &["no gyroscope"]);
    assert!(accel.gyroscope.is_none() && accel.accelerometer.unwrap().len() == 200);
    let gyro = warned(
        file("t,gx,gy,gz", &keep([0, 4, 5, 6])),
        &["no accelerometer"],
    );
    assert!(gyro.accelerometer.is_none() && gyro.gyroscope.unwrap().len() == 200);
}

#[test]
fn row_103_sixteen_bits_that_overflow_are_refused() {
    let line = |i: usize| {
        let rate = ((400 * i + 10_000) as i64 + 32_768).rem_euclid(65_536) - 32_768;
        format!(
            "{:.2},{},{},16384,{rate},{},{}",
            0.01 * i as f64,
            i % 9,
            i % 7,
            i % 5,
            i % 3
        )
    };
    let mut lines: Vec<_> = (0..200).map(line).collect();
    lines[0] = lines[0].replace("16384", "16380");
    refused(
        file(HEADER, &lines),
        "59",
        &["gyroscope x", "beyond what 16 bits hold"],
    );
}
