//! The graph of one set of placements, at one unevenness of the field.

use findings::{Finding, Kind};
use recording::Error;
use sensor::{Model, Sensor};
use solver::{Block, Euclidean, Graph, GraphOptions, GraphReport, Products, solve_graph};

use super::factors::{FIELD, Reading, UnitDeterminant};
use super::linear::Linear;
use super::placement::{HeadingChange, Placement};
use super::start::Start;

findings::tuning! {
    /// Relative offset at which a fit ends: its cost lies the square of that above the minimum.
    TOLERANCE: f64 = 1e-6;

    /// The common scale is tied so loosely while the minimum is looked for: a tight tie is a narrow valley with a bend.
    LOOSE: f64 = 0.1;

    /// A walk of nothing still needs a width, in shares of the noise of a rest's mean.
    LEAST_WALK: f64 = 1e-3;
}

/// Measurements and model of a fit.
#[derive(Debug)]
pub struct Problem<'a> {
    pub model: &'a Model,
    pub placements: &'a [Placement],
    pub changes: &'a [HeadingChange],
    /// Number of recordings.
    pub recordings: usize,
    /// Number of parts with a bias of their own.
    pub parts: usize,
    /// Number of errors of the other sensors.
    pub errors: usize,
    /// Strength of the field where its logarithm is 0, in the unit of the readings.
    pub strength: f64,
    /// True if the strength is given, and not estimated.
    pub strength_given: bool,
    /// Density of the walk of the gyroscope's bias, rad/s/√s.
    pub walk: f64,
}

/// The blocks of a graph.
#[derive(Clone, Debug)]
pub struct Blocks {
    pub model: Block,
    pub errors: Block,
    pub fields: Vec<Block>,
    pub headings: Vec<Block>,
    /// Difference of the bias of each part but the last from that of the last.
    pub biases: Vec<Block>,
    /// Rate offsets of the placements that turns begin or end at.
    pub rates: Vec<Option<Block>>,
}

/// A graph with its blocks, and where its rows are.
pub struct Made<'a> {
    pub graph: Graph<'a>,
    pub blocks: Blocks,
}

/// A minimum.
#[derive(Clone, Debug)]
pub struct Minimum {
    pub report: GraphReport,
    pub blocks: Blocks,
    /// `ln det H` of the graph, for the restricted likelihood.
    pub log_determinant: f64,
    /// Variance of an axis of each placement's mean.
    pub variances: Vec<f64>,
}

impl<'a> Problem<'a> {
    /// Standard deviations of the placements' means where the field differs by `uneven` (per axis, standard deviation)
    /// from place to place.
    fn variances(&self, uneven: f64) -> Vec<f64> {
        let own = self.placements.iter().map(|p| p.noise * p.noise);
        own.map(|own| own + uneven * uneven).collect()
    }

