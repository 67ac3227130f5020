//! Words of errors: batches of devices.

use crate::kind::Kind;
use crate::remedy::Remedy;
use crate::words::entry::Entry;

pub(in crate::words::tables) const ENTRIES: &[Entry] = &[
    Entry::error(Kind::ManifestDamaged, "{reason}", "", Vec::new),
    Entry::error(
        Kind::CellUnexpected,
        "{column}: {found} found, {expected} expected",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::ColumnUnknown,
        "unknown column `{column}`",
        "did you mean `{nearest}`? ({known} are known)",
        Vec::new,
    ),
    Entry::error(
        Kind::InputsMissing,
        "inputs: none",
        "name the recordings of the device, separated by `;`",
        Vec::new,
    ),
    Entry::error(
        Kind::DeviceTwice,
        "the device {device} is there twice",
        "give each an id of its own in a manifest",
        Vec::new,
    ),
    Entry::error(
        Kind::NoDevice,
        "no device in it",
        "name a folder with a folder or a file for each, or a manifest",
        Vec::new,
    ),
    Entry::error(
        Kind::DeviceMethod,
        "method `{method}`: auto, stepwise or joint expected",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::DeviceEffect,
        "effect `{effect}`: not in the catalogue",
        "",
        Vec::new,
    ),
    Entry::error(Kind::DeviceUnit, "{column} `{unit}`: no unit", "", Vec::new),
    Entry::error(
        Kind::FoldersTooDeep,
        "more than {limit} folders within each other",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::NoFileOrFolder,
        "neither a file nor a folder",
        "",
        Vec::new,
    ),
    Entry::error(Kind::NoBatchPart, "no part of a batch", "", || {
        vec![Remedy::RunShard { shard: None }]
    }),
    Entry::error(
        Kind::PartIncomplete,
        "incomplete: it has no end",
        "",
        || vec![Remedy::RunShard { shard: None }],
    ),
    Entry::error(
        Kind::PartChanged,
        "damaged: its hash is another",
        "",
        || vec![Remedy::RunShard { shard: None }],
    ),
    Entry::error(
        Kind::PartOfOtherVersion,
        "of another version: {reason}",
        "",
        || vec![Remedy::RunShard { shard: None }],
    ),
    Entry::error(
        Kind::PartForeign,
        "of another run ({found}: {devices:device} in {shards:shard} by {program}; {expected}: \
         {expected_devices:device} in {expected_shards:shard} by {expected_program} expected)",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::BatchPartMissing,
        "part {part} is missing",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::DeviceInNoPart,
        "device {index} of the manifest is in no part",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::PartsIncomplete,
        "the parts make no whole",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::NoParts,
        "no part of a batch",
        "name its output folder or its part files",
        Vec::new,
    ),
    Entry::error(
        Kind::DevicesTooFew,
        "{found:device} with {parameters:parameter} in common: at least {needed} are needed",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::ShardWrong,
        "`{text}`: K/N with K from 1 to N expected, as 3/8",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::NoThread,
        "no thread can be started: {reason}",
        "",
        Vec::new,
    ),
    Entry::error(Kind::BugOfOurs, "a bug of ours: {reason}", "", Vec::new),
    Entry::error(Kind::OverBudget, "not done after {seconds}", "", Vec::new),
];
