//! What a hydrodynamic database holds of one body: data only; the physics is in `hydro::database`.

use nalgebra::{Complex, Matrix6, Vector3};
use std::sync::Arc;
use windlass_base::span::Span;

/// Six complex amplitudes: of force (N) and moment (N m), or of translation (m) and rotation (rad).
pub type Amplitudes = [Complex<f64>; 6];

/// Radiation and diffraction of one floating body, as a program of potential flow computed them.
///
/// **Conventions**, to which every format is converted when it is read. Axes are those of the body, SI, radians. The wave is
/// `zeta = a cos(w t) = Re(a exp(-i w t))` at the reference point, of real amplitude a (m); what it causes is
/// `F(t) = Re(X a exp(-i w t))`, so a phase lag e is `X = |X| exp(i e)`. Headings are the direction the waves travel TOWARD, from the
/// body's x axis toward its y axis. A radiated force is `-A(w) acceleration - B(w) velocity`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Database {
    /// What it was read from, in words.
    pub source: String,
    /// The point the matrices and moments are about, and to which phases refer, in the body's axes (m).
    pub reference: Vector3<f64>,
    /// Frequencies (rad/s): finite, greater than zero, growing.
    pub frequencies: Vec<f64>,
    /// Added mass, one matrix a frequency (kg, kg m, kg m2); empty when the source has none.
    pub added_mass: Vec<Matrix6<f64>>,
    /// Damping by radiated waves, one matrix a frequency (N s/m, N s, N m s); empty when the source has none.
    pub damping: Vec<Matrix6<f64>>,
    /// Added mass at infinite frequency, as the source gives it.
    pub infinite: Option<Matrix6<f64>>,
    /// Added mass at zero frequency, as the source gives it.
    pub zero: Option<Matrix6<f64>>,
    /// Headings (rad) in [0, 2 pi), growing.
    pub headings: Vec<f64>,
    /// Excitation by heading, then frequency: force and moment over wave amplitude (N/m, N); empty when the source has none.
    pub excitation: Vec<Vec<Amplitudes>>,
    /// Motions in a free float by heading, then frequency: over wave amplitude (m/m, rad/m), of the reference point.
    pub motions: Option<Vec<Vec<Amplitudes>>>,
    /// Mean drift.
    pub drift: Option<DriftTable>,
    /// Slow drift of pairs of waves.
    pub qtf: Option<Qtf>,
    /// Hydrostatic stiffness about the reference point (N/m, N, N m), as the source gives it.
    pub hydrostatics: Option<Matrix6<f64>>,
    /// Density of the water it was computed for (kg/m3).
    pub density: f64,
    /// Gravity it was computed for (m/s2).
    pub gravity: f64,
    /// Depth of the water it was computed for (m); `None` for deep water.
    pub depth: Option<f64>,
    /// Mass or displaced mass of the body as the source gives it (kg).
    pub mass: Option<f64>,
    /// What the reader noticed: asymmetry, negative damping, gaps.
    pub remarks: Vec<String>,
}

/// Mean drift over the square of the wave amplitude (N/m2, N/m), about the reference point of its database.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DriftTable {
    /// Frequencies (rad/s), growing.
    pub frequencies: Vec<f64>,
    /// Headings (rad) in [0, 2 pi), growing, direction of travel.
    pub headings: Vec<f64>,
    /// By heading, then frequency.
    pub values: Vec<Vec<[f64; 6]>>,
}

/// Difference-frequency forces of pairs of waves of one heading: `F(t) = Re sum_ij Q_ij a_i conj(a_j) exp(-i (w_i - w_j) t)`
/// (N/m2, N/m), with `Q_ji = conj(Q_ij)`, about the reference point of its database.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Qtf {
    /// Frequencies (rad/s), growing.
    pub frequencies: Vec<f64>,
    /// Headings (rad) in [0, 2 pi), growing, direction of travel.
    pub headings: Vec<f64>,
    /// By heading, then frequency i, then frequency j.
    pub values: Vec<Vec<Vec<Amplitudes>>>,
}

/// How waves make slow drift.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DriftMethod {
    /// None.
    None,
    /// The mean only.
    Mean,
    /// Newman's approximation from the mean drift.
    #[default]
    Newman,
    /// The pairs of the QTF.
    Full,
}

/// A database on a body, and how it is used.
#[derive(Clone, Debug, PartialEq)]
pub struct AttachedDatabase {
    /// The database.
    pub data: Arc<Database>,
    /// Where the origin of its source stands in the body (m).
    pub at: [f64; 3],
    /// Memory of the radiation (s); `None` chooses it by the decay of the kernel.
    pub memory: Option<f64>,
    /// How waves make slow drift.
    pub drift: DriftMethod,
    /// Whether its hydrostatics are those of the body.
    pub hydrostatics: bool,
    /// Where it was given.
    pub span: Span,
}
