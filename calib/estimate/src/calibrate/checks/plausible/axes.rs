//! Axes that are exchanged or have the other sign.

use nalgebra::Matrix3;

/// A signed permutation of the axes: axis `row` is `±` axis `of[row]` of the readings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct SignedAxes {
    of: [usize; 3],
    negative: [bool; 3],
}

const NAMES: [&str; 3] = ["x", "y", "z"];

impl SignedAxes {
    /// The one nearest to a matrix whose rows are axes; `None` where two rows are nearest to the same axis.
    pub fn nearest(t: &Matrix3<f64>) -> Option<Self> {
        let of = [0, 1, 2].map(|row| t.row(row).transpose().iamax());
        let is_permutation = (0..3).all(|axis| of.contains(&axis));
        is_permutation.then(|| Self {
            of,
            negative: [0, 1, 2].map(|row| t[(row, of[row])] < 0.0),
        })
    }

    /// All 48, the unchanged axes first.
    pub fn all() -> Vec<Self> {
        const ORDERS: [[usize; 3]; 6] = [
            [0, 1, 2],
            [1, 2, 0],
            [2, 0, 1],
            [1, 0, 2],
            [0, 2, 1],
            [2, 1, 0],
        ];
        let signs = |of: [usize; 3]| {
            (0..8).map(move |bits: usize| Self {
                of,
                negative: [0, 1, 2].map(|row| bits >> row & 1 == 1),
            })
        };
        ORDERS.into_iter().flat_map(signs).collect()
    }

    /// Returns it as a signed permutation matrix (`3 × 3`) whose columns are the axes of the readings.
    pub fn matrix(&self) -> Matrix3<f64> {
        let mut matrix = Matrix3::zeros();
        for row in 0..3 {
            let (of, negative) = self.of(row);
            matrix[(row, of)] = if negative { -1.0 } else { 1.0 };
        }
        matrix
    }

    /// The readings' axis that `row` is, and whether with the other sign.
    pub fn of(&self, row: usize) -> (usize, bool) {
        (self.of[row], self.negative[row])
    }

    pub fn is_unchanged(&self) -> bool {
        self.is_in_order() && !self.negative.contains(&true)
    }

    /// No axis is exchanged.
    pub fn is_in_order(&self) -> bool {
        self.of == [0, 1, 2]
    }

    /// True for axes that no turning brings into one another.
    pub fn is_mirror(&self) -> bool {
        self.matrix().determinant() < 0.0
    }

    /// A turn by 180°: with all signs changed it mirrors one plane, as one wrong sign or two exchanged columns do.
    pub fn is_half_turn(&self) -> bool {
        let matrix = self.matrix();
        !self.is_mirror() && !self.is_unchanged() && matrix == matrix.transpose()
    }

    /// All signs changed.
    pub fn opposite(&self) -> Self {
        Self {
            of: self.of,
            negative: self.negative.map(|negative| !negative),
        }
    }

    /// The axes that undo them.
    pub fn inverse(&self) -> Self {
        Self::nearest(&self.matrix().transpose()).unwrap_or(*self)
    }

    pub fn flipped(&self) -> impl Iterator<Item = usize> + '_ {
        (0..3).filter(|&row| self.negative[row])
    }

    /// `x and z are flipped`, or which axis is which.
    pub fn in_words(&self) -> String {
        if self.is_in_order() && !self.is_unchanged() {
            let flipped: Vec<&str> = self.flipped().map(|axis| NAMES[axis]).collect();
            let verb = if flipped.len() > 1 { "are" } else { "is" };
            return format!("{} {verb} flipped", flipped.join(" and "));
        }
        let row = |row: usize| {
            let (of, negative) = self.of(row);
            let sign = if negative { "-" } else { "" };
            format!("{} is its {sign}{}", NAMES[row], NAMES[of])
        };
        [0, 1, 2].map(row).join(", ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_turns_with_all_signs_changed_are_the_mirrors_of_one_wrong_sign_or_two_exchanged_columns()
     {
        let all = SignedAxes::all();
        assert_eq!(all.len(), 48);
        assert!(all[0].is_unchanged());
        let half_turns: Vec<_> = all.iter().filter(|axes| axes.is_half_turn()).collect();
        // About three axes and six diagonals of faces.
        assert_eq!(half_turns.len(), 9);
        assert!(half_turns.iter().all(|axes| axes.opposite().is_mirror()));
        let flip = SignedAxes::nearest(&Matrix3::from_diagonal(&[1.0, -1.0, -1.0].into())).unwrap();
        assert_eq!(flip.in_words(), "y and z are flipped");
        assert_eq!(flip.opposite().in_words(), "x is flipped");
    }

    #[test]
    fn every_one_is_nearest_to_its_own_matrix_and_undone_by_its_inverse() {
        for axes in SignedAxes::all() {
            assert_eq!(SignedAxes::nearest(&(axes.matrix() * 0.3)), Some(axes));
            let undone = axes.inverse().matrix() * axes.matrix();
            assert_eq!(undone, Matrix3::identity());
        }
    }
}
