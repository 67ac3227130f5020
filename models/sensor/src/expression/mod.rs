//! Formulas that users write: text that is evaluated over any scalar.
//!
//! Usual precedence: `-x^2` is `-(x^2)`, `^` binds to the right and wants a constant exponent (derivatives
//! at a negative base exist for whole ones only).

mod parse;

use solver::{Scalar, lit};

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

/// The functions of one argument that an expression may call; `step(x)` is 1 for positive `x`, else 0.
pub const FUNCTIONS: [&str; 15] = [
    "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp", "ln", "sqrt",
    "abs", "sign", "step",
];

/// Steps of a call of a function.
pub(crate) const CALL: u64 = 15;

/// One operation on what is below it.
#[derive(Clone, Debug, PartialEq)]
enum Node {
    Constant(f64),
    Variable(usize),
    Negative(Box<Node>),
    Sum(Box<Node>, Box<Node>),
    Difference(Box<Node>, Box<Node>),
    Product(Box<Node>, Box<Node>),
    Quotient(Box<Node>, Box<Node>),
    Power(Box<Node>, i32),
    RealPower(Box<Node>, f64),
    Call(Function, Box<Node>),
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Function {
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Exp,
    Ln,
    Sqrt,
    Abs,
    Sign,
    Step,
}

impl Node {
    fn eval<D: Scalar>(&self, variable: &impl Fn(usize) -> D) -> D {
        let value = |node: &Self| node.eval(variable);
        match self {
            Self::Constant(c) => lit(*c),
            Self::Variable(k) => variable(*k),
            Self::Negative(x) => -value(x),
            Self::Sum(a, b) => value(a) + value(b),
            Self::Difference(a, b) => value(a) - value(b),
            Self::Product(a, b) => value(a) * value(b),
            Self::Quotient(a, b) => value(a) / value(b),
            Self::Power(x, n) => value(x).powi(*n),
            Self::RealPower(x, r) => value(x).powf(*r),
            Self::Call(function, x) => function.of(value(x)),
        }
    }

    fn uses(&self, k: usize) -> bool {
        match self {
            Self::Constant(_) => false,
            Self::Variable(own) => *own == k,
            Self::Negative(x) | Self::Power(x, _) | Self::RealPower(x, _) | Self::Call(_, x) => {
                x.uses(k)
            }
            Self::Sum(a, b)
            | Self::Difference(a, b)
            | Self::Product(a, b)
            | Self::Quotient(a, b) => a.uses(k) || b.uses(k),
        }
    }

    fn cost(&self) -> u64 {
        match self {
            Self::Constant(_) | Self::Variable(_) => 0,
            Self::Negative(x) => 1 + x.cost(),
            Self::Sum(a, b) | Self::Difference(a, b) | Self::Product(a, b) => {
                1 + a.cost() + b.cost()
            }
            Self::Quotient(a, b) => 2 + a.cost() + b.cost(),
            Self::Power(x, _) => 2 + x.cost(),
            Self::RealPower(x, _) | Self::Call(_, x) => CALL + x.cost(),
        }
    }

    /// Its value if no variable is in it.
    fn constant(&self) -> Option<f64> {
        match self {
            Self::Variable(_) => None,
            Self::Constant(c) => Some(*c),
            Self::Negative(x) | Self::Power(x, _) | Self::RealPower(x, _) | Self::Call(_, x) => {
                x.constant()?;
                Some(self.eval(&|_| f64::NAN))
            }
            Self::Sum(a, b)
            | Self::Difference(a, b)
            | Self::Product(a, b)
            | Self::Quotient(a, b) => {
                a.constant().and(b.constant())?;
                Some(self.eval(&|_| f64::NAN))
            }
        }
    }
}

impl Function {
    fn named(name: &str) -> Option<Self> {
        Some(match name {
            "sin" => Self::Sin,
            "cos" => Self::Cos,
            "tan" => Self::Tan,
            "asin" => Self::Asin,
            "acos" => Self::Acos,
            "atan" => Self::Atan,
            "sinh" => Self::Sinh,
            "cosh" => Self::Cosh,
            "tanh" => Self::Tanh,
            "exp" => Self::Exp,
            "ln" => Self::Ln,
            "sqrt" => Self::Sqrt,
            "abs" => Self::Abs,
            "sign" => Self::Sign,
            "step" => Self::Step,
            _ => return None,
        })
    }

    fn of<D: Scalar>(self, x: D) -> D {
        match self {
            Self::Sin => x.sin(),
            Self::Cos => x.cos(),
            Self::Tan => x.tan(),
            Self::Asin => x.asin(),
            Self::Acos => x.acos(),
            Self::Atan => x.atan(),
            Self::Sinh => x.sinh(),
            Self::Cosh => x.cosh(),
            Self::Tanh => x.tanh(),
            Self::Exp => x.exp(),
            Self::Ln => x.ln(),
            Self::Sqrt => x.sqrt(),
            Self::Abs if x.re() < 0.0 => -x,
            Self::Abs => x,
            Self::Sign if x.re() < 0.0 => lit(-1.0),
            Self::Sign | Self::Step => lit(if x.re() > 0.0 { 1.0 } else { 0.0 }),
        }
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
