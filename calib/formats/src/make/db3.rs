//! ROS 2 bags in SQLite.

use super::ImuRow;
use super::ros::{Ros, imu};

const PAGE: usize = 4096;

fn varint(mut value: u64) -> Vec<u8> {
    let mut bytes = vec![(value & 0x7f) as u8];
    value >>= 7;
    while value > 0 {
        bytes.insert(0, (value & 0x7f) as u8 | 0x80);
        value >>= 7;
    }
    bytes
}

/// A value of a record.
enum Cell<'a> {
    Null,
    Integer(i64),
    Text(&'a str),
    Blob(&'a [u8]),
}

fn cell(id: u64, values: &[Cell<'_>]) -> Vec<u8> {
    let (mut types, mut body) = (Vec::new(), Vec::new());
    for value in values {
        match value {
            Cell::Null => types.push(0),
            Cell::Integer(value) => {
                types.push(6);
                body.extend(value.to_be_bytes());
            }
            Cell::Text(text) => {
                types.extend(varint(13 + 2 * text.len() as u64));
                body.extend(text.as_bytes());
            }
            Cell::Blob(bytes) => {
                types.extend(varint(12 + 2 * bytes.len() as u64));
                body.extend(*bytes);
            }
        }
    }
    let record = [varint(types.len() as u64 + 1), types, body].concat();
    [varint(record.len() as u64), varint(id), record].concat()
}

/// A page with these cells; `start` is where its header begins.
fn page(kind: u8, cells: &[Vec<u8>], right: Option<u32>, start: usize) -> Vec<u8> {
    let mut page = vec![0; PAGE];
    let mut end = PAGE;
    let mut pointers = Vec::new();
    for cell in cells {
        end -= cell.len();
        page[end..end + cell.len()].copy_from_slice(cell);
        pointers.extend((end as u16).to_be_bytes());
    }
    let mut header = vec![kind, 0, 0];
    header.extend((cells.len() as u16).to_be_bytes());
    header.extend((end as u16).to_be_bytes());
    header.push(0);
    header.extend(right.into_iter().flat_map(u32::to_be_bytes));
    header.extend(pointers);
    page[start..start + header.len()].copy_from_slice(&header);
    page
}

/// A bag with one topic of `sensor_msgs/msg/Imu`.
pub fn db3(topic: &str, rows: &[ImuRow]) -> Vec<u8> {
    let table = |name, root| {
        cell(
            root as u64,
            &[
                Cell::Text("table"),
                Cell::Text(name),
                Cell::Text(name),
                Cell::Integer(root),
                Cell::Text(""),
            ],
        )
    };
    let mut first = page(0x0d, &[table("topics", 2), table("messages", 3)], None, 100);
    first[..16].copy_from_slice(b"SQLite format 3\0");
    first[16..18].copy_from_slice(&(PAGE as u16).to_be_bytes());
    let topics = cell(
        1,
        &[
            Cell::Null,
            Cell::Text(topic),
            Cell::Text("sensor_msgs/msg/Imu"),
            Cell::Text("cdr"),
            Cell::Text(""),
        ],
    );
    let cells: Vec<Vec<u8>> = (1..)
        .zip(rows)
        .map(|(id, row)| {
            let message = imu(Ros::Two, row, [0.0; 2]);
            cell(
                id,
                &[
                    Cell::Null,
                    Cell::Integer(1),
                    Cell::Integer(row.0),
                    Cell::Blob(&message),
                ],
            )
        })
        .collect();
    let leaves: Vec<Vec<u8>> = cells
        .chunks(10)
        .map(|cells| page(0x0d, cells, None, 0))
        .collect();
    // Interior pages of up to 300 leaves under one root.
    let groups: Vec<&[Vec<u8>]> = leaves.chunks(300).collect();
    let mut next = 4 + groups.len() as u32;
    let mut interiors = Vec::new();
    for group in &groups {
        let last = next + group.len() as u32 - 1;
        let pointers: Vec<Vec<u8>> = (next..last)
            .map(|child| [child.to_be_bytes().to_vec(), varint(1)].concat())
            .collect();
        interiors.push(page(0x05, &pointers, Some(last), 0));
        next = last + 1;
    }
    let last = 3 + groups.len() as u32;
    let pointers: Vec<Vec<u8>> = (4..last)
        .map(|child| [child.to_be_bytes().to_vec(), varint(1)].concat())
        .collect();
    let mut file = first;
    file.extend(page(0x0d, &[topics], None, 0));
    file.extend(page(0x05, &pointers, Some(last), 0));
    file.extend(interiors.concat());
    file.extend(leaves.concat());
    file
}
