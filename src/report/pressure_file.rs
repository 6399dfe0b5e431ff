//! What G_PRESSURE computed as NetCDF, in the layout of Capytaine's data sets, which xarray opens and DATABASE reads.
//!
//! Source: [CAPYTAINE-3 Outputs, Export outputs] for dimensions and names: `omega`, `radiating_dof`, `influenced_dof`, `wave_direction`, `complex`. The last
//! of `omega` is infinity, with the added mass alone, and of deep water the first is zero. What Capytaine has not, for bodies with axes of their own, stands on the dimensions
//! `body` and `xyz`: `rotation_center`, `body_axes`, `body_heading`, `mean_drift` and `near_field_drift`; `damping_lid` has the rectangles of damped surface.

use super::netcdf::{Shared, to_store_error};
use super::stored::{SOURCE, StoreError};
use nalgebra::{DMatrix, Matrix3, Vector3};
use netcdf3::{DataSet, FileWriter, Version};
use windlass_diffraction::{FrequencyForces, MOTIONS, Water};
use windlass_hydro::database::capytaine::DRIFT_METHOD;

/// Drift below this share of that of a wall as wide as a panel, which throws all of the waves back, is noise: as of waves that are far longer than the body.
const LEAST_REFLECTED: f64 = 1e-3;

/// Mean drift below which differences of its ways are noise, over the square of the wave amplitude (N/m2), for panels of a size (m).
pub fn least_drift(water: Water, panel_size: f64) -> f64 {
    LEAST_REFLECTED * 0.5 * water.density * water.gravity * panel_size
}

/// Names of the motions, as Capytaine has them.
const DOFS: [&str; MOTIONS] = ["Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw"];
/// The attribute that tells whether a file is of the same mesh and settings.
pub const KEY: &str = "windlass_key";

/// The attribute that tells why there is no mean drift.
pub const NO_DRIFT: &str = "mean_drift_missing";

/// A body of a file.
#[derive(Clone, Debug)]
pub struct FileBody {
    /// Its name.
    pub name: String,
    /// Its origin, about which forces and motions are (m).
    pub origin: Vector3<f64>,
    /// From the axes of the file to those of the body.
    pub axes: Matrix3<f64>,
    /// Its heading in the file (rad).
    pub heading: f64,
    /// Displaced mass (kg).
    pub mass: f64,
}

/// Mean drift of a frequency.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BodyDrift {
    /// By heading and body: surge, sway and yaw over the square of the wave amplitude, about the origin of the body (N/m2, N/m).
    pub values: Vec<Vec<[f64; 3]>>,
    /// The same by the pressure on the hulls.
    pub near: Vec<Vec<[f64; 3]>>,
    /// Of several bodies, heading by heading: the sum of their forces along x and y and of their moments about the vertical through the origin over the distance of
    /// the farthest body, and those by the waves far away (N/m2); none where both are not found apart from each other.
    pub sums: Vec<[[f64; 3]; 2]>,
}

/// What a file holds: along the axes of the first body's heading, z up from the water level, SI and radians.
#[derive(Clone, Debug)]
pub struct PressureFile<'a> {
    /// The bodies.
    pub bodies: &'a [FileBody],
    /// The water.
    pub water: Water,
    /// Size of the panels (m).
    pub panel_size: f64,
    /// The same at sharp edges and at the waterline (m), where some are refined.
    pub edge_size: Option<f64>,
    /// Where the waves go to (rad).
    pub headings: &'a [f64],
    /// Frequency by frequency.
    pub forces: &'a [FrequencyForces],
    /// Of each: largest difference of the damping from the energy of the waves far away, over the largest of its kind.
    pub energy: &'a [f64],
    /// Added mass at infinite frequency.
    pub infinite: &'a DMatrix<f64>,
    /// Added mass at the zero frequency, in deep water: that of heave has no limit elsewhere.
    pub zero: Option<&'a DMatrix<f64>>,
    /// Rectangles of damped surface: x and y of two corners (m), and the damping.
    pub lids: &'a [[f64; 5]],
    /// Mean drift, or why there is none.
    pub drift: Result<&'a [BodyDrift], &'a str>,
    /// Of a body alone: where its drift is largest, the number of the frequency, and the difference there of that by the waves far away from that by a
    /// control surface, over the largest.
    pub drift_check: Option<(usize, f64)>,
    /// How the mean drift of each body was found.
    pub drift_methods: &'a [String],
    /// What mesh and settings make it.
    pub key: &'a str,
}

