//! From text to an expression, by precedence climbing.

use std::f64::consts::PI;

use super::node::{FUNCTIONS, Function, Node};

/// Longest text.
const LONGEST: usize = 2000;
/// Deepest nesting.
const DEEPEST: usize = 100;

/// What cannot be read, and where.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("column {column}: {what}")]
pub struct ParseError {
    /// Place in the text, counted in characters from 1.
    pub column: usize,
    /// What was found and what is expected.
    pub what: String,
}

#[derive(Clone, Debug, PartialEq)]
enum Token {
    Number(f64),
    Name(String),
    Sign(char),
    End,
}

impl Token {
    /// As messages show it.
    fn shown(&self) -> String {
        match self {
            Self::Number(number) => format!("`{number}`"),
            Self::Name(name) => format!("`{name}`"),
            Self::Sign(sign) => format!("`{sign}`"),
            Self::End => "the end".to_owned(),
        }
    }
}

/// The root of `text` over the variables `names`.
pub(super) fn parse(text: &str, names: &[&str]) -> Result<Node, ParseError> {
    let mut parser = Parser {
        tokens: tokens(text)?,
        at: 0,
        depth: 0,
        names,
    };
    let root = parser.sum()?;
    match parser.peek() {
        Token::End => Ok(root),
        found => Err(parser.error(format!("an operator expected, {} found", found.shown()))),
    }
}

/// Tokens with their columns; the last is [`Token::End`].
fn tokens(text: &str) -> Result<Vec<(usize, Token)>, ParseError> {
    let all: Vec<char> = text.chars().collect();
    if all.len() > LONGEST {
        let (column, what) = (LONGEST, format!("longer than {LONGEST} characters"));
        return Err(ParseError { column, what });
    }
    let mut tokens = Vec::new();
    let mut at = 0;
    while let Some(&c) = all.get(at) {
        let column = at + 1;
        let length = match c {
            '0'..='9' | '.' => number_length(&all[at..]),
            'a'..='z' | 'A'..='Z' | '_' => {
                let is_name = |c: &&char| c.is_ascii_alphanumeric() || **c == '_';
                all[at..].iter().take_while(is_name).count()
            }
            _ => 1,
        };
        let word: String = all[at..at + length].iter().collect();
        at += length;
        let token = match c {
            c if c.is_whitespace() => continue,
            '0'..='9' | '.' => Token::Number(word.parse().map_err(|_| ParseError {
                column,
                what: format!("`{word}` is no number"),
            })?),
            'a'..='z' | 'A'..='Z' | '_' => Token::Name(word),
            '+' | '-' | '*' | '/' | '^' | '(' | ')' => Token::Sign(c),
            _ => {
                let what = format!("`{c}` has no meaning here");
                return Err(ParseError { column, what });
            }
        };
        tokens.push((column, token));
    }
    tokens.push((all.len() + 1, Token::End));
    Ok(tokens)
}

/// Characters of the number that `rest` begins with: digits, points, and an exponent that has digits.
fn number_length(rest: &[char]) -> usize {
    let digits = |from: usize| {
        let is_part = |c: &&char| c.is_ascii_digit() || **c == '.';
        rest[from..].iter().take_while(is_part).count()
    };
    let mantissa = digits(0);
    if !matches!(rest.get(mantissa), Some('e' | 'E')) {
        return mantissa;
    }
    let signed = matches!(rest.get(mantissa + 1), Some('+' | '-'));
    let from = mantissa + 1 + usize::from(signed);
    match from < rest.len() && rest[from].is_ascii_digit() {
        true => from + digits(from),
        false => mantissa,
    }
}

struct Parser<'a> {
    tokens: Vec<(usize, Token)>,
    at: usize,
    depth: usize,
    names: &'a [&'a str],
}

