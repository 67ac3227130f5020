//! MAT files with a matrix for every sensor, compressed.

use std::io::Write;

use super::Rows;

fn element(kind: u32, bytes: &[u8]) -> Vec<u8> {
    let mut element = [kind, bytes.len() as u32].map(u32::to_le_bytes).concat();
    element.extend(bytes);
    element.resize(element.len().next_multiple_of(8), 0);
    element
}

/// A MAT file with matrices of the columns t (s), x, y, z.
pub fn mat(variables: &[(&str, &Rows)]) -> Vec<u8> {
    let matrices: Vec<(&str, [usize; 2], Vec<f64>)> = variables
        .iter()
        .map(|(name, rows)| {
            let mut numbers: Vec<f64> =
                rows.iter().map(|(stamp, _)| *stamp as f64 * 1e-9).collect();
            for axis in 0..3 {
                numbers.extend(rows.iter().map(|(_, value)| value[axis]));
            }
            (*name, [rows.len(), 4], numbers)
        })
        .collect();
    matrices_of(&matrices)
}

/// A MAT file with matrices of any shape: name, rows and columns, numbers column by column.
pub fn matrices_of(variables: &[(&str, [usize; 2], Vec<f64>)]) -> Vec<u8> {
    let mut file = b"MATLAB 5.0 MAT-file, for a test".to_vec();
    file.resize(124, b' ');
    file[116..124].fill(0);
    file.extend(b"\0\x01IM");
    for (name, dims, numbers) in variables {
        let dims = dims.map(|count| (count as u32).to_le_bytes()).concat();
        let bytes: Vec<u8> = numbers
            .iter()
            .flat_map(|number| number.to_le_bytes())
            .collect();
        let matrix = [
            element(6, &[6, 0, 0, 0, 0, 0, 0, 0]),
            element(5, &dims),
            element(1, name.as_bytes()),
            element(9, &bytes),
        ]
        .concat();
        let mut encoder =
            flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::default());
        // Writing to memory does not fail.
        let _ = encoder.write_all(&element(14, &matrix));
        let packed = encoder.finish().unwrap_or_default();
        file.extend([15, packed.len() as u32].map(u32::to_le_bytes).concat());
        file.extend(packed);
    }
    file
}
