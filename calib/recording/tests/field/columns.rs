//! Columns of other kinds: gravity apart, temperatures in counts, magnetometers by many names.

use findings::{Kind, Remedy};
use nalgebra::Vector3;
use stillpoint_recording::{FieldUnit, ReadOptions};

use crate::session::{G, is_it, read, read_as, says, session, table, xyz};

/// What moves beside gravity, in the unit of the file.
fn shaken(k: usize) -> Vector3<f64> {
    Vector3::new(0.01, -0.02, 0.03) * (k as f64 * 0.3).sin()
}

#[test]
fn gravity_and_the_rest_of_the_acceleration_are_added_with_the_sign_of_their_system() {
    let s = session();
    // Apple counts -1 g on the axis that points up.
    let header = "timestamp,gravity.x,gravity.y,gravity.z,rotationRate.x,rotationRate.y,rotationRate.z,userAcceleration.x,userAcceleration.y,userAcceleration.z";
    let apple = table(header, |k| {
        let user = shaken(k);
        let gravity = -s.force[k] / G - user;
        format!(
            "{:.3},{},{},{}",
            s.t[k],
            xyz(&gravity, 1.0),
            xyz(&s.rate[k], 1.0),
            xyz(&user, 1.0)
        )
    });
    let found = read(&apple);
    is_it(&found, &s, 1e-4);
    says(
        &found.warnings.texts(findings::Front::CommandLine),
        "is the sum of columns like `userAcceleration.x`",
    );
    assert!(found.description.sensors[0].turned);
    let header = "t,linearAccelerationX,linearAccelerationY,linearAccelerationZ,gyroX,gyroY,gyroZ,gravityX,gravityY,gravityZ";
    let android = table(header, |k| {
        let linear = shaken(k) * G;
        let gravity = s.force[k] - linear;
        format!(
            "{:.3},{},{},{}",
            s.t[k],
            xyz(&linear, 1.0),
            xyz(&s.rate[k], 1.0),
            xyz(&gravity, 1.0)
        )
    });
    let found = read(&android);
    is_it(&found, &s, 1e-4);
    assert!(!found.description.sensors[0].turned);
    // ROS calls what the accelerometer reads its linear acceleration.
    let ros = android.lines().enumerate().map(|(k, line)| match k {
        0 => format!("{line}\n"),
        k => {
            let cells: Vec<&str> = line.split(',').collect();
            format!(
                "{},{},{},{}\n",
                cells[0],
                xyz(&s.force[k - 1], 1.0),
                cells[4..7].join(","),
                cells[7..].join(",")
            )
        }
    });
    let found = read(&ros.collect::<String>());
    is_it(&found, &s, 1e-4);
    says(
        &found.warnings.texts(findings::Front::CommandLine),
        "holds gravity already",
    );
}

#[test]
fn what_a_user_names_as_the_accelerometer_is_not_added_to() {
    let s = session();
    let header = "t,gravityX,gravityY,gravityZ,userAccelerationX,userAccelerationY,userAccelerationZ,p,q,r,gx,gy,gz";
    let text = table(header, |k| {
        let zero = Vector3::zeros();
        format!(
            "{:.3},{},{},{},{}",
            s.t[k],
            xyz(&zero, 1.0),
            xyz(&zero, 1.0),
            xyz(&s.force[k], 1.0),
            xyz(&s.rate[k], 1.0)
        )
    });
    let options = ReadOptions {
        columns: "ax=p,ay=q,az=r".parse().unwrap(),
        ..ReadOptions::default()
    };
    is_it(&read_as(&text, &options).unwrap(), &s, 1e-4);
}

#[test]
fn temperatures_in_counts_are_never_degrees_and_the_offered_line_makes_them_so() {
    let s = session();
    for (name, counts, celsius) in [
        ("temp", -2220, 30.0),
        ("temperature", 1000, 39.5),
        ("temp (raw)", 20, 36.6),
        ("Temp", -8000, 13.0),
    ] {
        let text = table(&format!("t,ax,ay,az,gx,gy,gz,{name}"), |k| {
            format!(
                "{:.3},{},{},{}",
                s.t[k],
                xyz(&s.force[k], 1.0),
                xyz(&s.rate[k], 1.0),
                counts + k as i32 / 50
            )
        });
        let found = read(&text);
        assert!(found.temperature.is_none(), "{name}");
        let mut all = found.warnings.iter();
        let of_temperature = [Kind::TEMPERATURE_IN_COUNTS, Kind::TEMPERATURE_IMPOSSIBLE];
        let said = all.find(|f| of_temperature.contains(&f.kind)).unwrap();
        let words = said.text(findings::Front::CommandLine);
        assert!(words.contains("MPU-6050"), "{words}");
        let Some(Remedy::Set { any_of }) = said.remedies.first() else {
            panic!("{said:?}");
        };
        let line = any_of[0].value.as_deref().unwrap();
        assert!(words.contains(line), "{words}");
        let options = ReadOptions {
            columns: line.parse().unwrap(),
            ..ReadOptions::default()
        };
        let found = read_as(&text, &options).unwrap();
        is_it(&found, &s, 1e-4);
        assert!(
            (found.temperature.unwrap().celsius[0] - celsius).abs() < 0.1,
            "{name}"
        );
    }
}