impl PressureFile<'_> {
    /// The bytes of the file.
    ///
    /// # Errors
    /// What the writer refuses.
    pub fn bytes(&self) -> Result<Vec<u8>, StoreError> {
        let alone = self.bodies.len() == 1;
        let name = |body: &FileBody, dof: &str| if alone { dof.to_owned() } else { format!("{}__{dof}", body.name) };
        let dofs: Vec<String> =
            self.bodies.iter().flat_map(|body| DOFS.iter().map(move |dof| name(body, dof))).collect();
        let width = dofs.iter().map(String::len).max().unwrap_or(1);
        let letters: Vec<u8> = dofs.iter().flat_map(|dof| padded(dof, width)).collect();
        let count = dofs.len();
        let mut made = Writer::new(&self.title(), self.key)?;
        for (dimension, size) in [
            ("omega", self.forces.len() + 1 + usize::from(self.zero.is_some())),
            ("radiating_dof", count),
            ("influenced_dof", count),
            ("dof_name", width),
            ("wave_direction", self.headings.len()),
            ("complex", 2),
            ("complex_name", 2),
            ("body", self.bodies.len()),
            ("xyz", 3),
            ("component", 3),
            ("frequency", self.forces.len()),
        ] {
            made.set.add_fixed_dim(dimension, size).map_err(to_store_error)?;
        }
        if !self.lids.is_empty() {
            made.set.add_fixed_dim("lid", self.lids.len()).map_err(to_store_error)?;
            made.set.add_fixed_dim("lid_value", 5).map_err(to_store_error)?;
            let text = "rectangles of damped surface: x and y of two corners, and epsilon of d phi/dz = nu (1 + i epsilon) phi";
            made.numbers("damping_lid", &["lid", "lid_value"], "m, 1", text, self.lids.concat())?;
        }
        let first = self.zero.map(|_| 0.0);
        let between = self.forces.iter().map(|forces| forces.frequency);
        let omega: Vec<f64> = first.into_iter().chain(between).chain([f64::INFINITY]).collect();
        let text = "frequency; the last is infinity, and of deep water the first is zero";
        made.numbers("omega", &["omega"], "rad/s", text, omega)?;
        for dimension in ["radiating_dof", "influenced_dof"] {
            made.letters(dimension, &[dimension, "dof_name"], letters.clone())?;
        }
        made.letters("complex", &["complex", "complex_name"], b"reim".to_vec())?;
        made.numbers("wave_direction", &["wave_direction"], "rad", "where the waves go to", self.headings.to_vec())?;
        let matrices = |first: Option<&DMatrix<f64>>,
                        of: &dyn Fn(&FrequencyForces) -> &DMatrix<f64>,
                        last: &DMatrix<f64>|
         -> Vec<f64> {
            let all = first.into_iter().chain(self.forces.iter().map(of)).chain([last]);
            // the radiating motion is the column
            all.flat_map(|matrix| matrix.iter().copied()).collect()
        };
        let places = ["omega", "radiating_dof", "influenced_dof"];
        let added = matrices(self.zero, &|forces| &forces.added_mass, self.infinite);
        made.numbers("added_mass", &places, "kg, kg m, kg m2", "added mass", added)?;
        let none = DMatrix::zeros(count, count);
        let damping = matrices(self.zero.map(|_| &none), &|forces| &forces.damping, &none);
        made.numbers("radiation_damping", &places, "N s/m, N s, N m s", "radiation damping", damping)?;
        for (name, text, of) in [
            (
                "excitation_force",
                "exciting force for an amplitude of 1 m, by Haskind's relation",
                &(|forces: &FrequencyForces| forces.excitation.clone()) as &dyn Fn(&FrequencyForces) -> _,
            ),
            ("pressure_force", "the same by the pressure on the hull", &|forces| forces.pressure_excitation.clone()),
        ] {
            let all: Vec<_> = self.forces.iter().map(of).collect();
            let missing = || std::iter::repeat_n(f64::NAN, self.headings.len() * count);
            let before = || self.zero.into_iter().flat_map(|_| missing());
            let re = before().chain(all.iter().flatten().flatten().map(|value| value.re)).chain(missing());
            let im = before().chain(all.iter().flatten().flatten().map(|value| value.im)).chain(missing());
            let values = re.chain(im).collect();
            made.numbers(name, &["complex", "omega", "wave_direction", "influenced_dof"], "N/m, N", text, values)?;
        }
        let products = self.forces.iter().map(|forces| forces.iterations as f64).collect();
        made.numbers(
            "products",
            &["frequency"],
            "1",
            "products of the matrix until the equations were solved",
            products,
        )?;
        let points = |of: &dyn Fn(&FileBody) -> Vec<f64>| self.bodies.iter().flat_map(of).collect::<Vec<f64>>();
        let origins = points(&|body| body.origin.iter().copied().collect());
        made.numbers("rotation_center", &["body", "xyz"], "m", "origins of motions and moments", origins)?;
        let axes = points(&|body| body.axes.transpose().iter().copied().collect());
        made.numbers(
            "body_axes",
            &["body", "xyz", "component"],
            "1",
            "from the axes of the file to those of the body",
            axes,
        )?;
        made.numbers("body_heading", &["body"], "rad", "heading of the body", points(&|body| vec![body.heading]))?;
        made.numbers("disp_mass", &["body"], "kg", "displaced mass", points(&|body| vec![body.mass]))?;
        let text =
            "largest difference of the damping from the energy of the waves far away, over the largest of its kind";
        made.numbers("energy_difference", &["frequency"], "1", text, self.energy.to_vec())?;
        let asymmetry = self.forces.iter().map(|forces| forces.asymmetry).collect();
        let text = "largest difference of added mass and damping from their transposes, over the largest of their kind";
        made.numbers("asymmetry", &["frequency"], "1", text, asymmetry)?;
        match self.drift {
            Ok(drift) => {
                let values = drift.iter().flat_map(|own| own.values.iter().flatten().flatten()).copied().collect();
                let places = ["frequency", "wave_direction", "body", "component"];
                made.numbers("mean_drift", &places, "N/m2, N/m", "mean drift in surge, sway and yaw", values)?;
                let near = drift.iter().flat_map(|own| own.near.iter().flatten().flatten()).copied().collect();
                let text = "the same by the pressure on the hulls";
                made.numbers("near_field_drift", &places, "N/m2, N/m", text, near)?;
                let text = "largest difference of the drift of a body by the pressure on its hull from its mean drift, over the largest force of that body";
                made.numbers("near_field_difference", &["frequency"], "1", text, near_differences(drift))?;
                made.set.add_global_attr_string(DRIFT_METHOD, self.drift_methods.join("\n")).map_err(to_store_error)?;
                if alone {
                    let checked =
                        |i: usize| self.drift_check.filter(|(at, _)| *at == i).map_or(f64::NAN, |(_, off)| off);
                    let text = "largest difference of the drift by a control surface from that far away, over the largest, where that is";
                    let differences = (0..self.forces.len()).map(checked).collect();
                    made.numbers("drift_difference", &["frequency"], "1", text, differences)?;
                } else if drift.iter().any(|own| !own.sums.is_empty()) {
                    let text = "largest difference of the sum of the bodies' drift, forces and moments over the distance of the bodies, from that far away, over the largest force";
                    made.numbers(
                        "drift_difference",
                        &["frequency"],
                        "1",
                        text,
                        drift_differences(drift, least_drift(self.water, self.panel_size)),
                    )?;
                }
            }
            Err(why) => made.set.add_global_attr_string(NO_DRIFT, why).map_err(to_store_error)?,
        }
        let edge_size = self.edge_size.unwrap_or(self.panel_size);
        for (name, unit, text, value) in [
            ("rho", "kg/m3", "density", self.water.density),
            ("g", "m/s2", "gravity", self.water.gravity),
            ("water_depth", "m", "depth; infinity is deep water", self.water.depth.unwrap_or(f64::INFINITY)),
            ("forward_speed", "m/s", "forward speed", 0.0),
            ("panel_size", "m", "size of the panels", self.panel_size),
            ("edge_panel_size", "m", "size of the panels at sharp edges and at the waterline", edge_size),
        ] {
            made.numbers(name, &[], unit, text, vec![value])?;
        }
        made.finish()
    }

    fn title(&self) -> String {
        let names: Vec<&str> = self.bodies.iter().map(|body| body.name.as_str()).collect();
        format!("G_PRESSURE of {}", names.join(", "))
    }
}

