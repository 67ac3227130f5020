//! Words of errors: batches of devices.

use crate::kind::Kind;
use crate::remedy::Remedy;
use crate::words::entry::{Entry, error, error_by, error_with};

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::ManifestDamaged => error(
            "this line of the manifest cannot be read: {reason}",
            "correct the line",
        ),
        Kind::CellUnexpected => error(
            "{column}: {found} found, {expected} expected",
            "correct the cell",
        ),
        Kind::ColumnUnknown => error(
            "unknown column `{column}`",
            "did you mean `{nearest}`? ({known} are known)",
        ),
        Kind::InputsMissing => error(
            "inputs: none are named for this device",
            "name the recordings of the device, separated by `;`",
        ),
        Kind::DeviceTwice => error(
            "two devices have the same id, {device}",
            "name the devices in a manifest (table of devices), each with an id of its own",
        ),
        Kind::NoDevice => error(
            "the program found no device in it",
            "name a folder with a folder or a file for each device, or a manifest (table of devices)",
        ),
        Kind::DeviceMethod => error(
            "the manifest gives method `{method}`: auto, stepwise or joint expected",
            "correct the manifest",
        ),
        Kind::DeviceEffect => error_with(
            "the manifest (table of devices) names the source of error `{effect}`, which is not in the list of known ones",
            "correct the name",
            vec![Remedy::ListEffects],
        ),
        Kind::DeviceUnit => error(
            "the manifest (table of devices) gives {column} `{unit}`, which is no unit that the program knows",
            "write a known unit, as m/s^2, g, rad/s, deg/s, uT or counts",
        ),
        Kind::FoldersTooDeep => error(
            "more than {limit} folders lie within each other",
            "name the folder that holds the recording, and remove links that lead in a circle",
        ),
        Kind::NoFileOrFolder => error(
            "this input is neither a file nor a folder",
            "name a file or folder",
        ),
        Kind::NoBatchPart => error_with(
            "this file holds no results of a batch: it is another file, or a damaged part",
            "leave it out of the call if it is another file",
            vec![Remedy::RunShard { shard: None }],
        ),
        Kind::PartIncomplete => error_by(
            "this part of the batch is incomplete: its last line is missing, so the run that wrote it was stopped",
            vec![Remedy::RunShard { shard: None }],
        ),
        Kind::PartChanged => error_by(
            "this part of the batch is damaged: its content is not what was written (its hash is another)",
            vec![Remedy::RunShard { shard: None }],
        ),
        Kind::PartOfOtherVersion => error_by(
            "this part of the batch was written by another version of the program: {reason}",
            vec![Remedy::RunShard { shard: None }],
        ),
        Kind::PartForeign => error(
            "this part is of another run of the batch than the others. It is of run {found} ({devices:device} in {shards:part}, by {program}), the others of run {expected} ({expected_devices:device} in {expected_shards:part}, by {expected_program})",
            "name only the parts of one run",
        ),
        Kind::BatchPartMissing => error_by(
            "part {part} of the batch is missing",
            vec![Remedy::RunShard { shard: None }],
        ),
        Kind::DeviceInNoPart => error(
            "device {index} of the manifest is in no part of the batch",
            "run the batch again",
        ),
        Kind::PartsIncomplete => error(
            "the program cannot put the parts of the batch together",
            "name all parts of one run, and run those again that are missing or damaged",
        ),
        Kind::NoParts => error(
            "no part of a batch is in what was named",
            "name its output folder or its part files",
        ),
        Kind::DevicesTooFew => error(
            "the batch has {found:device}, too few to learn the typical values of a type: for {parameters:parameter} at least {needed} devices are needed",
            "calibrate more devices of the type",
        ),
        Kind::ShardWrong => error(
            "the part of the batch is given as `{text}`: K/N with K from 1 to N expected, as 3/8",
            "give it as 3/8",
        ),
        Kind::NoThread => error(
            "the system lets the program start no thread: {reason}",
            "close other programs and run it again",
        ),
        Kind::BugOfOurs => error(
            "the program failed at this device by a bug of ours: {reason}",
            "report this to the makers of the program",
        ),
        Kind::OverBudget => error(
            "the program gave up this device after {seconds}, the longest time that a device may take (its budget)",
            "run the batch again with a larger budget, or shorten the recording",
        ),
        _ => return None,
    })
}
