//! A block problem: terms of shared parameters and of one block each.

use crate::parameters::Parameters;
use crate::residual::Problem;

/// A sum of terms, each an ordinary [`Problem`] of the shared parameters and of the parameters of
/// one block, or of a block and the next.
///
/// Blocks are eliminated one after the other, so that time and memory grow linearly in their
/// number. A term that couples a block to the next (a chain, as between consecutive turns of a
/// recording) costs a block of twice the width and stays linear; a term that couples blocks
/// further apart has no place here: make what couples them shared parameters.
///
/// ```
/// use stillpoint_solver::{BlockProblem, Mask, Options, Parameters, Residual, Scalar, lit, solve_blocks};
///
/// /// `y = slope · t + offset of the group`.
/// struct Group(Vec<[f64; 2]>);
///
/// impl<D: Scalar> Residual<D> for Group {
///     fn residuals(&self, x: &[D], out: &mut Vec<D>) {
///         out.extend(self.0.iter().map(|&[t, y]| x[0] * t + x[1] - lit::<D>(y)));
///     }
/// }
///
/// let mut shared = Parameters::new();
/// shared.push("slope", "", 0.0);
/// let mut problem = BlockProblem::new(shared);
/// for offset in [1.0, 5.0] {
///     let block = problem.add_block(&[0.0]);
///     problem.add_term(block, Group((0..4).map(|t| [t as f64, 2.0 * t as f64 + offset]).collect()));
/// }
/// let report = solve_blocks(&problem, &Mask::all(1), &Options::default())?;
/// assert!((report.shared.parameters.values()[0] - 2.0).abs() < 1e-12);
/// assert!((report.blocks[1][0] - 5.0).abs() < 1e-12);
/// # Ok::<(), stillpoint_solver::Error>(())
/// ```
pub struct BlockProblem<'a> {
    pub(crate) shared: Parameters,
    pub(crate) blocks: Vec<Vec<f64>>,
    pub(crate) terms: Vec<Term<'a>>,
}

/// A residual of the shared parameters, those of `block` and, if coupled, those of the next.
pub(crate) struct Term<'a> {
    pub problem: Box<dyn Problem + 'a>,
    pub block: usize,
    pub coupled: bool,
}

impl<'a> BlockProblem<'a> {
    /// No blocks yet; `shared` are the start values of the shared parameters.
    pub fn new(shared: Parameters) -> Self {
        Self {
            shared,
            blocks: Vec::new(),
            terms: Vec::new(),
        }
    }

    /// Appends a block with its start values and returns its number.
    pub fn add_block(&mut self, start: &[f64]) -> usize {
        self.blocks.push(start.to_vec());
        self.blocks.len() - 1
    }

    /// Adds a term whose `x` is the shared parameters followed by those of `block`.
    pub fn add_term(&mut self, block: usize, problem: impl Problem + 'a) {
        self.terms.push(Term {
            problem: Box::new(problem),
            block,
            coupled: false,
        });
    }

    /// Adds a term whose `x` is the shared parameters, those of `block` and those of `block + 1`.
    pub fn add_coupled_term(&mut self, block: usize, problem: impl Problem + 'a) {
        self.terms.push(Term {
            problem: Box::new(problem),
            block,
            coupled: true,
        });
    }
}

impl std::fmt::Debug for BlockProblem<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("BlockProblem")
            .field("shared", &self.shared)
            .field("blocks", &self.blocks.len())
            .field("terms", &self.terms.len())
            .finish()
    }
}