/// Frequency by frequency: the largest difference of the force by the pressure on a hull, over the largest force on that body of all.
fn near_differences(drift: &[BodyDrift]) -> Vec<f64> {
    let bodies = drift.iter().flat_map(|own| &own.values).map(Vec::len).max().unwrap_or(0);
    let largest: Vec<f64> = (0..bodies)
        .map(|body| {
            let of_body = drift.iter().flat_map(|own| &own.values).filter_map(|list| list.get(body));
            of_body.map(|[x, y, _]| x.hypot(*y)).fold(0.0, f64::max)
        })
        .collect();
    let of = |own: &BodyDrift| {
        let pairs = own.values.iter().zip(&own.near).flat_map(|(one, other)| one.iter().zip(other).zip(&largest));
        let shares = pairs.filter(|(_, largest)| **largest > 0.0);
        shares.map(|((a, b), largest)| (a[0] - b[0]).hypot(a[1] - b[1]) / largest).fold(0.0, f64::max)
    };
    drift.iter().map(of).collect()
}

/// Frequency by frequency, over the largest force of all; zero where that is less than what is noise (N/m2).
fn drift_differences(drift: &[BodyDrift], least: f64) -> Vec<f64> {
    let largest = drift.iter().flat_map(|own| &own.sums).map(|[_, far]| far[0].hypot(far[1])).fold(0.0, f64::max);
    let of = |own: &BodyDrift| {
        let differ = |[sum, far]: &[[f64; 3]; 2]| {
            let [x, y, moment] = [0, 1, 2].map(|i| sum[i] - far[i]);
            x.hypot(y).max(moment.abs())
        };
        let off = own.sums.iter().map(differ);
        if largest > least { off.fold(0.0, f64::max) / largest } else { 0.0 }
    };
    drift.iter().map(of).collect()
}

