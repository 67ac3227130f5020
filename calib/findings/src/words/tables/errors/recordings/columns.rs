//! Words of columns that are missing, or not understood.

use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{error, error_by, error_with};

kinds! {
    /// A sensor lacks columns.
    COLUMN_MISSING = "column_missing" => error("the table has no column for {missing}", "export it too"),
    /// The columns of a magnetometer in a file of its own are not known.
    FIELD_COLUMNS_UNKNOWN = "field_columns_unknown" => error(
        "the program cannot tell which columns of {file} are those of the magnetometer",
        "call them t, mx, my and mz",
    ),
    /// No columns are a sensor's.
    NO_SENSOR_COLUMNS = "no_sensor_columns" => error_with(
        "the program recognises no columns of an accelerometer or a gyroscope among {columns}",
        "name the columns t,ax,ay,az,gx,gy,gz (and temp for a temperature)",
        vec![Remedy::such_as(
            OptionName::Columns,
            "t=1,ax=2,ay=3,az=4,gx=5,gy=6,gz=7",
        )],
    ),
    /// Two columns have one role.
    COLUMNS_ALIKE = "columns_alike" => error_by(
        "the program cannot tell which column is {role}: column {first} (`{first_name}`) or column {second} (`{second_name}`)",
        vec![Remedy::such_as(OptionName::Columns, "ax=2")],
    ),
    /// One column was given for two roles.
    COLUMN_FOR_TWO = "column_for_two" => error(
        "{given}: column {column} for both {first} and {second}",
        "give each a column of its own",
    ),
    /// A column that was given is not there.
    NO_SUCH_COLUMN = "no_such_column" => error(
        "{role}={wanted}: no such column among {count}[; nearest: `{nearest}`]",
        "name a column that is there, by its name or its number",
    ),
    /// No sensor is known by name, and columns may be one.
    COLUMNS_UNCLEAR = "columns_unclear" => error_by(
        "the program cannot tell from the names of the columns which are the accelerometer's and which the gyroscope's. The columns {columns} may be theirs",
        vec![Remedy::such_as(
            OptionName::Columns,
            "t=1,ax=2,ay=3,az=4,gx=5,gy=6,gz=7",
        )],
    ),
    /// One sensor is not known by name, and columns may be it.
    SENSOR_UNCLEAR = "sensor_unclear" => error_by(
        "the names of the columns tell no {sensor}, but the columns {columns} change and are not used. If they hold the {sensor}, name them. If they do not, only one sensor was recorded",
        vec![Remedy::OneSensor],
    ),
    /// A table holds a sensor twice.
    SENSOR_TWICE = "sensor_twice" => error_by(
        "the table has the columns of more than one {sensor}, and the program cannot tell which are meant. The further ones are {columns}",
        vec![Remedy::such_as(OptionName::Columns, "ax=2,ay=3,az=4")],
    ),
    /// The only accelerometer of a table lacks gravity.
    COLUMNS_WITHOUT_GRAVITY = "columns_without_gravity" => error_with(
        "the columns {columns} are acceleration without gravity, and calibration needs it",
        "record the accelerometer with gravity (\"total\", \"raw\", \"uncalibrated\" or \"with g\")",
        vec![Remedy::OneSensor],
    ),
    /// A row of units holds an unknown one.
    UNIT_ROW_UNKNOWN = "unit_row_unknown" => error(
        "a row of units under the header: `{cell}` in {column}: unknown unit; known: {known}",
        "correct or delete this row",
    ),
    /// A row of units contradicts the header or itself.
    UNIT_ROW_CONTRADICTS = "unit_row_contradicts" => error(
        "a row of units under the header: `{cell}` in {column}: not the unit that the header or another axis has",
        "correct or delete this row",
    ),
    /// A comma is separator and decimal mark.
    COMMA_TWICE = "comma_twice" => error(
        "the header has {names} names but the rows {width} cells: a comma is both separator and decimal mark, which cannot be undone",
        "export with points or with semicolons",
    ),
    /// The header has another width than the rows.
    HEADER_WIDTH = "header_width" => error_with(
        "the header has {names:name} and the rows have {width:cell}, so that the program cannot tell which name is of which cell",
        "correct the header (perhaps two names lack a separator)",
        vec![Remedy::such_as(
            OptionName::Columns,
            "t=1,ax=2,ay=3,az=4,gx=5,gy=6,gz=7",
        )],
    ),
    /// Columns have no names, and gravity does not tell them.
    NO_HEADER = "no_header" => error_with(
        "the table has {width:column} without a header (a row of names), and the readings do not show which columns are which",
        "write the names above the rows, as in t,ax,ay,az,gx,gy,gz",
        vec![Remedy::such_as(
            OptionName::Columns,
            "t=1,ax=2,ay=3,az=4,gx=5,gy=6,gz=7",
        )],
    ),
    /// Columns have no names, and rest as those of a gyroscope.
    NO_HEADER_NO_FORCE = "no_header_no_force" => error_with(
        "the table has {width:column} without a header (a row of names). None shows gravity: all read the same at rest in every orientation, as a gyroscope does",
        "record the accelerometer too, whose readings at rest have the length of gravity",
        vec![Remedy::such_as(
            OptionName::Columns,
            "t=1,ax=2,ay=3,az=4,gx=5,gy=6,gz=7",
        )],
    ),
    /// Columns have no names, and one may be a temperature.
    NO_HEADER_SLOW = "no_header_slow" => error_by(
        "the table has {width:column} without a header (a row of names). Column {slow} hardly changes beside the others, so it may be a temperature",
        vec![Remedy::such_as(
            OptionName::Columns,
            "t=1,ax=2,ay=3,az=4,gx=5,gy=6,gz=7,temp=8",
        )],
    ),
    /// Columns have no names, and nothing tells them apart.
    NO_HEADER_UNDECIDED = "no_header_undecided" => error_with(
        "the table has {width:column} without a header (a row of names), and the readings do not show which are the accelerometer's",
        "write the names above the rows, as in t,ax,ay,az,gx,gy,gz",
        vec![Remedy::such_as(
            OptionName::Columns,
            "t=1,ax=2,ay=3,az=4,gx=5,gy=6,gz=7",
        )],
    ),
    /// A file lacks the sensor that it was named for.
    OTHER_SENSOR = "other_sensor" => error(
        "the file has no columns {columns}; are the two files swapped?",
        "check the names of the two files",
    ),
    /// A recording has a temperature and no sensor.
    ONLY_TEMPERATURE = "only_temperature" => error(
        "the recording has no accelerometer and no gyroscope, only a temperature",
        "name a file with the sensors too",
    ),
    /// An entry is no role with its column.
    COLUMN_ENTRY = "column_entry" => error(
        "`{entry}` is not of the form ROLE=COLUMN, such as ax=acc_x",
        "write it like this",
    ),
    /// A role does not exist.
    COLUMN_ROLE = "column_role" => error(
        "`{role}` is no quantity that a column can hold; known: {known}",
        "choose one of these",
    ),
    /// A role was given twice.
    COLUMN_TWICE = "column_twice" => error("the columns name `{role}` twice", "leave one out"),
    /// A role was given without a column.
    COLUMN_UNNAMED = "column_unnamed" => error(
        "`{entry}` names no column, as ax=acc_x or ax=2 does",
        "name the column behind `=`",
    ),
    /// A table has no static means.
    NO_STATIC_MEANS = "no_static_means" => error(
        "the file has no rows of means of the readings at rest[, only a {found}]",
        "write a row with the means ax,ay,az for each placement",
    ),
    /// A table of static means has other columns.
    STATIC_MEANS_COLUMNS = "static_means_columns" => error(
        "the file of means at rest has the columns {columns}, where ax,ay,az are expected",
        "correct the names",
    ),
    /// A table of static means has more or fewer columns.
    STATIC_MEANS_WIDTH = "static_means_width" => error(
        "the file of means at rest has {width:column} without a header, and ax,ay,az are three",
        "write the names above the rows, as in ax,ay,az",
    ),
}
