//! Literals of Python, as the header of an array is one.

/// A value.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Literal {
    Text(String),
    Number(u64),
    Truth(bool),
    /// A list or a tuple.
    List(Vec<Literal>),
    /// Keys and values in turn.
    Table(Vec<Literal>),
}

/// Lists within lists that are read.
const DEPTH: usize = 8;

impl Literal {
    /// The value that a text is.
    pub fn of(text: &str) -> Option<Self> {
        let mut rest = text.trim();
        let value = value(&mut rest, 0)?;
        rest.trim().is_empty().then_some(value)
    }

    /// The value of a key.
    pub fn get(&self, key: &str) -> Option<&Self> {
        let Self::Table(all) = self else { return None };
        let mut pairs = all.chunks_exact(2);
        let pair = pairs.find(|pair| pair[0] == Self::Text(key.to_owned()))?;
        Some(&pair[1])
    }

    /// The words that it is.
    pub fn text(&self) -> Option<&str> {
        match self {
            Self::Text(text) => Some(text),
            _ => None,
        }
    }

    /// The numbers of a list of nothing else.
    pub fn numbers(&self) -> Option<Vec<u64>> {
        let Self::List(all) = self else { return None };
        let number = |value: &Self| match value {
            Self::Number(number) => Some(*number),
            _ => None,
        };
        all.iter().map(number).collect()
    }
}

fn value(rest: &mut &str, depth: usize) -> Option<Literal> {
    *rest = rest.trim_start();
    let first = rest.chars().next()?;
    match first {
        '\'' | '"' => {
            let (text, after) = rest[1..].split_once(first)?;
            *rest = after;
            Some(Literal::Text(text.to_owned()))
        }
        '(' => list(rest, ')', depth).map(Literal::List),
        '[' => list(rest, ']', depth).map(Literal::List),
        '{' => list(rest, '}', depth)
            .filter(|all| all.len().is_multiple_of(2))
            .map(Literal::Table),
        _ => {
            let end = rest.find(|c: char| !c.is_ascii_alphanumeric());
            let (word, after) = rest.split_at(end.unwrap_or(rest.len()));
            *rest = after;
            match word {
                "True" => Some(Literal::Truth(true)),
                "False" => Some(Literal::Truth(false)),
                // Python 2 wrote `20L`.
                number => number
                    .trim_end_matches('L')
                    .parse()
                    .ok()
                    .map(Literal::Number),
            }
        }
    }
}

fn list(rest: &mut &str, end: char, depth: usize) -> Option<Vec<Literal>> {
    *rest = &rest[1..];
    let mut all = Vec::new();
    loop {
        *rest = rest.trim_start_matches(|c: char| c.is_whitespace() || matches!(c, ',' | ':'));
        if let Some(after) = rest.strip_prefix(end) {
            *rest = after;
            return Some(all);
        }
        if depth == DEPTH {
            return None;
        }
        all.push(value(rest, depth + 1)?);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headers_are_values_by_key() {
        let header = "{'descr': [('t', '<f8'), ('acc', '<f4', (3,))], 'fortran_order': False, 'shape': (9520L,), }\n";
        let header = Literal::of(header).unwrap();
        assert_eq!(
            header.get("shape").and_then(Literal::numbers),
            Some(vec![9520])
        );
        assert_eq!(header.get("fortran_order"), Some(&Literal::Truth(false)));
        let Some(Literal::List(fields)) = header.get("descr") else {
            panic!()
        };
        assert_eq!(fields.len(), 2);
        for text in [
            "",
            "{",
            "{'a': }",
            "{'a': 1} 2",
            "é",
            "[[[[[[[[[[[[1]]]]]]]]]]]]",
        ] {
            assert_eq!(Literal::of(text), None, "{text}");
        }
    }
}
