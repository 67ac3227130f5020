//! A session in the terminal: a few lines that change in place; elsewhere a line for each thing said.

use indicatif::{ProgressBar, ProgressStyle};
use live::{Direction, Event, Instruction, View};

use super::words;
use crate::show;

/// Cells of the bar of placements.
const CELLS: usize = 24;
/// A face is there where a placement is within 45° of it.
const FACE: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// The terminal.
#[derive(Debug)]
pub(super) struct Screen {
    bar: ProgressBar,
}

impl Screen {
    pub(super) fn new() -> Self {
        let bar = ProgressBar::new_spinner();
        if let Ok(style) = ProgressStyle::with_template("{wide_msg}") {
            bar.set_style(style);
        }
        Self { bar }
    }

    /// A line that stays. What it quotes may hold others.
    pub(super) fn line(&self, text: &str) {
        let text = text.replace('\n', "\\n");
        self.bar.suspend(|| show::say(&text));
    }

    pub(super) fn event(&self, event: &Event) {
        if let Some(words) = words::event(event) {
            self.line(&words);
        }
    }

    /// Prints an instruction on a line of its own, if the output cannot change in place.
    pub(super) fn instruction(&self, instruction: &Instruction, view: &View) {
        if !self.bar.is_hidden() {
            return;
        }
        let [what, more] = words::instruction(instruction);
        let count = view.placements.len();
        self.line(&format!(
            "[{:6.1} s, {count} of {}] {what}{}{more}",
            view.seconds,
            view.planned,
            if more.is_empty() { "" } else { ". " }
        ));
    }

    /// The session now.
    pub(super) fn show(&self, view: &View) {
        if self.bar.is_hidden() {
            return;
        }
        let [what, more] = words::instruction(&view.instruction);
        let [accelerometer, gyroscope] = words::known(view);
        let done = view.placements.len().min(view.planned);
        let cells = done * CELLS / view.planned.max(1);
        self.bar.set_message(format!(
            "{what}\n{more}\n[{}{}] {} of {} placements; {}\naccelerometer  {accelerometer}\ngyroscope      {gyroscope}",
            "#".repeat(cells),
            "-".repeat(CELLS - cells),
            view.placements.len(),
            view.planned,
            missing(view),
        ));
        self.bar.tick();
    }

    /// Prints the final placements and standard errors.
    pub(super) fn end(&self, view: &View) {
        self.bar.finish_and_clear();
        let [accelerometer, gyroscope] = words::known(view);
        show::say(&format!(
            "{} placements in {:.0} s",
            view.placements.len(),
            view.seconds
        ));
        show::say(&format!("accelerometer  {accelerometer}"));
        show::say(&format!("gyroscope      {gyroscope}"));
    }
}

/// `missing: x up, z down`, the faces without a placement.
fn missing(view: &View) -> String {
    let there = |face: &Direction| {
        view.placements
            .iter()
            .any(|(up, _)| face.unit().dot(&nalgebra::Vector3::from(*up)) > FACE)
    };
    let faces = Direction::all().into_iter().filter(|d| d.axes() == 1);
    let missing: Vec<String> = faces
        .filter(|face| !there(face))
        .map(|face| words::axes(&face))
        .collect();
    if missing.is_empty() {
        "all faces there".to_owned()
    } else {
        format!("missing: {}", missing.join(", "))
    }
}
