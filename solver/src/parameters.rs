//! Parameters by name, and which of them are free.

use serde::{Deserialize, Serialize};

/// Values with names and units, in the order of the residual's `x`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Written")]
pub struct Parameters {
    names: Vec<String>,
    units: Vec<String>,
    values: Vec<f64>,
}

/// Parameters as they are written, lengths unchecked.
#[derive(Deserialize)]
struct Written {
    names: Vec<String>,
    units: Vec<String>,
    values: Vec<f64>,
}

impl TryFrom<Written> for Parameters {
    type Error = String;

    fn try_from(written: Written) -> Result<Self, String> {
        let Written {
            names,
            units,
            values,
        } = written;
        let (n, u, v) = (names.len(), units.len(), values.len());
        if n != v || u != v {
            return Err(format!("{n} names and {u} units for {v} values"));
        }
        Ok(Self {
            names,
            units,
            values,
        })
    }
}

impl Parameters {
    /// No parameters.
    pub fn new() -> Self {
        Self::default()
    }

    /// Unit-less parameters called `x0, x1, …`.
    pub fn unnamed(values: &[f64]) -> Self {
        let mut parameters = Self::new();
        for (k, &value) in values.iter().enumerate() {
            parameters.push(format!("x{k}"), "", value);
        }
        parameters
    }

    /// Appends one parameter.
    pub fn push(&mut self, name: impl Into<String>, unit: impl Into<String>, value: f64) {
        self.names.push(name.into());
        self.units.push(unit.into());
        self.values.push(value);
    }

    /// Their number.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// True if there are none.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// The names, in order.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The units, in order.
    pub fn units(&self) -> &[String] {
        &self.units
    }

    /// The values, in order.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The values, to change them.
    pub fn values_mut(&mut self) -> &mut [f64] {
        &mut self.values
    }

    /// The value called `name`.
    pub fn get(&self, name: &str) -> Option<f64> {
        self.index(name).map(|k| self.values[k])
    }

    /// The place of the parameter called `name`.
    pub fn index(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|n| n == name)
    }

    /// The mask that frees the parameters whose name passes.
    pub fn free_where(&self, is_free: impl Fn(&str) -> bool) -> Mask {
        Mask {
            free: self.names.iter().map(|name| is_free(name)).collect(),
        }
    }
}

/// The parameters that are free; the others keep their value and cost nothing.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Mask {
    free: Vec<bool>,
}

impl Mask {
    /// All `n` parameters free.
    pub fn all(n: usize) -> Self {
        Self {
            free: vec![true; n],
        }
    }

    /// Number of parameters it speaks of.
    pub fn len(&self) -> usize {
        self.free.len()
    }

    /// True if it speaks of none.
    pub fn is_empty(&self) -> bool {
        self.free.is_empty()
    }

    /// True where parameter `k` is free; `false` where there is none.
    pub fn is_free(&self, k: usize) -> bool {
        self.free.get(k).is_some_and(|&free| free)
    }

    /// The same with parameter `k` held.
    pub fn without(&self, k: usize) -> Self {
        let mut free = self.free.clone();
        if let Some(entry) = free.get_mut(k) {
            *entry = false;
        }
        Self { free }
    }

    /// The indices of the free parameters, ascending.
    pub fn free_indices(&self) -> Vec<usize> {
        (0..self.free.len()).filter(|&k| self.free[k]).collect()
    }
}
