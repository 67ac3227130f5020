//! From text to an expression, by precedence climbing.

use std::f64::consts::PI;
use std::fmt;

use super::node::{Function, Node};

/// Longest text.
const LONGEST: usize = 2000;
/// Deepest nesting.
const DEEPEST: usize = 100;

/// Syntax error with its column. The crate `findings` gives the words.
#[derive(Clone, Debug, PartialEq)]
pub struct ParseError {
    /// Place in the text, counted in characters from 1.
    pub column: usize,
    /// Kind of the error.
    pub fault: ParseFault,
}

/// Kind of a syntax error in an expression.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ParseFault {
    /// It is longer than so many characters.
    TooLong(usize),
    /// It is nested more than so deep.
    TooDeep(usize),
    /// This word is no number.
    NoNumber(String),
    /// This character has no meaning.
    NoMeaning(char),
    /// Something else stands where it has to go on otherwise.
    Unexpected {
        /// Expected continuation.
        expected: Expected,
        /// Text found instead; `None` at the end.
        found: Option<String>,
    },
    /// An exponent is no constant.
    ExponentVaries,
    /// There is no such function.
    NoFunction(String),
    /// There is no such variable.
    NoVariable {
        /// The name.
        name: String,
        /// The variables that there are.
        known: Vec<String>,
    },
}

/// Expected continuation of an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Expected {
    /// With an operator.
    Operator,
    /// With a number, a name or a bracket.
    Value,
    /// With this sign.
    Sign(char),
}

impl fmt::Display for ParseError {
    /// The place and the fault as data.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {:?}", self.column, self.fault)
    }
}

impl std::error::Error for ParseError {}

#[derive(Clone, Debug, PartialEq)]
enum Token {
    Number(f64),
    Name(String),
    Sign(char),
    End,
}

impl Token {
    /// Returns the token as written; `None` at the end.
    fn written(&self) -> Option<String> {
        match self {
            Self::Number(number) => Some(format!("{number}")),
            Self::Name(name) => Some(name.clone()),
            Self::Sign(sign) => Some(sign.to_string()),
            Self::End => None,
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
        _ => Err(parser.unexpected(Expected::Operator)),
    }
}

/// Tokens with their columns; the last is [`Token::End`].
fn tokens(text: &str) -> Result<Vec<(usize, Token)>, ParseError> {
    let all: Vec<char> = text.chars().collect();
    if all.len() > LONGEST {
        let (column, fault) = (LONGEST, ParseFault::TooLong(LONGEST));
        return Err(ParseError { column, fault });
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
                fault: ParseFault::NoNumber(word.clone()),
            })?),
            'a'..='z' | 'A'..='Z' | '_' => Token::Name(word),
            '+' | '-' | '*' | '/' | '^' | '(' | ')' => Token::Sign(c),
            _ => {
                let fault = ParseFault::NoMeaning(c);
                return Err(ParseError { column, fault });
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

    fn error(&self, fault: ParseFault) -> ParseError {
        ParseError {
            column: self.column(),
            fault,
        }
    }

    fn unexpected(&self, expected: Expected) -> ParseError {
        let found = self.peek().written();
        self.error(ParseFault::Unexpected { expected, found })
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
        Err(self.unexpected(Expected::Sign(sign)))
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
            return Err(self.error(ParseFault::TooDeep(DEEPEST)));
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
        let exponent = self.signed()?.constant().ok_or(ParseError {
            column,
            fault: ParseFault::ExponentVaries,
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
            Token::Sign(_) | Token::End => Err(self.unexpected(Expected::Value)),
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
            let name = name.to_owned();
            return Err(self.error(match is_called {
                true => ParseFault::NoFunction(name),
                false => ParseFault::NoVariable {
                    name,
                    known: self.names.iter().map(|n| (*n).to_owned()).collect(),
                },
            }));
        };
        self.at += 1;
        self.want('(')?;
        let argument = self.sum()?;
        self.want(')')?;
        Ok(Node::Call(function, Box::new(argument)))
    }
}