    /// The graph at `start`, the common scale free to within the share `tie` where no strength is given.
    pub fn graph(&self, start: &Start, uneven: f64, tie: f64) -> Result<Made<'a>, Error> {
        let mut graph = Graph::new();
        let mut p = self.model.parameters().values().to_vec();
        let base = sensor::Base {
            t: start.t,
            bias: start.bias,
        };
        p[..sensor::BASE_PARAMETERS].copy_from_slice(&base.parameters());
        let add = |graph: &mut Graph<'a>, name: String, start: &[f64]| {
            let block = graph.add(name, Euclidean(start.len()), start);
            block.map_err(refused)
        };
        let model = add(&mut graph, "mag".into(), &p)?;
        let errors = add(&mut graph, "errors".into(), &vec![0.0; self.errors])?;
        let mut fields = Vec::new();
        for (k, inclination) in start.inclinations.iter().enumerate() {
            let field = add(&mut graph, format!("field {k}"), &[*inclination, 0.0])?;
            if self.strength_given {
                graph.hold_part(field, FIELD - 1);
            }
            fields.push(field);
        }
        if !self.strength_given {
            graph.add_factor(&[model], UnitDeterminant(tie));
        }
        graph.add_factor(&[errors], Linear::standard(self.errors));
        let biases = (1..self.parts).map(|k| add(&mut graph, format!("bias {k}"), &[0.0; 3]));
        let biases = biases.collect::<Result<Vec<_>, _>>()?;
        let mut headings = Vec::new();
        let of_each = self.placements.iter().zip(&start.headings);
        for (k, ((placement, heading), variance)) in of_each.zip(self.variances(uneven)).enumerate()
        {
            let heading = add(&mut graph, format!("heading {k}"), &[*heading])?;
            let reading = Reading::new(self.model, placement, self.strength, variance.sqrt());
            if placement.is_used {
                let own = biases.get(placement.part);
                let reading = reading.with_own_bias(own.is_some());
                let shared = [model, fields[placement.recording], heading, errors];
                let touched: Vec<Block> = shared.into_iter().chain(own.copied()).collect();
                graph.add_factor(&touched, reading);
            }
            headings.push(heading);
        }
        let mut blocks = Blocks {
            model,
            errors,
            fields,
            headings,
            biases,
            rates: vec![None; self.placements.len()],
        };
        self.turns(&mut graph, &mut blocks)?;
        Ok(Made { graph, blocks })
    }

    /// Rates at rest, their walk, and the turns between.
    fn turns(&self, graph: &mut Graph<'a>, blocks: &mut Blocks) -> Result<(), Error> {
        for change in self.changes {
            for place in [change.from, change.from + 1] {
                let (None, Some(rest)) = (blocks.rates[place], self.placements[place].rate) else {
                    continue;
                };
                let block = graph
                    .add(format!("rate {place}"), Euclidean(3), rest.mean.as_slice())
                    .map_err(refused)?;
                let weight = rest.noise.recip();
                graph.add_factor(&[block], Linear::axes(weight, &[1.0], rest.mean.into()));
                blocks.rates[place] = Some(block);
            }
            let (from, to) = (change.from, change.from + 1);
            let (Some(before), Some(after)) = (blocks.rates[from], blocks.rates[to]) else {
                continue;
            };
            graph.add_factor(&[before, after], self.walk_between(from, to));
            graph.add_factor(
                &[
                    blocks.headings[from],
                    blocks.headings[to],
                    before,
                    after,
                    blocks.errors,
                ],
                self.turn(change),
            );
        }
        Ok(())
    }

    fn walk_between(&self, from: usize, to: usize) -> Linear {
        let (before, after) = (&self.placements[from], &self.placements[to]);
        let time = 0.5 * (after.span.from + after.span.to - before.span.from - before.span.to);
        let noise = before.rate.map_or(1.0, |rest| rest.noise);
        let walk = self.walk * time.max(0.0).sqrt();
        let weight = walk.hypot(LEAST_WALK.get() * noise).recip();
        Linear::axes(weight, &[-1.0, 1.0], [0.0; 3])
    }

    /// `ψ_after − ψ_before − angle − (what moved rates and errors add)`.
    fn turn(&self, change: &HeadingChange) -> Linear {
        let weight = change.noise.recip();
        let means = [change.from, change.from + 1].map(|place| self.placements[place].rate);
        let half = change.by_rate * 0.5;
        let used: f64 = means
            .iter()
            .flatten()
            .map(|rest| half.dot(&rest.mean))
            .sum();
        let slopes = [-1.0, 1.0]
            .into_iter()
            // A larger offset is taken off the rate: the angle is smaller.
            .chain([half, half].into_iter().flat_map(|v| [v.x, v.y, v.z]))
            .chain(change.by_error.iter().map(|by| -by));
        Linear::row(
            slopes.map(|slope| slope * weight).collect(),
            (change.angle + used) * weight,
        )
    }

    /// `χ²` of the turns at a minimum.
    pub fn turns_left(&self, minimum: &Minimum) -> f64 {
        let blocks = &minimum.blocks;
        let of = |change: &HeadingChange| {
            let (from, to) = (change.from, change.from + 1);
            let rates = [blocks.rates[from], blocks.rates[to]];
            let own = [blocks.headings[from], blocks.headings[to]].map(Some);
            let all = own.into_iter().chain(rates).chain([Some(blocks.errors)]);
            let x = all.flatten().flat_map(|block| minimum.report.value(block));
            let mut out = Vec::new();
            solver::Factor::values(
                &self.turn(change),
                &x.copied().collect::<Vec<_>>(),
                &mut out,
            );
            out.iter().map(|r| r * r).sum::<f64>()
        };
        self.changes.iter().map(of).sum()
    }

    /// The minimum from `start` (or from where another graph of the same blocks ended).
    pub fn minimum(
        &self,
        start: &Start,
        uneven: f64,
        from: Option<&[f64]>,
    ) -> Result<Minimum, Error> {
        self.minimum_by(start, uneven, from, &searching())
    }

    /// The same minimum to the last digits that double precision allows; as it is where rounding is all that is left.
    pub fn polished(&self, start: &Start, uneven: f64, minimum: Minimum) -> Minimum {
        let values = Some(minimum.report.values.as_slice());
        let options = GraphOptions {
            rank: false,
            ..GraphOptions::default()
        };
        let polished = self.minimum_by(start, uneven, values, &options);
        polished.unwrap_or(minimum)
    }

    fn minimum_by(
        &self,
        start: &Start,
        uneven: f64,
        from: Option<&[f64]>,
        options: &GraphOptions,
    ) -> Result<Minimum, Error> {
        let Made { mut graph, blocks } = self.graph(start, uneven, LOOSE.get())?;
        if let Some(values) = from {
            graph.start_at(values);
        }
        let report = solve_graph(&graph, options).map_err(refused)?;
        if !report.termination.converged() {
            return Err(Error::not_enough(
                Finding::of(Kind::ATTITUDES_LEAVE_OPEN)
                    .of_sensor(Sensor::Magnetometer)
                    .detail("ending", report.termination.to_string()),
            ));
        }
        let log_determinant = Products::new(&graph, &report.values)
            .map_err(refused)?
            .log_determinant();
        Ok(Minimum {
            report,
            blocks,
            log_determinant,
            variances: self.variances(uneven),
        })
    }
}

/// The solver's refusal of a graph.
pub(super) fn refused(refusal: solver::Error) -> Error {
    let found = Finding::of(Kind::SOLVER_REFUSED).of_sensor(Sensor::Magnetometer);
    Error::not_converged(found.detail("reason", refusal.to_string()))
}

/// Every point of a search begins near its minimum: the last digits are of no use there.
fn searching() -> GraphOptions {
    GraphOptions {
        rank: false,
        last_digits: false,
        gradient_tolerance: TOLERANCE.get(),
        ..GraphOptions::default()
    }
}
