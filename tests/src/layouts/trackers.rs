//! Data sets, loggers and inertial trackers.

use std::fmt::Write as _;

use nalgebra::Vector3;

use super::layout::{EPOCH, G, Layout, Samples};

fn nanoseconds(t: f64) -> u64 {
    EPOCH * 1_000_000_000 + (t * 1e9).round() as u64
}

fn three(v: &Vector3<f64>) -> String {
    format!("{:.9},{:.9},{:.9}", v.x, v.y, v.z)
}

/// A header and a line for every row.
fn table(
    s: &Samples,
    header: &str,
    line: impl Fn(f64, &Vector3<f64>, &Vector3<f64>) -> String,
) -> String {
    s.rows().fold(header.to_owned(), |mut text, (t, f, w)| {
        let _ = writeln!(text, "{}", line(t, &f, &w));
        text
    })
}

fn imu(t: f64, stamp: &str, f: &Vector3<f64>, w: &Vector3<f64>) -> String {
    let _ = t;
    let zeros = ["0.0"; 9].join(",");
    format!(
        "{stamp},imu_link,0.0,0.0,0.0,1.0,-1.0,{},{},{zeros},{},{zeros}",
        ["0.0"; 8].join(","),
        three(w),
        three(f)
    )
}

pub(super) fn layouts(s: &Samples) -> Vec<Layout> {
    let degrees = 180.0 / std::f64::consts::PI;
    let kalibr = table(
        s,
        "timestamp,omega_x,omega_y,omega_z,alpha_x,alpha_y,alpha_z\n",
        |t, f, w| format!("{},{},{}", nanoseconds(t), three(w), three(f)),
    );
    let euroc = table(
        s,
        "#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],a_RS_S_x [m s^-2],a_RS_S_y [m s^-2],a_RS_S_z [m s^-2]\n",
        |t, f, w| format!("{},{},{}", nanoseconds(t), three(w), three(f)),
    );
    let covariance = |name: &str| {
        (0..9)
            .map(|k| format!("field.{name}_covariance{k}"))
            .collect::<Vec<_>>()
            .join(",")
    };
    let axes = |name: &str| {
        ["x", "y", "z"]
            .map(|axis| format!("field.{name}.{axis}"))
            .join(",")
    };
    let header = format!(
        "%time,field.header.seq,field.header.stamp,field.header.frame_id,{},field.orientation.w,{},{},{},{},{}\n",
        axes("orientation"),
        covariance("orientation"),
        axes("angular_velocity"),
        covariance("angular_velocity"),
        axes("linear_acceleration"),
        covariance("linear_acceleration")
    );
    let rostopic = table(s, &header, |t, f, w| {
        format!(
            "{},7,{}",
            nanoseconds(t) + 300_000,
            imu(t, &nanoseconds(t).to_string(), f, w)
        )
    });
    let ros2 = table(s, "", |t, f, w| {
        let stamp = nanoseconds(t);
        imu(
            t,
            &format!("{},{}", stamp / 1_000_000_000, stamp % 1_000_000_000),
            f,
            w,
        )
    });
    let mti = table(
        s,
        "// General information\n//  MT Manager version: 2022.0\n// Update Rate: 100.0Hz\nPacketCounter\tSampleTimeFine\tAcc_X\tAcc_Y\tAcc_Z\tFreeAcc_X\tFreeAcc_Y\tFreeAcc_Z\tGyr_X\tGyr_Y\tGyr_Z\n",
        |t, f, w| {
            format!(
                "1,{},{},0.1,0.1,0.1,{}",
                (t * 1e4).round() + 5e5,
                three(f),
                three(w)
            )
            .replace(',', "\t")
        },
    );
    let dot = table(
        s,
        "sep=,\nPacketCounter,SampleTimeFine,Acc_X,Acc_Y,Acc_Z,Gyr_X,Gyr_Y,Gyr_Z\n",
        |t, f, w| {
            let micros = ((t * 1e6).round() as u64 + (1 << 32) - 20_000_000) % (1 << 32);
            format!("1,{micros},{},{}", three(f), three(&(w * degrees)))
        },
    );
    let shimmer = table(
        s,
        "sep=,\nShimmer_5E6F_Timestamp_Unix_CAL,Shimmer_5E6F_Accel_LN_X_CAL,Shimmer_5E6F_Accel_LN_Y_CAL,Shimmer_5E6F_Accel_LN_Z_CAL,Shimmer_5E6F_Gyro_X_CAL,Shimmer_5E6F_Gyro_Y_CAL,Shimmer_5E6F_Gyro_Z_CAL\nms,m/(s^2),m/(s^2),m/(s^2),deg/s,deg/s,deg/s\n",
        |t, f, w| {
            format!(
                "{:.3},{},{}",
                EPOCH as f64 * 1e3 + t * 1e3,
                three(f),
                three(&(w * degrees))
            )
        },
    );
    let xio = table(
        s,
        "Time (s),Gyroscope X (deg/s),Gyroscope Y (deg/s),Gyroscope Z (deg/s),Accelerometer X (g),Accelerometer Y (g),Accelerometer Z (g)\n",
        |t, f, w| format!("{t:.6},{},{}", three(&(w * degrees)), three(&(f / G))),
    );
    let vectornav = table(s, "", |_, f, w| {
        format!(
            "$VNIMU,+01.0,-00.9,+02.1,{},{},+27.1,+101.3*4F",
            three(f),
            three(w)
        )
    });
    let mut get_sensor_data = String::from(
        "% LogFile created by the 'GetSensorData' App\n% ACCE;AppTimestamp(s);SensorTimestamp(s);Acc_X(m/s^2);Acc_Y;Acc_Z;Accuracy(integer)\n",
    );
    let mut gnss = String::from(
        "# Header\n# UncalAccel,utcTimeMillis,elapsedRealtimeNanos,UncalAccelXMps2,UncalAccelYMps2,UncalAccelZMps2,BiasXMps2,BiasYMps2,BiasZMps2\n",
    );
    for k in 0..s.accel.t.len() {
        for (tag, long, stream) in [
            ("ACCE", "UncalAccel", &s.accel),
            ("GYRO", "UncalGyro", &s.gyro),
        ] {
            let (t, v) = (stream.t[k], three(&stream.values[k]));
            let _ = writeln!(
                get_sensor_data,
                "{tag};{:.3};{:.6};{};3",
                t + 0.01,
                t + 20.0,
                v.replace(',', ";")
            );
            let _ = writeln!(
                gnss,
                "{long},1700000000000,{},{v},0.0,0.0,0.0",
                nanoseconds(t) - EPOCH * 1_000_000_000 + 77
            );
        }
    }
    let px4 = table(
        s,
        "timestamp,gyro_rad[0],gyro_rad[1],gyro_rad[2],gyro_integral_dt,accelerometer_timestamp_relative,accelerometer_m_s2[0],accelerometer_m_s2[1],accelerometer_m_s2[2],accelerometer_integral_dt\n",
        |t, f, w| {
            format!(
                "{},{},5000,0,{},5000",
                (t * 1e6).round() + 2e7,
                three(w),
                three(f)
            )
        },
    );
    let whole = |values: Vector3<f64>, scale: f64| {
        let [x, y, z]: [f64; 3] = (values / scale).into();
        format!("{x:.0},{y:.0},{z:.0}")
    };
    let gyroflow = table(
        s,
        "GYROFLOW IMU LOG\nversion,1.3\nid,test\ntscale,0.000001\ngscale,0.0001\nascale,0.0001\nt,gx,gy,gz,ax,ay,az\n",
        |t, f, w| {
            let (rate, force) = (whole(*w, 1e-4), whole(f / G, 1e-4));
            format!("{},{rate},{force}", (t * 1e6).round())
        },
    );
    let mut gyroflow = Layout::text("Gyroflow", "log.gcsv", gyroflow).one_clock();
    gyroflow.within = [1e-6, 6e-4, 6e-5];
    let one = |name, text| Layout::text(name, "imu.csv", text).one_clock();
    let mut vectornav = one("VectorNav", vectornav);
    vectornav.call.extend(["--rate", "100"]);
    vec![
        one("Kalibr", kalibr),
        one("EuRoC", euroc),
        one("rostopic echo -p", rostopic),
        one("ros2 topic echo --csv", ros2),
        one("Xsens MTi", mti),
        one("Xsens DOT", dot),
        one("Shimmer", shimmer),
        one("x-io", xio),
        gyroflow,
        vectornav,
        Layout::text("GetSensorData", "imu.csv", get_sensor_data),
        Layout::text("GnssLogger", "imu.csv", gnss),
        one("PX4 sensor_combined as CSV", px4),
    ]
}
