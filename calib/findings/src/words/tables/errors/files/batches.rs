//! Words of errors: batches of devices.

use crate::remedy::Remedy;
use crate::words::entry::{error, error_by, error_with};

kinds! {
    /// A manifest cannot be understood from a line on.
    MANIFEST_DAMAGED = "manifest_damaged" => error(
        "this line of the manifest cannot be read: {reason}",
        "correct the line",
    ),
    /// A cell of a manifest holds something else.
    CELL_UNEXPECTED = "cell_unexpected" => error(
        "{column}: {found} found, {expected} expected",
        "correct the cell",
    ),
    /// A manifest has a column that is not known.
    COLUMN_UNKNOWN = "column_unknown" => error(
        "unknown column `{column}`",
        "did you mean `{nearest}`? ({known} are known)",
    ),
    /// A device of a manifest has no inputs.
    INPUTS_MISSING = "inputs_missing" => error(
        "inputs: none are named for this device",
        "name the recordings of the device, separated by `;`",
    ),
    /// Two devices have one name.
    DEVICE_TWICE = "device_twice" => error(
        "two devices have the same id, {device}",
        "name the devices in a manifest (table of devices), each with an id of its own",
    ),
    /// No device is in a folder or manifest.
    NO_DEVICE = "no_device" => error(
        "the program found no device in it",
        "name a folder with a folder or a file for each device, or a manifest (table of devices)",
    ),
    /// A manifest names a method that is not known.
    DEVICE_METHOD = "device_method" => error(
        "the manifest gives method `{method}`: auto, stepwise or joint expected",
        "correct the manifest",
    ),
    /// A manifest names an effect that is not known.
    DEVICE_EFFECT = "device_effect" => error_with(
        "the manifest (table of devices) names the source of error `{effect}`, which is not in the list of known ones",
        "correct the name",
        vec![Remedy::ListEffects],
    ),
    /// A manifest names a unit that is not known.
    DEVICE_UNIT = "device_unit" => error(
        "the manifest (table of devices) gives {column} `{unit}`, which is no unit that the program knows",
        "write a known unit, as m/s^2, g, rad/s, deg/s, uT or counts",
    ),
    /// Folders of a device are too deep.
    FOLDERS_TOO_DEEP = "folders_too_deep" => error(
        "more than {limit} folders lie within each other",
        "name the folder that holds the recording, and remove links that lead in a circle",
    ),
    /// An input is neither a file nor a folder.
    NO_FILE_OR_FOLDER = "no_file_or_folder" => error(
        "this input is neither a file nor a folder",
        "name a file or folder",
    ),
    /// A file is no part of a batch.
    NO_BATCH_PART = "no_batch_part" => error_with(
        "this file holds no results of a batch: it is another file, or a damaged part",
        "leave it out of the call if it is another file",
        vec![Remedy::RunShard { shard: None }],
    ),
    /// A part of a batch has no end.
    PART_INCOMPLETE = "part_incomplete" => error_by(
        "this part of the batch is incomplete: its last line is missing, so the run that wrote it was stopped",
        vec![Remedy::RunShard { shard: None }],
    ),
    /// A part of a batch has another hash.
    PART_CHANGED = "part_changed" => error_by(
        "this part of the batch is damaged: its content is not what was written (its hash is another)",
        vec![Remedy::RunShard { shard: None }],
    ),
    /// A part of a batch is of another version.
    PART_OF_OTHER_VERSION = "part_of_other_version" => error_by(
        "this part of the batch was written by another version of the program: {reason}",
        vec![Remedy::RunShard { shard: None }],
    ),
    /// A part is of another run.
    PART_FOREIGN = "part_foreign" => error(
        "this part is of another run of the batch than the others. It is of run {found} ({devices:device} in {shards:part}, by {program}), the others of run {expected} ({expected_devices:device} in {expected_shards:part}, by {expected_program})",
        "name only the parts of one run",
    ),
    /// A part of a batch is missing.
    BATCH_PART_MISSING = "batch_part_missing" => error_by(
        "part {part} of the batch is missing",
        vec![Remedy::RunShard { shard: None }],
    ),
    /// A device is in no part of a batch.
    DEVICE_IN_NO_PART = "device_in_no_part" => error(
        "device {index} of the manifest is in no part of the batch",
        "run the batch again",
    ),
    /// The parts of a batch make no whole.
    PARTS_INCOMPLETE = "parts_incomplete" => error(
        "the program cannot put the parts of the batch together",
        "name all parts of one run, and run those again that are missing or damaged",
    ),
    /// There are no parts of a batch.
    NO_PARTS = "no_parts" => error(
        "no part of a batch is in what was named",
        "name its output folder or its part files",
    ),
    /// Too few devices have the parameters in common.
    DEVICES_TOO_FEW = "devices_too_few" => error(
        "the batch has {found:device}, too few to learn the typical values of a type: for {parameters:parameter} at least {needed} devices are needed",
        "calibrate more devices of the type",
    ),
    /// A part of the work is misspelt.
    SHARD_WRONG = "shard_wrong" => error(
        "the part of the batch is given as `{text}`: K/N with K from 1 to N expected, as 3/8",
        "give it as 3/8",
    ),
    /// No thread can be started.
    NO_THREAD = "no_thread" => error(
        "the system lets the program start no thread: {reason}",
        "close other programs and run it again",
    ),
    /// The program has a bug.
    BUG_OF_OURS = "bug_of_ours" => error(
        "the program failed at this device by a bug of ours: {reason}",
        "report this to the makers of the program",
    ),
    /// A device took longer than it may.
    OVER_BUDGET = "over_budget" => error(
        "the program gave up this device after {seconds}, the longest time that a device may take (its budget)",
        "run the batch again with a larger budget, or shorten the recording",
    ),
}
