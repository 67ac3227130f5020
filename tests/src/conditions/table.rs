//! The table, within 80 columns.

use calib::calibrate::Method;

use super::catalogue::{Bound, Condition};
use super::session::Record;
use super::summary::{Summary, ratio, summarise};

/// The heading of the table.
pub const HEADING: &str = "\
                  accelerometer     gyroscope         NEES  rms/  wrong  ref
                  scale misal bias  scale misal bias  /dof  CRB  silent  used";

/// A row: both methods, and what was said.
pub fn row(condition: &Condition, records: &[Record]) -> String {
    let joint = summarise(condition, records, Method::Joint);
    let stepwise = summarise(condition, records, Method::Stepwise);
    let ratio = ratio(condition, records).map_or_else(String::new, |ratio| {
        format!("; joint rms / stepwise rms {ratio:.3}")
    });
    let holds = if condition.holds {
        ""
    } else {
        " (model cannot hold)"
    };
    let wanted = match condition.bound {
        Bound::Known => "",
        Bound::Unknown => ", no bound",
    };
    format!(
        "{}: {}{holds}\n  {} sessions{wanted}{ratio}\n{}{}{}{}",
        condition.name,
        condition.about,
        joint.sessions,
        line("joint", &joint),
        words("joint", &joint),
        line("stepwise", &stepwise),
        words("stepwise", &stepwise),
    )
}

fn line(name: &str, s: &Summary) -> String {
    let [a, b, c, d, e, f] = s.coverage.map(|share| 100.0 * share);
    let crb = s
        .efficiency
        .map_or("   -".to_owned(), |e| format!("{e:4.2}"));
    let lies = format!("{}/{}/{}", s.wrong, s.silent, s.gross);
    format!(
        "  {name:<15} {a:5.1} {b:5.1} {c:5.1} {d:5.1} {e:5.1} {f:5.1} {:6.2}  {crb} {lies:>9} {:3}\n",
        s.nees, s.refused
    )
}

/// Kinds of words with the sessions that have them; `!` marks an absent cause.
pub fn words(name: &str, s: &Summary) -> String {
    let kinds: Vec<String> = s
        .kinds
        .iter()
        .map(|(kind, (count, right))| {
            format!("{}{} {count}", if *right { "" } else { "!" }, kind.name())
        })
        .collect();
    if kinds.is_empty() {
        return String::new();
    }
    let mut text = format!("    {name} says: ");
    let mut column = text.len();
    for (k, kind) in kinds.iter().enumerate() {
        if column + kind.len() + 2 > 78 {
            text.push_str("\n      ");
            column = 6;
        }
        let end = if k + 1 < kinds.len() { ", " } else { "" };
        column += kind.len() + end.len();
        text.push_str(kind);
        text.push_str(end);
    }
    format!("{text}; false alarms in {}\n", s.false_alarms)
}
