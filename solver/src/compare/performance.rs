//! Performance profiles, as numbers and as a picture.

use std::fmt::Write;

use super::table::{Measure, Table};

/// `ρ(τ)`: the share of runs that a variant finishes at the least cost with at most `τ` times what the best
/// variant needs.
///
/// Source: Dolan and Moré, "Benchmarking optimization software with performance profiles", 2002.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// Name of the variant.
    pub variant: String,
    /// The ratios `τ ≥ 1` at which the share rises, ascending.
    pub ratios: Vec<f64>,
    /// Number of runs of the variant, successes or not.
    pub runs: usize,
}

impl Profile {
    /// `ρ(τ)`.
    pub fn share(&self, ratio: f64) -> f64 {
        let within = self.ratios.iter().filter(|r| **r <= ratio).count();
        within as f64 / self.runs.max(1) as f64
    }
}

/// Colours that are told apart without red against green: Okabe and Ito, "Color universal design", 2008.
const COLOURS: [&str; 8] = [
    "#000000", "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7f7f7f",
];

/// Size of the picture and of its frame, pixels.
const WIDTH: f64 = 760.0;
const HEIGHT: f64 = 420.0;
const LEFT: f64 = 56.0;
const TOP: f64 = 36.0;
const RIGHT: f64 = 520.0;
const BOTTOM: f64 = 370.0;

impl Table {
    /// The performance profile of every variant.
    pub fn performance(&self, measure: Measure) -> Vec<Profile> {
        let least = |problem: &str, start: usize| {
            let same = self
                .runs
                .iter()
                .filter(|run| run.problem == problem && run.start == start);
            let each = same
                .filter(|run| run.success)
                .map(|run| run.measured(measure));
            each.fold(f64::INFINITY, f64::min)
        };
        let profile = |variant: String| {
            let of = || self.runs.iter().filter(|run| run.variant == variant);
            let ratio = |run: &super::ComparedRun| {
                let least = least(&run.problem, run.start).max(f64::MIN_POSITIVE);
                (run.measured(measure) / least).max(1.0)
            };
            let mut ratios: Vec<f64> = of().filter(|run| run.success).map(ratio).collect();
            ratios.sort_by(f64::total_cmp);
            Profile {
                runs: of().count(),
                ratios,
                variant: variant.clone(),
            }
        };
        self.variants().into_iter().map(profile).collect()
    }

    /// The performance profiles as a picture (SVG), `τ` from 1 to what the slowest success takes, in powers
    /// of two.
    pub fn performance_svg(&self, measure: Measure) -> String {
        let profiles = self.performance(measure);
        let all = profiles.iter().flat_map(|p| p.ratios.iter().copied());
        let most = all.filter(|r| r.is_finite()).fold(2.0, f64::max);
        let octaves = most.log2().ceil().clamp(1.0, 20.0);
        let across = |ratio: f64| LEFT + (RIGHT - LEFT) * (ratio.log2() / octaves).min(1.0);
        let down = |share: f64| BOTTOM + (TOP - BOTTOM) * share;
        let what = match measure {
            Measure::Evaluations => "residual and Jacobian evaluations",
            Measure::Jacobians => "Jacobians",
            Measure::Seconds => "time",
        };
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{HEIGHT}\" \
             viewBox=\"0 0 {WIDTH} {HEIGHT}\" font-family=\"sans-serif\" font-size=\"12\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n\
             <text x=\"{LEFT}\" y=\"20\" font-size=\"14\">Share of runs at the least cost within τ times \
             the fewest {what}</text>\n"
        );
        grid(&mut svg, octaves as usize, &across, &down);
        for (k, profile) in profiles.iter().enumerate() {
            let colour = COLOURS[k % COLOURS.len()];
            let dash = ["", "7 4", "2 3"][k / COLOURS.len() % 3];
            let mut path = format!("M{:.1},{:.1}", across(1.0), down(profile.share(1.0)));
            for &ratio in profile.ratios.iter().filter(|r| **r > 1.0) {
                let _ = write!(
                    path,
                    "H{:.1}V{:.1}",
                    across(ratio),
                    down(profile.share(ratio))
                );
            }
            let _ = writeln!(
                svg,
                "<path d=\"{path}H{RIGHT}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\" \
                 stroke-dasharray=\"{dash}\"/>"
            );
            let y = TOP + 18.0 * k as f64 + 8.0;
            let (x, text) = (RIGHT + 14.0, RIGHT + 44.0);
            let _ = writeln!(
                svg,
                "<line x1=\"{x}\" x2=\"{}\" y1=\"{y}\" y2=\"{y}\" stroke=\"{colour}\" \
                 stroke-width=\"2\" stroke-dasharray=\"{dash}\"/>\
                 <text x=\"{text}\" y=\"{}\">{}</text>",
                x + 24.0,
                y + 4.0,
                escaped(&profile.variant)
            );
        }
        svg + "</svg>\n"
    }
}

fn grid(svg: &mut String, octaves: usize, across: &dyn Fn(f64) -> f64, down: &dyn Fn(f64) -> f64) {
    for fifth in 0..=5 {
        let share = f64::from(fifth) / 5.0;
        let y = down(share);
        let _ = writeln!(
            svg,
            "<line x1=\"{LEFT}\" x2=\"{RIGHT}\" y1=\"{y}\" y2=\"{y}\" stroke=\"#dddddd\"/>\
             <text x=\"{}\" y=\"{}\" text-anchor=\"end\">{share:.1}</text>",
            LEFT - 6.0,
            y + 4.0
        );
    }
    let every = octaves.div_ceil(8).max(1);
    for octave in (0..=octaves).step_by(every) {
        let x = across(2f64.powi(octave as i32));
        let _ = writeln!(
            svg,
            "<line x1=\"{x}\" x2=\"{x}\" y1=\"{TOP}\" y2=\"{BOTTOM}\" stroke=\"#dddddd\"/>\
             <text x=\"{x}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
            BOTTOM + 18.0,
            1u64 << octave
        );
    }
    let _ = writeln!(
        svg,
        "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">τ</text>",
        0.5 * (LEFT + RIGHT),
        BOTTOM + 38.0
    );
}

fn escaped(word: &str) -> String {
    word.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_grid_labels_shares_and_octaves_at_their_places() {
        let mut svg = String::new();
        let across = |ratio: f64| 100.0 * ratio.log2();
        grid(&mut svg, 3, &across, &|share| 1000.0 * share);
        for (share, y) in [("0.0", 4), ("0.2", 204), ("0.6", 604), ("1.0", 1004)] {
            let label = format!("y=\"{y}\" text-anchor=\"end\">{share}<");
            assert!(svg.contains(&label), "{share}: {svg}");
        }
        for (x, ratio) in [(0, 1), (100, 2), (200, 4), (300, 8)] {
            let label = format!("<text x=\"{x}\" y=\"388\" text-anchor=\"middle\">{ratio}<");
            assert!(svg.contains(&label), "{ratio}: {svg}");
        }
        // Of many octaves every second, third, … is labelled.
        let mut wide = String::new();
        grid(&mut wide, 17, &across, &|share| share);
        assert_eq!(wide.matches("text-anchor=\"middle\">").count(), 6 + 1);
    }
}
