//! The encoding of a text that is no UTF-8: by its mark, by its zeros, or by the words that it then holds.

use encoding_rs::{
    BIG5, EUC_JP, EUC_KR, Encoding, GBK, SHIFT_JIS, UTF_16BE, UTF_16LE, WINDOWS_1251,
};

/// Encodings of a language, the likelier first.
const BY_WORDS: [&Encoding; 6] = [GBK, SHIFT_JIS, BIG5, EUC_JP, EUC_KR, WINDOWS_1251];

/// Words of the columns of inertial sensors in those languages. Any bytes are signs of some kind; these are no accident.
const WORDS: [&str; 14] = [
    "时间",
    "加速度",
    "角速度",
    "陀螺",
    "時間",
    "時刻",
    "시간",
    "가속도",
    "각속도",
    "ускорени",
    "Ускорени",
    "угловая",
    "гироскоп",
    "время",
];

/// The encoding of the text that begins with `head`; `None` for UTF-8, and for bytes that are passed as they are.
pub(super) fn of(head: &[u8]) -> Option<&'static Encoding> {
    match head {
        [0xff, 0xfe, ..] => Some(UTF_16LE),
        [0xfe, 0xff, ..] => Some(UTF_16BE),
        head => utf16_by_zeros(head).or_else(|| by_words(head)),
    }
}

/// UTF-16 without a byte order mark: text whose every second byte is zero.
fn utf16_by_zeros(head: &[u8]) -> Option<&'static Encoding> {
    let pairs = head.len() / 2;
    let zeros = |offset: usize| {
        head.iter()
            .skip(offset)
            .step_by(2)
            .filter(|&&b| b == 0)
            .count()
    };
    let (even, odd) = (zeros(0), zeros(1));
    if pairs >= 4 && odd * 10 >= pairs * 9 && even * 10 < pairs {
        Some(UTF_16LE)
    } else if pairs >= 4 && even * 10 >= pairs * 9 && odd * 10 < pairs {
        Some(UTF_16BE)
    } else {
        None
    }
}

/// The first in which all of the whole lines are signs, and words of sensors among them.
fn by_words(head: &[u8]) -> Option<&'static Encoding> {
    let end = head.iter().rposition(|byte| *byte == b'\n');
    let lines = &head[..end.unwrap_or(head.len())];
    std::str::from_utf8(lines).err()?;
    BY_WORDS.into_iter().find(|encoding| {
        let (text, broken) = encoding.decode_without_bom_handling(lines);
        !broken && WORDS.iter().any(|word| text.contains(word))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_bytes_for_a_sign_are_known_by_the_words_that_they_are() {
        let names = "时间,加速度x(m/s2),角速度z(°/s)\n0,1,2\n";
        assert_eq!(of(&GBK.encode(names).0), Some(GBK));
        let names = "時間 (s),加速度 X (G)\n0,1\n";
        assert_eq!(of(&SHIFT_JIS.encode(names).0), Some(SHIFT_JIS));
        assert_eq!(of(&BIG5.encode(names).0), Some(BIG5));
        assert_eq!(of(&EUC_JP.encode(names).0), Some(EUC_JP));
        let names = "시간(s),가속도X,각속도X\n0,1,2\n";
        assert_eq!(of(&EUC_KR.encode(names).0), Some(EUC_KR));
        let names = "Время;Ускорение X\n0;1\n";
        assert_eq!(of(&WINDOWS_1251.encode(names).0), Some(WINDOWS_1251));
        assert_eq!(of(names.as_bytes()), None);
        // Latin-1 is left to the reader of the names.
        let names = "Temps;Acc\u{e9}l\u{e9}ration x (m/s\u{b2})\n0;1\n";
        let latin: Vec<u8> = names.chars().map(|c| c as u8).collect();
        assert_eq!(of(&latin), None);
    }
}