#[test]
fn a_magnetometer_is_read_by_many_names_and_what_is_not_read_is_said() {
    let s = session();
    let text = |names: &str| {
        table(&format!("t,ax,ay,az,gx,gy,gz,{names}"), |k| {
            format!(
                "{:.3},{},{},{}",
                s.t[k],
                xyz(&s.force[k], 1.0),
                xyz(&s.rate[k], 1.0),
                xyz(&s.field[k], 1.0)
            )
        })
    };
    for (names, unit) in [
        ("mx_uT,my_uT,mz_uT", Some(FieldUnit::Microtesla)),
        ("mx (nT),my (nT),mz (nT)", Some(FieldUnit::Nanotesla)),
        (
            "mag_x_gauss,mag_y_gauss,mag_z_gauss",
            Some(FieldUnit::Gauss),
        ),
        ("mag_uT_x,mag_uT_y,mag_uT_z", Some(FieldUnit::Microtesla)),
        ("mag_x_T,mag_y_T,mag_z_T", Some(FieldUnit::Tesla)),
        ("magX,magY,magZ", None),
        ("mag[0],mag[1],mag[2]", None),
        (
            "magnetic_x [mG],magnetic_y [mG],magnetic_z [mG]",
            Some(FieldUnit::Milligauss),
        ),
        (
            "MagneticField X (mT),MagneticField Y (mT),MagneticField Z (mT)",
            Some(FieldUnit::Millitesla),
        ),
        ("compass_x (raw),compass_y (raw),compass_z (raw)", None),
        ("x_mag,y_mag,z_mag", None),
    ] {
        let found = read(&text(names));
        is_it(&found, &s, 1e-4);
        let field = found.magnetometer.unwrap_or_else(|| panic!("{names}"));
        assert_eq!(field.unit, unit, "{names}");
        assert!(
            (field.stream.values[0] - s.field[0]).amax() < 1e-4,
            "{names}"
        );
    }
    let odd = text("hmc_mag_a_x,hmc_mag_a_y,hmc_mag_a_z");
    let found = read(&odd);
    assert!(found.magnetometer.is_none());
    says(
        &found.warnings.texts(findings::Front::CommandLine),
        "give the columns of the axes (--columns mx=hmc_mag_a_x,my=hmc_mag_a_y,mz=hmc_mag_a_z)",
    );
    let options = ReadOptions {
        columns: "mx=hmc_mag_a_x,my=hmc_mag_a_y,mz=hmc_mag_a_z"
            .parse()
            .unwrap(),
        mag_unit: Some(FieldUnit::Gauss),
        ..ReadOptions::default()
    };
    let found = read_as(&odd, &options).unwrap();
    is_it(&found, &s, 1e-4);
    assert_eq!(found.magnetometer.unwrap().unit, Some(FieldUnit::Gauss));
    let counts = ReadOptions {
        mag_unit: Some(FieldUnit::Counts),
        ..ReadOptions::default()
    };
    let found = read_as(&text("mx (uT),my (uT),mz (uT)"), &counts).unwrap();
    assert_eq!(found.magnetometer.unwrap().unit, None);
    says(
        &found.warnings.texts(findings::Front::CommandLine),
        "the unit of the magnetometer is taken as counts, as was said, though the file says µT",
    );
}

#[test]
fn a_magnetometer_alone_is_called_so() {
    let s = session();
    let found = read(&table("t,mx (uT),my (uT),mz (uT)", |k| {
        format!("{:.3},{}", s.t[k], xyz(&s.field[k], 1.0))
    }));
    assert!(found.is_magnetometer_only());
    assert_eq!(found.start(), 0.0);
    assert_eq!(
        found.warnings.texts(findings::Front::CommandLine),
        [format!(
            "{}: the recording has no accelerometer and no gyroscope, only the magnetometer; nothing has to be done",
            found.name
        )]
    );
    let warm = read(&table("t,mx,my,mz,temp", |k| {
        format!("{:.3},{},25.0", s.t[k], xyz(&s.field[k], 1.0))
    }));
    assert!(warm.is_magnetometer_only());
}

#[test]
fn a_header_that_comes_again_is_left_out_and_said_once() {
    let s = session();
    let header = "t,ax,ay,az,gx,gy,gz";
    let text = table(header, |k| {
        let again = match k % 500 {
            499 => format!("\n{header}"),
            _ => String::new(),
        };
        let (force, rate) = (xyz(&s.force[k], 1.0), xyz(&s.rate[k], 1.0));
        format!("{:.3},{force},{rate}{again}", s.t[k])
    });
    let found = read(&text);
    is_it(&found, &s, 1e-4);
    let again: Vec<_> = found.warnings.iter().collect();
    assert!(matches!(again[..], [one] if one.kind == Kind::HEADERS_LEFT_OUT));
    assert_eq!(again[0].value("count"), Some(3.0));
    assert_eq!(again[0].value("line"), Some(502.0));
}
