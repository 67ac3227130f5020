//! Formulas that users write: text that is evaluated over any scalar.
//!
//! Usual precedence: `-x^2` is `-(x^2)`, `^` binds to the right and wants a constant exponent (derivatives
//! at a negative base exist for whole ones only).

mod code;
mod node;
mod parse;

use solver::Scalar;

use node::Node;

pub use code::Language;
pub(crate) use node::CALL;
pub use node::FUNCTIONS;
pub use parse::{Expected, ParseError, ParseFault};

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

    /// Returns the cost of one evaluation, in steps of about one addition.
    pub fn cost(&self) -> u64 {
        self.root.cost()
    }

    /// Returns true if the expression contains variable `k`.
    pub fn uses(&self, k: usize) -> bool {
        self.root.uses(k)
    }

    /// The expression in another language; variable `k` is written `variable(k)`.
    ///
    /// # Examples
    /// ```
    /// use stillpoint_sensor::expression::{Expression, Language};
    ///
    /// let area = Expression::parse("pi/4 * (a + b)^2", &["a", "b"])?;
    /// let names = |k: usize| ["a", "b"][k].to_owned();
    /// assert_eq!(
    ///     area.code(Language::C, &names),
    ///     "3.141592654e0f / 4.000000000e0f * powf(a + b, 2.000000000e0f)"
    /// );
    /// # Ok::<(), stillpoint_sensor::expression::ParseError>(())
    /// ```
    pub fn code(&self, language: Language, variable: &impl Fn(usize) -> String) -> String {
        code::code(&self.root, language, variable)
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

    fn refused(text: &str) -> (usize, ParseFault) {
        let error = Expression::parse(text, &NAMES).unwrap_err();
        (error.column, error.fault)
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
        use ParseFault as F;
        let text = |text: &str| text.to_owned();
        let unexpected = |expected, found: &str| F::Unexpected {
            expected,
            found: (!found.is_empty()).then(|| text(found)),
        };
        let unknown = F::NoVariable {
            name: text("q"),
            known: NAMES.map(text).to_vec(),
        };
        let value = Expected::Value;
        for (expression, column, fault) in [
            ("x + q*y", 5, unknown),
            ("x + ", 5, unexpected(value, "")),
            ("x * * y", 5, unexpected(value, "*")),
            ("(x + y", 7, unexpected(Expected::Sign(')'), "")),
            ("x y", 3, unexpected(Expected::Operator, "y")),
            ("2x", 2, unexpected(Expected::Operator, "x")),
            ("x $ y", 3, F::NoMeaning('$')),
            ("1.2.3", 1, F::NoNumber(text("1.2.3"))),
            ("sin x", 5, unexpected(Expected::Sign('('), "x")),
            ("sinn(x)", 1, F::NoFunction(text("sinn"))),
            ("x^y", 3, F::ExponentVaries),
        ] {
            assert_eq!(refused(expression), (column, fault), "{expression}");
        }
        assert!(matches!(refused(&"(".repeat(5000)).1, F::TooLong(2000)));
        assert!(matches!(refused(&"(".repeat(900)).1, F::TooDeep(100)));
        assert!(matches!(refused(&"-".repeat(900)).1, F::TooDeep(100)));
    }
}
