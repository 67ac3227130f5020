//! What boards, vehicles and their tools print and write: blocks, sentences, records in braces, clocks of their own.

use std::fmt::Write as _;

use stillpoint_recording::{ReadOptions, Recording};

use crate::session::{G, Session, is_it, read, read_as, session, table, xyz};

/// The session in g and degrees per second, at a rate that is given.
fn at_50_hz(text: &str) -> Recording {
    let options = ReadOptions {
        rate: Some(50.0),
        ..ReadOptions::default()
    };
    read_as(text, &options).unwrap()
}

/// The three readings of a row, times a factor.
fn parts(value: &nalgebra::Vector3<f64>, scale: f64) -> [String; 3] {
    [0, 1, 2].map(|axis| format!("{:.6}", value[axis] * scale))
}

/// A block of lines for every row of the session, in g and degrees per second.
fn blocks(s: &Session, block: impl Fn([String; 3], [String; 3]) -> String) -> String {
    let degrees = 180.0 / std::f64::consts::PI;
    (0..s.t.len()).fold(String::new(), |mut text, k| {
        let block = block(parts(&s.force[k], 1.0 / G), parts(&s.rate[k], degrees));
        let _ = writeln!(text, "{block}");
        text
    })
}

#[test]
fn blocks_of_several_lines_are_rows() {
    let s = session();
    for text in [
        blocks(&s, |[x, y, z], [p, q, r]| {
            format!(
                "TEMPERATURE: 26.30\nACCELERO  X: {x}\tY: {y}\tZ: {z}\nGYRO      X: {p}\tY: {q}\tZ: {r}\n=====\n"
            )
        }),
        blocks(&s, |[x, y, z], [p, q, r]| {
            format!(
                "=====\ntemp : 25.1\naccX : {x}\taccY : {y}\taccZ : {z}\ngyroX : {p}\tgyroY : {q}\tgyroZ : {r}"
            )
        }),
        blocks(&s, |[x, y, z], [p, q, r]| {
            format!("G: {p}, {q}, {r} deg/s\nA: {x}, {y}, {z} g\nM: 0.1, 0.2, 0.3 gauss\n")
        }),
        blocks(&s, |[x, y, z], [p, q, r]| {
            format!("Accl:\tx= {x} |\ty= {y} |\tz= {z}\nGyro:\tx= {p} |\ty= {q} |\tz= {r}\n--")
        }),
        blocks(&s, |[x, y, z], [p, q, r]| {
            format!(
                "Accel: {{'x': {x}, 'y': {y}, 'z': {z}}} Gyro: {{'x': {p}, 'y': {q}, 'z': {r}}}"
            )
        }),
        blocks(&s, |f, w| format!("{}\t{}\t", f.join("\t"), w.join("\t"))),
    ] {
        is_it(&at_50_hz(&text), &s, 1e-4);
    }
}

/// A row of the session in SI units, with the milliseconds before it.
fn lines(s: &Session, line: impl Fn(u64, [String; 3], [String; 3]) -> String) -> String {
    table("", |k| {
        let ms = (1e3 * s.t[k]).round() as u64;
        line(ms, parts(&s.force[k], 1.0), parts(&s.rate[k], 1.0))
    })
}

/// The time of day of so many milliseconds after noon.
fn noon(ms: u64) -> String {
    let seconds = ms / 1000;
    format!(
        "12:{:02}:{:02}.{:03}",
        seconds / 60,
        seconds % 60,
        ms % 1000
    )
}

