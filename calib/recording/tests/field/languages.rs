//! Names in other languages and other encodings.

use encoding_rs::{EUC_JP, EUC_KR, GBK, SHIFT_JIS, WINDOWS_1251};
use findings::Front;
use stillpoint_recording::{ReadOptions, Recording};

use crate::session::{G, Session, is_it, read, read_as, session, table, xyz};

/// A table of the session in the units of the header.
fn named(header: &str, s: &Session, units: [f64; 3]) -> String {
    let [time, force, rate] = units;
    table(header, |k| {
        let (f, w) = (xyz(&s.force[k], force), xyz(&s.rate[k], rate));
        format!("{:.3},{f},{w}", s.t[k] * time)
    })
}

#[test]
fn names_in_several_languages_are_read() {
    let s = session();
    let degrees = 1f64.to_degrees();
    for (header, units) in [
        (
            "时间,加速度x(m/s²),加速度y(m/s²),加速度z(m/s²),角速度x(deg/s),角速度y(deg/s),角速度z(deg/s)",
            [1.0, 1.0, degrees],
        ),
        (
            "时间(毫秒),加速度x,加速度y,加速度z,角速度x(度/秒),角速度y(度/秒),角速度z(度/秒)",
            [1e3, 1.0, degrees],
        ),
        (
            "时间（秒）,X轴加速度（米/秒²）,Y轴加速度（米/秒²）,Z轴加速度（米/秒²）,X轴角速度（弧度/秒）,Y轴角速度（弧度/秒）,Z轴角速度（弧度/秒）",
            [1.0, 1.0, 1.0],
        ),
        (
            "时间戳(ms),加速度计x,加速度计y,加速度计z,陀螺仪x,陀螺仪y,陀螺仪z",
            [1e3, 1.0, 1.0],
        ),
        (
            "time,加速度x轴,加速度y轴,加速度z轴,角速度x轴,角速度y轴,角速度z轴",
            [1.0, 1.0, 1.0],
        ),
        (
            "Zeit,Beschleunigung X,Beschleunigung Y,Beschleunigung Z,Drehrate X,Drehrate Y,Drehrate Z",
            [1.0, 1.0, 1.0],
        ),
        (
            "Zeit (Sekunden),Beschleunigung x-Achse (g),Beschleunigung y-Achse (g),Beschleunigung z-Achse (g),Winkelgeschwindigkeit x-Achse (Grad/s),Winkelgeschwindigkeit y-Achse (Grad/s),Winkelgeschwindigkeit z-Achse (Grad/s)",
            [1.0, 1.0 / G, degrees],
        ),
        (
            "Temps (ms),Accélération X,Accélération Y,Accélération Z,Vitesse angulaire X,Vitesse angulaire Y,Vitesse angulaire Z",
            [1e3, 1.0, 1.0],
        ),
        (
            "Время (с),Ускорение X (м/с²),Ускорение Y (м/с²),Ускорение Z (м/с²),Угловая скорость X (град/с),Угловая скорость Y (град/с),Угловая скорость Z (град/с)",
            [1.0, 1.0, degrees],
        ),
        (
            "시간(s),가속도X(m/s²),가속도Y(m/s²),가속도Z(m/s²),각속도X(rad/s),각속도Y(rad/s),각속도Z(rad/s)",
            [1.0, 1.0, 1.0],
        ),
        (
            "tempo,aceleração x,aceleração y,aceleração z,velocidade angular x,velocidade angular y,velocidade angular z",
            [1.0, 1.0, 1.0],
        ),
        (
            "zaman,ivme x,ivme y,ivme z,açısal hız x,açısal hız y,açısal hız z",
            [1.0, 1.0, 1.0],
        ),
    ] {
        let text = named(header, &s, units);
        let found = read_as(&text, &ReadOptions::default());
        let found = found.unwrap_or_else(|error| panic!("{header}: {error}"));
        is_it(&found, &s, 1e-4);
    }
}

#[test]
fn names_in_other_encodings_are_those_in_utf_8() {
    let s = session();
    let degrees = 1f64.to_degrees();
    let chinese = "时间,加速度x(g),加速度y(g),加速度z(g),角速度x(°/s),角速度y(°/s),角速度z(°/s)";
    let japanese = "時間 (s),加速度 X (G),加速度 Y (G),加速度 Z (G),角速度 X (deg/s),角速度 Y (deg/s),角速度 Z (deg/s)";
    let korean =
        "시간(s),가속도X(g),가속도Y(g),가속도Z(g),각속도X(deg/s),각속도Y(deg/s),각속도Z(deg/s)";
    let russian = "Время (с),Ускорение X (g),Ускорение Y (g),Ускорение Z (g),Угловая скорость X (град/с),Угловая скорость Y (град/с),Угловая скорость Z (град/с)";
    let french = "Temps (s),Accélération x (g),Accélération y (g),Accélération z (g),Vitesse angulaire x (°/s),Vitesse angulaire y (°/s),Vitesse angulaire z (°/s)";
    let of = |header: &str| named(header, &s, [1.0, 1.0 / G, degrees]);
    let little: Vec<u8> = of(chinese)
        .encode_utf16()
        .flat_map(u16::to_le_bytes)
        .collect();
    let latin: Vec<u8> = of(french).chars().map(|c| c as u8).collect();
    for (encoding, bytes) in [
        ("GBK", GBK.encode(&of(chinese)).0.into_owned()),
        ("Shift_JIS", SHIFT_JIS.encode(&of(japanese)).0.into_owned()),
        ("EUC-JP", EUC_JP.encode(&of(japanese)).0.into_owned()),
        ("EUC-KR", EUC_KR.encode(&of(korean)).0.into_owned()),
        (
            "windows-1251",
            WINDOWS_1251.encode(&of(russian)).0.into_owned(),
        ),
        ("UTF-16LE", little),
        ("Latin-1", latin),
    ] {
        let found = Recording::from_bytes("a.csv", bytes, &ReadOptions::default());
        let found = found.unwrap_or_else(|error| panic!("{encoding}: {error}"));
        is_it(&found, &s, 1e-4);
        let said = found.warnings.iter().map(|w| w.text(Front::CommandLine));
        assert!(
            said.into_iter().any(|words| words.contains(encoding)),
            "{encoding}"
        );
    }
}

#[test]
fn acceleration_without_gravity_is_none_in_any_language() {
    let s = session();
    for name in ["线性加速度", "Lineare Beschleunigung "] {
        let header =
            format!("t,{name}x(m/s²),{name}y(m/s²),{name}z(m/s²),gx (rad/s),gy (rad/s),gz (rad/s)");
        let text = table(&header, |k| {
            format!(
                "{:.2},{},{}",
                s.t[k],
                xyz(&s.rate[k], 0.01),
                xyz(&s.rate[k], 1.0)
            )
        });
        let words = read_as(&text, &ReadOptions::default()).unwrap_err();
        let words = words.text(Front::CommandLine);
        assert!(words.contains("without gravity"), "{name}: {words}");
    }
    assert!(
        read("t,ax,ay,az\n0,0,0,9.8\n0.01,0,0,9.8\n0.02,0,0,9.81\n")
            .gyroscope
            .is_none()
    );
}
