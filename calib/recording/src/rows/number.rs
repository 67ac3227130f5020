//! One cell to one number.

use std::borrow::Cow;

use findings::Kind;

findings::tuning! {
    /// Readings from here on are absurd, whatever the sensor and its unit.
    pub(crate) LARGEST: f64 = 1e15;

    /// Stamps from here on are of no clock: nanoseconds since 1970 have 19 digits.
    pub(crate) LATEST: f64 = 1e19;
}

/// Why a cell is no usable number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fault {
    /// Empty, or a word for "no value": `NULL`, `--`, `n/a`.
    Missing,
    /// `NaN`, `Inf`, or beyond the range of a double.
    NotFinite,
    /// `1.234,5` or `1,234.5`.
    Thousands,
    /// A comma where a point was expected.
    DecimalComma,
    /// `0x1p3`.
    Hexadecimal,
    /// Too large for any sensor or clock in any unit.
    Absurd,
    /// A date that is not ISO 8601.
    Date,
    /// A date that is not of the pattern that was given.
    OtherDate,
    /// A date a month behind the one before it, and a day by the other order of day and month.
    OtherOrder,
    /// Anything else.
    Text,
}

impl Fault {
    /// The finding of a cell that has it.
    pub fn kind(self) -> Kind {
        match self {
            Self::Missing => Kind::NUMBER_MISSING,
            Self::NotFinite => Kind::NUMBER_NOT_FINITE,
            Self::Thousands => Kind::THOUSANDS_SEPARATORS,
            Self::DecimalComma => Kind::DECIMAL_COMMA,
            Self::Hexadecimal => Kind::HEXADECIMAL,
            Self::Absurd => Kind::NUMBER_ABSURD,
            Self::Date => Kind::DATE_UNKNOWN,
            Self::OtherDate => Kind::DATE_OTHER,
            Self::OtherOrder => Kind::DATE_OTHER_ORDER,
            Self::Text => Kind::NOT_A_NUMBER,
        }
    }
}

/// Spellings that were understood but are not plain numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Dialects {
    /// `1D-3`.
    pub fortran: bool,
    /// `−1` with U+2212.
    pub unicode_minus: bool,
}

/// The number in `cell`.
pub(crate) fn parse(cell: &[u8], decimal_comma: bool, seen: &mut Dialects) -> Result<f64, Fault> {
    if !decimal_comma && let Ok(value) = fast_float2::parse::<f64, _>(cell) {
        return if value.is_finite() {
            Ok(value)
        } else {
            Err(Fault::NotFinite)
        };
    }
    parse_slowly(cell, decimal_comma, seen)
}

#[cold]
fn respell<'a>(cell: &'a str, seen: &mut Dialects) -> Cow<'a, str> {
    let mut text = Cow::Borrowed(cell);
    if text.contains('\u{2212}') {
        seen.unicode_minus = true;
        text = text.replace('\u{2212}', "-").into();
    }
    let digits_around_d = text
        .split_once(['D', 'd'])
        .is_some_and(|(mantissa, exponent)| {
            mantissa.ends_with(|c: char| c.is_ascii_digit() || c == '.')
                && exponent
                    .trim_start_matches(['+', '-'])
                    .starts_with(|c: char| c.is_ascii_digit())
        });
    if digits_around_d {
        seen.fortran = true;
        text = text.replace(['D', 'd'], "e").into();
    }
    text
}

fn parse_slowly(cell: &[u8], decimal_comma: bool, seen: &mut Dialects) -> Result<f64, Fault> {
    let text = std::str::from_utf8(cell).map_err(|_| Fault::Text)?;
    let mut before = *seen;
    let mut text = respell(text, &mut before);
    if decimal_comma && text.contains(',') {
        if text.contains('.') {
            return Err(fault(&text));
        }
        text = text.replacen(',', ".", 1).into();
    }
    match fast_float2::parse::<f64, _>(text.as_bytes()) {
        Ok(value) if value.is_finite() => {
            *seen = before;
            Ok(value)
        }
        Ok(_) => Err(Fault::NotFinite),
        Err(_) => Err(fault(&text)),
    }
}

/// Names what is in a cell that is no number.
fn fault(text: &str) -> Fault {
    let lower = text.to_ascii_lowercase();
    let bare = lower.trim_start_matches(['+', '-']);
    match lower.as_str() {
        "" | "-" | "--" | "---" | "na" | "n/a" | "#n/a" | "nil" | "null" | "none" | "missing" => {
            return Fault::Missing;
        }
        _ => {}
    }
    if bare.starts_with("nan") || bare.starts_with("1.#") || bare == "-nan(ind)" {
        return Fault::NotFinite;
    }
    if bare.starts_with("0x") {
        return Fault::Hexadecimal;
    }
    let numeric = |c: char| c.is_ascii_digit() || matches!(c, '.' | ',');
    if !bare.is_empty() && bare.chars().all(numeric) {
        let (points, commas) = (bare.matches('.').count(), bare.matches(',').count());
        return match (points, commas) {
            (0, 1) => Fault::DecimalComma,
            (1.., 1..) => Fault::Thousands,
            (2.., 0) | (0, 2..) if are_groups(bare) => Fault::Thousands,
            _ => Fault::Text,
        };
    }
    Fault::Text
}

/// True if three digits follow every mark: `1.234.567`.
fn are_groups(digits: &str) -> bool {
    let mut groups = digits.split(['.', ',']).skip(1);
    groups.all(|group| group.len() == 3)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(cell: &str) -> Result<f64, Fault> {
        parse(cell.as_bytes(), false, &mut Dialects::default())
    }

    #[test]
    fn spellings_of_one_thousandth_are_one_number() {
        for cell in ["0.001", "1e-3", "1E-3", "+1e-3", "1D-3", "1d-03", ".001"] {
            assert_eq!(number(cell), Ok(0.001), "{cell}");
        }
        let mut seen = Dialects::default();
        assert_eq!(parse("\u{2212}0,5".as_bytes(), true, &mut seen), Ok(-0.5));
        assert!(seen.unicode_minus && !seen.fortran);
    }

    #[test]
    fn what_is_no_number_is_named() {
        let cases = [
            ("", Fault::Missing),
            ("--", Fault::Missing),
            ("NULL", Fault::Missing),
            ("nan", Fault::NotFinite),
            ("-Inf", Fault::NotFinite),
            ("1e400", Fault::NotFinite),
            ("1,234.5", Fault::Thousands),
            ("1.234.567", Fault::Thousands),
            ("1.2.3", Fault::Text),
            ("1,5", Fault::DecimalComma),
            ("0x1p3", Fault::Hexadecimal),
            ("1e5m", Fault::Text),
            ("dead", Fault::Text),
        ];
        for (cell, fault) in cases {
            assert_eq!(number(cell), Err(fault), "{cell}");
        }
    }
}
