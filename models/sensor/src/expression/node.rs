//! A parsed formula as a tree of operations, and its value.

use solver::{Scalar, lit};

/// The functions of one argument that an expression may call; `step(x)` is 1 for positive `x`, else 0.
pub const FUNCTIONS: [&str; 15] = [
    "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp", "ln", "sqrt",
    "abs", "sign", "step",
];

/// Steps of a call of a function.
pub const CALL: u64 = 15;

/// One operation on what is below it.
#[derive(Clone, Debug, PartialEq)]
pub enum Node {
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
pub enum Function {
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
    pub fn eval<D: Scalar>(&self, variable: &impl Fn(usize) -> D) -> D {
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

    pub fn uses(&self, k: usize) -> bool {
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

    pub fn cost(&self) -> u64 {
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
    pub fn constant(&self) -> Option<f64> {
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
    /// All of them, in the order of [`FUNCTIONS`].
    const ALL: [Self; FUNCTIONS.len()] = [
        Self::Sin,
        Self::Cos,
        Self::Tan,
        Self::Asin,
        Self::Acos,
        Self::Atan,
        Self::Sinh,
        Self::Cosh,
        Self::Tanh,
        Self::Exp,
        Self::Ln,
        Self::Sqrt,
        Self::Abs,
        Self::Sign,
        Self::Step,
    ];

    pub fn named(name: &str) -> Option<Self> {
        let place = FUNCTIONS.iter().position(|own| *own == name)?;
        Self::ALL.get(place).copied()
    }

    pub fn name(self) -> &'static str {
        FUNCTIONS[self as usize]
    }

    pub fn of<D: Scalar>(self, x: D) -> D {
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