#[test]
fn what_stands_around_a_message_is_no_part_of_its_numbers() {
    let s = session();
    for text in [
        lines(&s, |ms, f, w| {
            format!("2026-05-01 {} {},{}", noon(ms), f.join(","), w.join(","))
        }),
        lines(&s, |ms, f, w| {
            format!("$PIMU,{ms},{},{}*5A", f.join(","), w.join(","))
        }),
        // The clock of the device is finer than that of the terminal.
        lines(&s, |ms, [x, y, z], [p, q, r]| {
            let stamp = &noon(ms)[..10];
            format!(
                "2026-05-01 {stamp}: IMU {{TimeUS : {}, I : 0, GyrX : {p}, GyrY : {q}, GyrZ : {r}, AccX : {x}, AccY : {y}, AccZ : {z}, T : 25.0}}",
                1000 * ms
            )
        }),
        lines(&s, |ms, [x, y, z], [p, q, r]| {
            format!(
                "2026-05-01T{},FE,0,0,mavlink_imu_t,time_usec,{},xacc,{x},yacc,{y},zacc,{z},xgyro,{p},ygyro,{q},zgyro,{r},id,0",
                noon(ms),
                1000 * ms
            )
        }),
    ] {
        is_it(&read(&text), &s, 1e-4);
    }
}

#[test]
fn names_of_loggers_are_understood() {
    let s = session();
    let stamped = |k: usize| {
        (
            format!("2026-05-01 {}", noon((1e3 * s.t[k]).round() as u64)),
            k as u64,
        )
    };
    let row = |k: usize| format!("{},{}", xyz(&s.force[k], 1.0), xyz(&s.rate[k], 1.0));
    let degrees = 180.0 / std::f64::consts::PI;
    for text in [
        // Campbell's, with what is of each column below the names and units.
        table(
            "\"TOA5\",\"CR6\",\"CR6\",\"1\",\"CR6.Std.10\",\"CPU:imu.CR6\",\"1\",\"Imu\"\n\"TIMESTAMP\",\"RECORD\",\"AccX\",\"AccY\",\"AccZ\",\"GyrX\",\"GyrY\",\"GyrZ\"\n\"TS\",\"RN\",\"m/s^2\",\"m/s^2\",\"m/s^2\",\"rad/s\",\"rad/s\",\"rad/s\"\n\"\",\"\",\"Smp\",\"Smp\",\"Smp\",\"Smp\",\"Smp\",\"Smp\"",
            |k| {
                let (stamp, number) = stamped(k);
                format!("\"{stamp}\",{number},{}", row(k))
            },
        ),
        // A column of dates with their times, behind the others.
        table("roll,ax,ay,az,gx,gy,gz,date", |k| {
            format!("1.5,{},{}", row(k), stamped(k).0)
        }),
        // A temperature called T, whose unit is that of an angle too.
        table(
            "Chip Time()\tax(m/s²)\tay(m/s²)\taz(m/s²)\twx(deg/s)\twy(deg/s)\twz(deg/s)\tT(°)",
            |k| {
                let cells = format!(
                    "{},{},25.1",
                    xyz(&s.force[k], 1.0),
                    xyz(&s.rate[k], degrees)
                );
                format!("{}\t{}", stamped(k).0, cells.replace(',', "\t"))
            },
        ),
        // A channel that is called after the number of its device.
        table(
            "DATA_START\nTime (ms),6251.12:scaledAccelX,6251.12:scaledAccelY,6251.12:scaledAccelZ,6251.12:scaledGyroX,6251.12:scaledGyroY,6251.12:scaledGyroZ",
            |k| format!("{},{}", 20 * k, row(k)),
        ),
    ] {
        is_it(&read(&text), &s, 1e-4);
    }
    // A unit with a word of the time in it is no stamp of the gyroscope's own.
    let text = table(
        "Sample,Time,XGYRO_OUT (Deg/sec),YGYRO_OUT (Deg/sec),ZGYRO_OUT (Deg/sec),XACCL_OUT (mg),YACCL_OUT (mg),ZACCL_OUT (mg)",
        |k| {
            let (rate, force) = (xyz(&s.rate[k], degrees), xyz(&s.force[k], 1e3 / G));
            format!("{k},{:.4},{rate},{force}", s.t[k])
        },
    );
    is_it(&read(&text), &s, 1e-4);
    // A week that ends within the recording is no device.
    let text = table("GPSWeek,GPSTime,ax,ay,az,gx,gy,gz", |k| {
        let tow = 604_790.0 + s.t[k];
        let week = 2395 + u32::from(tow >= 604_800.0);
        format!("{week},{:.3},{}", tow % 604_800.0, row(k))
    });
    is_it(&read(&text), &s, 1e-4);
    // A day without a time is no stamp.
    let days = table("date,ax,ay,az,gx,gy,gz", |k| {
        format!("2026-05-01,{}", row(k))
    });
    let error = read_as(&days, &ReadOptions::default()).unwrap_err();
    let words = error.text(findings::Front::CommandLine);
    assert!(words.contains("no column with the time"), "{words}");
}

