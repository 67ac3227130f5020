//! Expressions in other languages.

use super::node::{Function, Node};

/// A language that code is written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// C99 in `float`, with `math.h`.
    C,
    /// Rust in `f64`.
    Rust,
}

impl Language {
    /// A number of the language.
    pub fn number(self, value: f64) -> String {
        match self {
            Self::C => format!("{value:.9e}f"),
            Self::Rust => format!("{value:?}_f64"),
        }
    }
}

/// How tightly the outermost operation binds: what is below has to be put in brackets.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Binds {
    Sum,
    Product,
    Sign,
    Whole,
}

/// The expression in `language`; variable `k` is written `variable(k)`.
pub(super) fn code(node: &Node, language: Language, variable: &impl Fn(usize) -> String) -> String {
    written(node, language, variable).0
}

fn written(
    node: &Node,
    language: Language,
    variable: &impl Fn(usize) -> String,
) -> (String, Binds) {
    let own = |node: &Node, least: Binds| {
        let (text, binds) = written(node, language, variable);
        if binds < least {
            format!("({text})")
        } else {
            text
        }
    };
    let pair = |a: &Node, sign: &str, b: &Node, binds: Binds, right: Binds| {
        (format!("{} {sign} {}", own(a, binds), own(b, right)), binds)
    };
    // An argument of a function in C, what a method is called on in Rust.
    let base = |x: &Node| match language {
        Language::C => written(x, language, variable).0,
        Language::Rust => own(x, Binds::Whole),
    };
    match node {
        Node::Constant(c) if *c < 0.0 => (language.number(*c), Binds::Sign),
        Node::Constant(c) => (language.number(*c), Binds::Whole),
        Node::Variable(k) => (variable(*k), Binds::Whole),
        Node::Negative(x) => (format!("-{}", own(x, Binds::Whole)), Binds::Sign),
        Node::Sum(a, b) => pair(a, "+", b, Binds::Sum, Binds::Product),
        Node::Difference(a, b) => pair(a, "-", b, Binds::Sum, Binds::Product),
        Node::Product(a, b) => pair(a, "*", b, Binds::Product, Binds::Whole),
        Node::Quotient(a, b) => pair(a, "/", b, Binds::Product, Binds::Whole),
        Node::Power(x, n) => match (&**x, n) {
            (Node::Variable(_), 2..=4) => {
                let factors = vec![own(x, Binds::Whole); *n as usize];
                (factors.join(" * "), Binds::Product)
            }
            _ => (power(&base(x), f64::from(*n), language), Binds::Whole),
        },
        Node::RealPower(x, r) => (power(&base(x), *r, language), Binds::Whole),
        Node::Call(function, x) => {
            let (text, _) = written(x, language, variable);
            (call(*function, &text, language), Binds::Whole)
        }
    }
}

/// `x` to a constant power.
fn power(x: &str, exponent: f64, language: Language) -> String {
    match language {
        Language::C => format!("powf({x}, {})", language.number(exponent)),
        Language::Rust if exponent.fract() == 0.0 => format!("{x}.powi({exponent})"),
        Language::Rust => format!("{x}.powf({exponent:?})"),
    }
}

/// A function of `x`.
fn call(function: Function, x: &str, language: Language) -> String {
    let name = function.name();
    match (function, language) {
        (Function::Step, Language::C) => format!("({x} > 0.0f ? 1.0f : 0.0f)"),
        (Function::Sign, Language::C) => {
            format!("({x} > 0.0f ? 1.0f : ({x} < 0.0f ? -1.0f : 0.0f))")
        }
        (Function::Abs, Language::C) => format!("fabsf({x})"),
        (Function::Ln, Language::C) => format!("logf({x})"),
        (_, Language::C) => format!("{name}f({x})"),
        (Function::Step, Language::Rust) => format!("(if {x} > 0.0 {{ 1.0 }} else {{ 0.0 }})"),
        (Function::Sign, Language::Rust) => {
            format!("(if {x} > 0.0 {{ 1.0 }} else if {x} < 0.0 {{ -1.0 }} else {{ 0.0 }})")
        }
        (_, Language::Rust) => format!("({x}).{name}()"),
    }
}