impl Parser<'_> {
    fn peek(&self) -> Token {
        self.tokens
            .get(self.at)
            .map_or(Token::End, |(_, token)| token.clone())
    }

    fn column(&self) -> usize {
        self.tokens
            .get(self.at)
            .or(self.tokens.last())
            .map_or(1, |(column, _)| *column)
    }

    fn error(&self, what: impl Into<String>) -> ParseError {
        ParseError {
            column: self.column(),
            what: what.into(),
        }
    }

    /// Steps over `sign` if it comes next.
    fn take(&mut self, sign: char) -> bool {
        let taken = self.peek() == Token::Sign(sign);
        self.at += usize::from(taken);
        taken
    }

    fn want(&mut self, sign: char) -> Result<(), ParseError> {
        if self.take(sign) {
            return Ok(());
        }
        Err(self.error(format!("`{sign}` expected, {} found", self.peek().shown())))
    }

    /// `product + product − …`
    fn sum(&mut self) -> Result<Node, ParseError> {
        let mut left = self.product()?;
        loop {
            if self.take('+') {
                left = Node::Sum(Box::new(left), Box::new(self.product()?));
            } else if self.take('-') {
                left = Node::Difference(Box::new(left), Box::new(self.product()?));
            } else {
                return Ok(left);
            }
        }
    }

    /// `signed * signed / …`
    fn product(&mut self) -> Result<Node, ParseError> {
        let mut left = self.signed()?;
        loop {
            if self.take('*') {
                left = Node::Product(Box::new(left), Box::new(self.signed()?));
            } else if self.take('/') {
                left = Node::Quotient(Box::new(left), Box::new(self.signed()?));
            } else {
                return Ok(left);
            }
        }
    }

    /// `− signed`, or a power.
    fn signed(&mut self) -> Result<Node, ParseError> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(self.error(format!("nested more than {DEEPEST} deep")));
        }
        let node = if self.take('-') {
            Node::Negative(Box::new(self.signed()?))
        } else if self.take('+') {
            self.signed()?
        } else {
            self.power()?
        };
        self.depth -= 1;
        Ok(node)
    }

    /// `atom ^ signed`, the exponent a constant.
    fn power(&mut self) -> Result<Node, ParseError> {
        let base = self.atom()?;
        if !self.take('^') {
            return Ok(base);
        }
        let column = self.column();
        let exponent = self.signed()?.constant().ok_or_else(|| ParseError {
            column,
            what: "the exponent must be a constant; write exp(y*ln(x)) for x to the power of y"
                .to_owned(),
        })?;
        let whole = exponent.fract() == 0.0 && exponent.abs() <= 1000.0;
        Ok(match whole {
            true => Node::Power(Box::new(base), exponent as i32),
            false => Node::RealPower(Box::new(base), exponent),
        })
    }

    fn atom(&mut self) -> Result<Node, ParseError> {
        let found = self.peek();
        match found {
            Token::Number(number) => {
                self.at += 1;
                Ok(Node::Constant(number))
            }
            Token::Name(name) => self.name(&name),
            Token::Sign('(') => {
                self.at += 1;
                let inner = self.sum()?;
                self.want(')')?;
                Ok(inner)
            }
            other => Err(self.error(format!(
                "a number, a name or a bracket expected, {} found",
                other.shown()
            ))),
        }
    }

    /// A variable, `pi`, or a function with its argument.
    fn name(&mut self, name: &str) -> Result<Node, ParseError> {
        if let Some(place) = self.names.iter().position(|known| *known == name) {
            self.at += 1;
            return Ok(Node::Variable(place));
        }
        if name == "pi" {
            self.at += 1;
            return Ok(Node::Constant(PI));
        }
        let is_called = matches!(self.tokens.get(self.at + 1), Some((_, Token::Sign('('))));
        let Some(function) = Function::named(name) else {
            let known = match is_called {
                true => format!("there is no function `{name}`: {}", FUNCTIONS.join(", ")),
                false => format!(
                    "there is no `{name}`: the variables are {}",
                    self.names.join(", ")
                ),
            };
            return Err(self.error(known));
        };
        self.at += 1;
        self.want('(')?;
        let argument = self.sum()?;
        self.want(')')?;
        Ok(Node::Call(function, Box::new(argument)))
    }
}
