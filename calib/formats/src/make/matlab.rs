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
        file.extend(packed(&matrix(name, *dims, numbers)));
    }
    file
}

/// A MAT file with a structure whose fields are matrices of any shape.
pub fn structure_of(name: &str, fields: &[(&str, [usize; 2], Vec<f64>)]) -> Vec<u8> {
    const NAME: usize = 32;
    let mut names = Vec::new();
    let mut values = Vec::new();
    for (name, dims, numbers) in fields {
        names.extend(name.as_bytes());
        names.resize(names.len().next_multiple_of(NAME), 0);
        values.extend(element(14, &matrix("", *dims, numbers)));
    }
    let one = [1_u32.to_le_bytes(); 2].concat();
    let structure = [
        element(6, &[2, 0, 0, 0, 0, 0, 0, 0]),
        element(5, &one),
        element(1, name.as_bytes()),
        element(5, &(NAME as u32).to_le_bytes()),
        element(1, &names),
        values,
    ];
    let mut file = matrices_of(&[]);
    file.extend(packed(&structure.concat()));
    file
}

/// The content of a matrix element.
fn matrix(name: &str, dims: [usize; 2], numbers: &[f64]) -> Vec<u8> {
    let dims = dims.map(|count| (count as u32).to_le_bytes()).concat();
    let numbers = numbers.iter().flat_map(|number| number.to_le_bytes());
    [
        element(6, &[6, 0, 0, 0, 0, 0, 0, 0]),
        element(5, &dims),
        element(1, name.as_bytes()),
        element(9, &numbers.collect::<Vec<u8>>()),
    ]
    .concat()
}

/// A matrix element, compressed.
fn packed(matrix: &[u8]) -> Vec<u8> {
    let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::default());
    // Writing to memory does not fail.
    let _ = encoder.write_all(&element(14, matrix));
    let packed = encoder.finish().unwrap_or_default();
    let tag = [15, packed.len() as u32].map(u32::to_le_bytes).concat();
    [tag, packed].concat()
}
