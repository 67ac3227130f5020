//! A last row that ends within its last number, as a power loss leaves it.

/// Bytes from the decimal mark to the end of `cell`: decimals, exponent and the mark itself.
fn tail(cell: &[u8], mark: u8) -> usize {
    let at = cell.iter().position(|&byte| byte == mark);
    at.map_or(0, |at| cell.len() - at)
}

/// True if the decimals of `cell` end with a zero, which no shortest form of a number does.
fn is_padded(cell: &[u8], mark: u8) -> bool {
    let decimals = &cell[cell.len() - tail(cell, mark)..];
    let digits = decimals.iter().skip(1).take_while(|b| b.is_ascii_digit());
    digits.last() == Some(&b'0')
}

fn holds_a_number(cell: &[u8]) -> bool {
    cell.iter().any(u8::is_ascii_digit)
}

/// Bytes that every one of `cells`, of one column, has from its decimal mark on; `None` unless they are
/// written with a fixed number of decimals: all alike, and a zero at the end of one at least.
pub fn usual_tail<'a>(cells: impl Iterator<Item = &'a [u8]>, mark: u8) -> Option<usize> {
    let (mut usual, mut padded) = (None, false);
    for cell in cells.filter(|cell| holds_a_number(cell)) {
        let tail = tail(cell, mark);
        if *usual.get_or_insert(tail) != tail {
            return None;
        }
        padded |= is_padded(cell, mark);
    }
    usual.filter(|_| padded)
}

/// True if a number that ends like all others of its column would be longer than `cell`.
pub fn is_cut(cell: &[u8], mark: u8, usual: usize) -> bool {
    holds_a_number(cell) && tail(cell, mark) < usual
}

#[cfg(test)]
mod tests {
    use super::*;

    fn usual(cells: &[&str]) -> Option<usize> {
        usual_tail(cells.iter().map(|cell| cell.as_bytes()), b'.')
    }

    #[test]
    fn only_a_fixed_number_of_decimals_tells_that_some_are_missing() {
        let fixed = usual(&["9.810000", "-0.123456", "nan", ""]);
        assert_eq!(fixed, Some(7));
        assert!(is_cut(b"9.8", b'.', 7) && is_cut(b"-9", b'.', 7));
        assert!(!is_cut(b"9.800000", b'.', 7) && !is_cut(b"", b'.', 7));
        assert_eq!(usual(&["1.20e+00", "1.23e-01"]), Some(7));
        // Shortest forms and whole numbers.
        for cells in [&["9.81", "9.8"][..], &["9.81", "9.82"], &["9810", "9800"]] {
            assert_eq!(usual(cells), None, "{cells:?}");
        }
    }
}
