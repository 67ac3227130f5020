//! Formulas that users write: text that is evaluated over any scalar.
//!
//! Usual precedence: `-x^2` is `-(x^2)`, `^` binds to the right and wants a constant exponent (derivatives
//! at a negative base exist for whole ones only).

mod node;
mod parse;

use solver::Scalar;

use node::Node;

pub(crate) use node::CALL;
pub use node::FUNCTIONS;
pub use parse::ParseError;

/// A parsed expression over numbered variables.
#[derive(Clone, Debug, PartialEq)]
pub struct Expression {
    root: Node,
}

impl Expression {
    /// Reads `text`; variable `k` is called `names[k]`.
    ///
    /// Numbers (`2`, `1e-4`), `pi`, `+ - * / ^`, brackets, and [`FUNCTIONS`].
    ///
    /// # Errors
    /// [`ParseError`] with the column and what is expected there.
    pub fn parse(text: &str, names: &[&str]) -> Result<Self, ParseError> {
        parse::parse(text, names).map(|root| Self { root })
    }

    /// What an evaluation takes, in steps about as long as an addition.
    pub fn cost(&self) -> u64 {
        self.root.cost()
    }

    /// Whether variable `k` stands in it.
    pub fn uses(&self, k: usize) -> bool {
        self.root.uses(k)
    }

    /// Its value where variable `k` is `variable(k)`.
    pub fn eval<D: Scalar>(&self, variable: &impl Fn(usize) -> D) -> D {
        self.root.eval(variable)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use solver::scalar::{along, derivatives, second_derivative, variable};

    const NAMES: [&str; 2] = ["x", "y"];

    fn value(text: &str, x: f64, y: f64) -> f64 {
        Expression::parse(text, &NAMES)
            .unwrap()
            .eval(&|k| [x, y][k])
    }

    fn refused(text: &str) -> String {
        Expression::parse(text, &NAMES).unwrap_err().to_string()
    }

    #[test]
    fn precedence_is_that_of_the_blackboard() {
        assert_eq!(value("-x^2", 3.0, 0.0), -9.0);
        assert_eq!(value("2 - 3 - 4*x/2*3", 1.0, 0.0), -7.0);
        assert_eq!(value("2^3^2", 0.0, 0.0), 512.0);
        assert_eq!(value("x^-1 * -y", 4.0, 8.0), -2.0);
        assert_eq!(value("1/x/y", 4.0, 8.0), 1.0 / 32.0);
        assert_eq!(value("(x + y)^2 - 1.5e-1*.5", 1.0, 2.0), 9.0 - 0.075);
        assert_eq!(value("+x - -y", 1.0, 2.0), 3.0);
        assert_eq!(value("x^(1/2)", 9.0, 0.0), 3.0);
    }

    #[test]
    fn functions_are_those_of_their_names() {
        let by_name = [
            ("sin", 0.3_f64.sin()),
            ("cos", 0.3_f64.cos()),
            ("tan", 0.3_f64.tan()),
            ("asin", 0.3_f64.asin()),
            ("acos", 0.3_f64.acos()),
            ("atan", 0.3_f64.atan()),
            ("sinh", 0.3_f64.sinh()),
            ("cosh", 0.3_f64.cosh()),
            ("tanh", 0.3_f64.tanh()),
            ("exp", 0.3_f64.exp()),
            ("ln", 0.3_f64.ln()),
            ("sqrt", 0.3_f64.sqrt()),
            ("abs", 0.3),
            ("sign", 1.0),
            ("step", 1.0),
        ];
        assert_eq!(by_name.map(|(name, _)| name), FUNCTIONS);
        for (name, expected) in by_name {
            assert_eq!(value(&format!("{name}(x)"), 0.3, 0.0), expected, "{name}");
        }
        assert_eq!(value("abs(x) + sign(x) + step(x)", -2.0, 0.0), 1.0);
        assert_eq!(value("cos(pi)", 0.0, 0.0), -1.0);
    }

    #[test]
    fn derivatives_go_through_an_expression() {
        let expression = Expression::parse("x^2*y + sin(y)", &NAMES).unwrap();
        let jet = expression.eval(&|k| variable([-3.0, 0.5][k], k));
        assert_eq!(derivatives(&jet)[0], -3.0);
        assert!((derivatives(&jet)[1] - 9.0 - 0.5_f64.cos()).abs() < 1e-15);
        let second = expression.eval(&|k| along([-3.0, 0.5][k], [1.0, 0.0][k]));
        assert_eq!(second_derivative(&second), 1.0);
    }

    #[test]
    fn what_cannot_be_read_is_named_with_its_column() {
        let known = "the variables are x, y";
        assert_eq!(
            refused("x + q*y"),
            format!("column 5: there is no `q`: {known}")
        );
        assert_eq!(
            refused("x + "),
            "column 5: a number, a name or a bracket expected, the end found"
        );
        assert_eq!(
            refused("x * * y"),
            "column 5: a number, a name or a bracket expected, `*` found"
        );
        assert_eq!(refused("(x + y"), "column 7: `)` expected, the end found");
        assert_eq!(refused("x y"), "column 3: an operator expected, `y` found");
        assert_eq!(refused("2x"), "column 2: an operator expected, `x` found");
        assert_eq!(refused("x $ y"), "column 3: `$` has no meaning here");
        assert_eq!(refused("1.2.3"), "column 1: `1.2.3` is no number");
        assert_eq!(refused("sin x"), "column 5: `(` expected, `x` found");
        assert!(refused("sinn(x)").starts_with("column 1: there is no function `sinn`: sin, "));
        assert!(refused("x^y").starts_with("column 3: the exponent must be a constant"));
        assert!(refused(&"(".repeat(5000)).contains("longer than"));
        assert!(refused(&"(".repeat(900)).contains("nested"));
        assert!(refused(&"-".repeat(900)).contains("nested"));
    }
}
