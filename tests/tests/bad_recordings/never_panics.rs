//! Whatever the bytes: no panic, time increases, samples are finite.

use calib::recording::Stream;
use proptest::prelude::*;

use super::*;

fn is_sound(stream: &Option<Stream>) -> bool {
    stream.as_ref().is_none_or(|s| {
        s.t.len() == s.values.len()
            && s.t.windows(2).all(|w| w[0] < w[1])
            && s.t.iter().all(|t| t.is_finite())
            && s.values
                .iter()
                .flat_map(|v| v.iter())
                .all(|v| v.is_finite())
    })
}

fn check(content: &[u8], options: &ReadOptions) -> Result<(), TestCaseError> {
    if let Ok(recording) = read(content, options) {
        prop_assert!(is_sound(&recording.accelerometer) && is_sound(&recording.gyroscope));
        let temperature = recording.temperature.unwrap_or_default();
        prop_assert!(temperature.t.windows(2).all(|w| w[0] < w[1]));
        prop_assert!(temperature.celsius.iter().all(|c| c.is_finite()));
    }
    Ok(())
}

fn options() -> impl Strategy<Value = ReadOptions> {
    (any::<[bool; 3]>(), 0usize..5).prop_map(|([na_drop, sort_time, rate], skip_bad_rows)| {
        let rate = rate.then_some(100.0);
        ReadOptions {
            na_drop,
            sort_time,
            rate,
            skip_bad_rows,
            ..ReadOptions::default()
        }
    })
}

/// Pieces that recordings are made of, and some they are not.
fn piece() -> impl Strategy<Value = Vec<u8>> {
    let known = prop::sample::select(vec![
        ",",
        ";",
        "\t",
        " ",
        "\n",
        "\r",
        "\r\n",
        "\"",
        "#",
        "-",
        "e",
        "D",
        "nan",
        "inf",
        "1e400",
        "1e300",
        "1e-320",
        "9223372036854775807",
        "-9223372036854775808",
        "1700000000000000000",
        "t,ax,ay,az\n",
        "t,gx,gy,gz\n",
        "temp",
        "\u{2212}",
        "\u{feff}",
        "0x1",
        "2026-11-21T03:04:05Z",
        "65535",
        "1,2,3,4\n",
        "0.5,1,2,9.8\n",
        "9999-12-31T23:59:59",
        "(g)",
        "[ns]",
        "%",
        "//",
    ]);
    prop_oneof![
        4 => known.prop_map(|s| s.as_bytes().to_vec()),
        1 => any::<[u8; 2]>().prop_map(Vec::from),
        2 => any::<f64>().prop_map(|x| x.to_string().into_bytes()),
        2 => (-99i32..99).prop_map(|x| x.to_string().into_bytes()),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_bytes_are_read_soundly_or_refused(
        bytes in prop::collection::vec(any::<u8>(), 0..400),
        options in options(),
    ) {
        check(&bytes, &options)?;
    }

    #[test]
    fn any_text_is_read_soundly_or_refused(
        pieces in prop::collection::vec(piece(), 0..120),
        options in options(),
    ) {
        check(&pieces.concat(), &options)?;
    }

    #[test]
    fn any_damage_to_a_good_file_is_read_soundly_or_refused(
        damage in prop::collection::vec((any::<prop::sample::Index>(), 0usize..12, piece()), 1..6),
        options in options(),
    ) {
        let mut bytes = file(HEADER, &rows(150)).into_bytes();
        for (at, length, piece) in damage {
            let at = at.index(bytes.len());
            let end = (at + length).min(bytes.len());
            bytes.splice(at..end, piece);
        }
        check(&bytes, &options)?;
    }
}