#[test]
fn a_label_of_one_sensor_is_another_program_s_where_the_cells_are_fewer() {
    let s = session();
    let text = lines(&s, |ms, f, w| {
        format!(
            "Accel,{ms},{}\nGyro,{},{}",
            f.join(","),
            ms + 2,
            w.join(",")
        )
    });
    let found = read(&text);
    assert_eq!(found.description.format, "long");
    let accel = found.accelerometer.unwrap();
    assert_eq!(accel.len(), s.t.len());
}

#[test]
fn names_before_the_numbers_of_examples_are_those_of_their_numbers() {
    let s = session();
    let at_50_hz = ReadOptions {
        rate: Some(50.0),
        ..ReadOptions::default()
    };
    let (mg, mdps) = (1e3 / G, 180e3 / std::f64::consts::PI);
    for block in [
        |f: &str, w: &str| format!("LSM6DSL [acc/mg]:  {f}\nLSM6DSL [gyro/mdps]: {w}"),
        |f: &str, w: &str| {
            let [f, w] = [f, w].map(|numbers| numbers.replace(',', "\t"));
            format!("Acceleration [mg]:{f}\nAngular rate [mdps]:{w}\nTemperature [degC]: 25.1")
        },
        |f: &str, w: &str| {
            let lines = |numbers: &str| {
                let axes = ["x", "y", "z"].into_iter().zip(numbers.split(','));
                axes.map(|(axis, number)| format!("{axis}: {number}\n"))
                    .collect::<String>()
            };
            format!(
                "Accelerometer data in mg\n{}Gyroscope data in mdps\n{}Temp: 25.1 C",
                lines(f),
                lines(w)
            )
        },
    ] {
        let text = table("", |k| block(&xyz(&s.force[k], mg), &xyz(&s.rate[k], mdps)));
        is_it(&read_as(&text, &at_50_hz).unwrap(), &s, 1e-4);
    }
    // An old sketch that everybody has: counts below the names of their axes.
    let counts = |value: &nalgebra::Vector3<f64>, scale: f64| {
        let whole = |v: &f64| format!("{:.0}", v * scale);
        value.iter().map(whole).collect::<Vec<_>>().join(", ")
    };
    let text = table("InvenSense MPU-6050\nWHO_AM_I : 68, error = 0", |k| {
        let (force, rate) = (counts(&s.force[k], 1671.0), counts(&s.rate[k], 7506.0));
        format!(
            "MPU-6050\nRead accel, temp and gyro, error = 0\naccel x,y,z: {force}\ntemperature: 31.047 degrees Celsius\ngyro x,y,z : {rate}, "
        )
    });
    let found = read_as(&text, &at_50_hz).unwrap();
    let force = found.accelerometer.unwrap();
    assert_eq!(force.len(), 1600);
    assert!((force.values[150] / 1671.0 - s.force[150]).amax() < 1e-3);
}

#[test]
fn lists_in_cells_are_read() {
    let s = session();
    for (header, begin, end) in [
        ("t,acc,gyro", "\"[", "]\""),
        ("t,acc,gyro", "(", ")"),
        ("", "(", ")"),
    ] {
        let text = table(header, |k| {
            let (force, rate) = (xyz(&s.force[k], 1.0), xyz(&s.rate[k], 1.0));
            let row = format!("{:.3},{begin}{force}{end},{begin}{rate}{end}", s.t[k]);
            if header.is_empty() {
                format!("({row})")
            } else {
                row
            }
        });
        is_it(&read(&text), &s, 1e-4);
    }
}