/// A word filled up with zeros.
fn padded(word: &str, width: usize) -> impl Iterator<Item = u8> + '_ {
    word.bytes().chain(std::iter::repeat(0)).take(width)
}

/// Values of a variable.
enum Values {
    Numbers(Vec<f64>),
    Letters(Vec<u8>),
}

/// A file being made.
struct Writer {
    set: DataSet,
    values: Vec<(String, Values)>,
}

impl Writer {
    fn new(title: &str, key: &str) -> Result<Self, StoreError> {
        let mut set = DataSet::new();
        for (name, text) in [("title", title), ("source", SOURCE), (KEY, key)] {
            set.add_global_attr_string(name, text).map_err(to_store_error)?;
        }
        Ok(Writer { set, values: Vec::new() })
    }

    fn numbers(
        &mut self,
        name: &str,
        dimensions: &[&str],
        unit: &str,
        text: &str,
        values: Vec<f64>,
    ) -> Result<(), StoreError> {
        self.set.add_var_f64(name, dimensions).map_err(to_store_error)?;
        self.set.add_var_attr_string(name, "units", unit).map_err(to_store_error)?;
        self.set.add_var_attr_string(name, "long_name", text).map_err(to_store_error)?;
        self.values.push((name.to_owned(), Values::Numbers(values)));
        Ok(())
    }

    fn letters(&mut self, name: &str, dimensions: &[&str], values: Vec<u8>) -> Result<(), StoreError> {
        self.set.add_var_u8(name, dimensions).map_err(to_store_error)?;
        // by this xarray, and Capytaine with it, takes letters for text
        self.set.add_var_attr_string(name, "_Encoding", "utf-8").map_err(to_store_error)?;
        self.values.push((name.to_owned(), Values::Letters(values)));
        Ok(())
    }

    fn finish(self) -> Result<Vec<u8>, StoreError> {
        let shared = Shared::default();
        let mut writer = FileWriter::open_seek_write("", Box::new(shared.clone())).map_err(to_store_error)?;
        writer.set_def(&self.set, Version::Offset64Bit, 0).map_err(to_store_error)?;
        for (name, values) in &self.values {
            match values {
                Values::Numbers(list) => writer.write_var_f64(name, list),
                Values::Letters(list) => writer.write_var_u8(name, list),
            }
            .map_err(to_store_error)?;
        }
        writer.close().map_err(to_store_error)?;
        Ok(shared.into_bytes())
    }
}
