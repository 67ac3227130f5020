//! Byte offsets of fields in the messages of a log.

use std::collections::HashMap;

/// Formats by name: the fields of each, in order.
#[derive(Debug, Default)]
pub(super) struct Layouts(HashMap<String, Vec<Field>>);

#[derive(Clone, Debug)]
struct Field {
    kind: String,
    count: usize,
    name: String,
}

/// Layouts within layouts.
const DEPTH: usize = 8;

impl Layouts {
    /// Takes over `name:type field;type[n] field;…`.
    pub fn add(&mut self, body: &[u8]) -> Option<()> {
        let text = std::str::from_utf8(body).ok()?;
        let (name, fields) = text.split_once(':')?;
        let field = |text: &str| {
            let (kind, name) = text.trim().split_once(' ')?;
            let (kind, count) = match kind.split_once('[') {
                Some((kind, count)) => (kind, count.trim_end_matches(']').parse().ok()?),
                None => (kind, 1),
            };
            Some(Field {
                kind: kind.to_owned(),
                count,
                name: name.to_owned(),
            })
        };
        let fields: Option<Vec<Field>> = fields
            .split(';')
            .filter(|text| !text.trim().is_empty())
            .map(field)
            .collect();
        self.0.insert(name.to_owned(), fields?);
        Some(())
    }

    /// Bytes of a value of the type `kind`; `None` for one that is not known.
    fn size(&self, kind: &str, depth: usize) -> Option<usize> {
        match kind {
            "int8_t" | "uint8_t" | "bool" | "char" => Some(1),
            "int16_t" | "uint16_t" => Some(2),
            "int32_t" | "uint32_t" | "float" => Some(4),
            "int64_t" | "uint64_t" | "double" => Some(8),
            _ if depth == DEPTH => None,
            other => {
                let fields = self.0.get(other)?.iter();
                let sizes =
                    fields.map(|field| self.size(&field.kind, depth + 1)?.checked_mul(field.count));
                sizes.sum()
            }
        }
    }

    /// Returns the byte offset of field `wanted` in messages of the format `format`; `None` if it is missing or not of type `kind`.
    pub fn offset(&self, format: &str, wanted: &str, kind: &str) -> Option<usize> {
        let mut offset: usize = 0;
        for field in self.0.get(format)? {
            if field.name == wanted {
                return (field.kind == kind).then_some(offset);
            }
            let size = self.size(&field.kind, 0)?.checked_mul(field.count)?;
            offset = offset.checked_add(size)?;
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_lie_behind_those_before_them() {
        let mut layouts = Layouts::default();
        layouts.add(b"inner:uint8_t a;float b;").unwrap();
        layouts
            .add(b"m:uint64_t timestamp;inner[2] i;float[3] v;uint8_t[4] _padding0;")
            .unwrap();
        assert_eq!(layouts.offset("m", "timestamp", "uint64_t"), Some(0));
        assert_eq!(layouts.offset("m", "v", "float"), Some(18));
        assert_eq!(layouts.offset("m", "v", "double"), None);
        layouts.add(b"loop:loop l;float x;").unwrap();
        assert_eq!(layouts.offset("loop", "x", "float"), None);
    }
}
