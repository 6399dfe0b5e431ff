//! Random numbers that are the same in every run.

/// A random number from 0 to 1, the same in every run.
pub struct RandomNumbers(pub u64);

impl RandomNumbers {
    pub fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn number_between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.roll()
    }

    pub fn scale(&mut self, low: f64, high: f64) -> f64 {
        10f64.powf(self.number_between(low, high))
    }
}
