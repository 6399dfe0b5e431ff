//! A number with its derivatives by the parameters of a layout: forward differentiation.

use std::ops::{Add, Mul, Neg, Sub};

/// Number of parameters: three of the whole line, and the unknown of the span that is being solved.
pub const PARAMETER_COUNT: usize = 4;
/// The parameter that is the unknown of a span.
pub const SPAN_UNKNOWN: usize = 3;

/// A value and its derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Var {
    pub value: f64,
    pub by: [f64; PARAMETER_COUNT],
}

impl Var {
    /// A number that nothing changes.
    pub const fn constant(value: f64) -> Var {
        Var { value, by: [0.0; PARAMETER_COUNT] }
    }

    /// A parameter; `slope` is its derivative by itself.
    pub fn parameter(value: f64, which: usize, slope: f64) -> Var {
        let mut made = Var::constant(value);
        if let Some(by) = made.by.get_mut(which) {
            *by = slope;
        }
        made
    }

    /// A function of one number.
    pub fn map(self, value: f64, slope: f64) -> Var {
        Var { value, by: self.by.map(|b| if b == 0.0 { 0.0 } else { slope * b }) }
    }

    /// A function of several numbers, each with the derivative by it.
    pub fn function<const N: usize>(value: f64, of: [(Var, f64); N]) -> Var {
        let mut by = [0.0; PARAMETER_COUNT];
        for (var, slope) in of {
            for (sum, b) in by.iter_mut().zip(var.by) {
                if b != 0.0 {
                    *sum += slope * b;
                }
            }
        }
        Var { value, by }
    }

    /// The derivative by the unknown of the span, in this number's unit over the unknown's.
    pub fn by_unknown(self) -> f64 {
        let [.., unknown] = self.by;
        unknown
    }

    /// The same number where the unknown keeps `zero` at zero.
    pub fn eliminate(mut self, zero: &Var) -> Var {
        let share = self.by_unknown() / zero.by_unknown();
        if self.by_unknown() != 0.0 {
            for (by, z) in self.by.iter_mut().zip(zero.by) {
                *by -= share * z;
            }
        }
        self.by[SPAN_UNKNOWN] = 0.0;
        self
    }
}

impl Add for Var {
    type Output = Var;
    fn add(self, other: Var) -> Var {
        Var::function(self.value + other.value, [(self, 1.0), (other, 1.0)])
    }
}

impl Sub for Var {
    type Output = Var;
    fn sub(self, other: Var) -> Var {
        Var::function(self.value - other.value, [(self, 1.0), (other, -1.0)])
    }
}

impl Neg for Var {
    type Output = Var;
    fn neg(self) -> Var {
        self.map(-self.value, -1.0)
    }
}

impl Mul<f64> for Var {
    type Output = Var;
    fn mul(self, by: f64) -> Var {
        self.map(self.value * by, by)
    }
}

impl Add<f64> for Var {
    type Output = Var;
    fn add(self, by: f64) -> Var {
        self.map(self.value + by, 1.0)
    }
}
