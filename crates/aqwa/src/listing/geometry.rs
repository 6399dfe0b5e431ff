//! Pages of decks 1 to 5: coordinates, elements, materials, geometries, the water, mass and inertia.

use super::{FIVE_FIGURES, THREE_DECIMALS, WHOLE, exponent, fact, format_fixed};
use crate::Deck;
use crate::elements::{ElementShape, StructureDeck, StructureElement};
use crate::properties::Geometry;
use windlass_base::table::{Column, Digits, Table};
use windlass_base::units::Dim;

const AXES: [&str; 3] = ["X", "Y", "Z"];
/// A product of inertia that is this small beside the largest moment is rounding.
const INERTIA_NOISE: f64 = 1e-12;

impl Deck {
    /// Coordinates, the elements of each structure, materials, geometries, global parameters, mass and inertia of each structure.
    pub(super) fn geometry_pages(&self) -> Vec<Table> {
        let mut list = vec![self.coordinates()];
        list.extend(self.structures.iter().map(topology));
        list.extend([self.material_table(), self.geometry_table(), self.global_table()]);
        list.extend(self.structures.iter().flat_map(|structure| self.mass_tables(structure)));
        list
    }

    fn coordinates(&self) -> Table {
        let nodes: Vec<_> = self.nodes.iter().enumerate().collect();
        Table::new("Coordinate Data")
            .with_rows(&nodes)
            .column("INPUT", "SEQUENCE", Dim::None, WHOLE, |(index, _)| index + 1)
            .column("NODE", "NO.", Dim::None, WHOLE, |(_, (number, _))| **number)
            .columns("", AXES, Dim::None, THREE_DECIMALS, |(_, (_, node))| node.position)
            .build()
    }

    fn material_table(&self) -> Table {
        let materials: Vec<_> = self.materials.iter().collect();
        Table::new("Material Properties")
            .with_rows(&materials)
            .column("MATERIAL GROUP", "NUMBER", Dim::None, WHOLE, |(number, _)| **number)
            .columns("", ["DENSITY/PARAM 1", "PARAM 2", "PARAM 3"], Dim::None, FIVE_FIGURES, |(_, material)| {
                material.properties.map(|field| field.value)
            })
            .build()
    }

    fn geometry_table(&self) -> Table {
        let geometries: Vec<(usize, &Geometry)> = self.geometries.values().enumerate().collect();
        let is_mass = |geometry: &Geometry| geometry.shape == ElementShape::PointMass;
        let mut columns = vec![
            Column::new("INPUT", "SEQUENCE", Dim::None, WHOLE, geometries.iter().map(|(index, _)| index + 1)),
            Column::new("GEOMETRY GROUP", "NO.", Dim::None, WHOLE, geometries.iter().map(|(_, g)| g.group)),
            Column::new("ELEMENT", "TYPE", Dim::None, WHOLE, geometries.iter().map(|(_, g)| g.shape.keyword())),
        ];
        for (index, name) in ["1", "2", "3", "4", "5", "6"].into_iter().enumerate() {
            // the listing has inertias in E format, the wall thickness with six decimals, and no sixth parameter but of PMAS
            let cell = |geometry: &Geometry| {
                let value = geometry.parameters.get(index).map_or(0.0, |field| field.value);
                match index {
                    _ if is_mass(geometry) => exponent(value, 4),
                    1 => format_fixed(value, 6),
                    5 => String::new(),
                    _ => format_fixed(value, 3),
                }
            };
            let cells = geometries.iter().map(|(_, geometry)| cell(geometry));
            columns.push(Column::right_aligned("GEOMETRIC PARAMETER NUMBER", name, cells));
        }
        let coefficient = |group: &str, name: &str, of: fn(&Geometry) -> f64| {
            let value = |geometry: &Geometry| if is_mass(geometry) { 0.0 } else { of(geometry) };
            Column::new(group, name, Dim::None, Digits::Decimals(2), geometries.iter().map(|(_, g)| value(g)))
        };
        columns.push(coefficient("DRAG COEFFICIENT", "C D", Geometry::drag));
        columns.push(coefficient("ADDED MASS COEFFICIENT", "C M", Geometry::added_mass));
        Table::from_columns("Geometric Properties", columns)
    }

    fn global_table(&self) -> Table {
        let global = &self.global;
        let table = fact(Table::new("Global Parameters"), "WATER  DEPTH", format_fixed(global.depth, 3));
        let table = fact(table, "DENSITY OF WATER", format_fixed(global.density, 3));
        fact(table, "ACCELERATION DUE TO GRAVITY", format_fixed(global.gravity, 3))
    }

    /// Masses by kind of element, then the centre of gravity with the matrix of inertia about it.
    fn mass_tables(&self, structure: &StructureDeck) -> [Table; 2] {
        let found = self.mass_properties(structure);
        let gravity = self.global.gravity;
        let mut rows: Vec<(&str, usize, f64)> =
            found.kinds.iter().map(|kind| (kind.shape.keyword(), kind.count, kind.mass)).collect();
        rows.push(("T O T A L", found.kinds.iter().map(|kind| kind.count).sum(), found.mass));
        let masses = Table::new(format!("Mass and Inertia Properties of Structure {}", structure.number))
            .with_rows(&rows)
            .column("ELEMENT", "TYPE", Dim::None, WHOLE, |(kind, _, _)| *kind)
            .column("NUMBER OF", "ELEMENTS", Dim::None, WHOLE, |(_, count, _)| *count)
            .column("", "MASS", Dim::None, FIVE_FIGURES, |(_, _, mass)| *mass)
            .column("", "WEIGHT", Dim::None, FIVE_FIGURES, |(_, _, mass)| mass * gravity)
            .build();
        let largest = found.inertia.iter().flatten().fold(0.0, |most: f64, value| most.max(value.abs()));
        let inertia = |value: f64| exponent(if value.abs() < INERTIA_NOISE * largest { 0.0 } else { value }, 3);
        let names = ["CENTRE OF GRAVITY", "INERTIA MATRIX", "", ""].map(String::from);
        let mut columns = vec![Column::new("", "", Dim::None, Digits::Usual, names)];
        for (axis, name) in AXES.into_iter().enumerate() {
            let centre = found.centre.get(axis).map_or(String::new(), |value| format_fixed(*value, 3));
            let column = found.inertia.iter().filter_map(|row| row.get(axis)).map(|value| inertia(*value));
            columns.push(Column::right_aligned("", name, std::iter::once(centre).chain(column)));
        }
        let title = format!("Centre of Gravity and Inertia of Structure {}", structure.number);
        [masses, Table::from_columns(title, columns)]
    }
}

fn topology(structure: &StructureDeck) -> Table {
    let elements: Vec<(usize, &StructureElement)> = structure.elements.iter().enumerate().collect();
    let mut table = Table::new(format!("Element Topology for Structure {}", structure.number))
        .with_rows(&elements)
        .column("ELEMENT", "NUMBER", Dim::None, WHOLE, |(index, _)| index + 1)
        .column("ELEMENT", "TYPE", Dim::None, WHOLE, |(_, element)| element.shape.keyword());
    // an element with fewer nodes is listed with 0 in their place
    for node in 0..4 {
        table = table
            .column("NODE", "NUMBER", Dim::None, WHOLE, |(_, element)| element.nodes.get(node).copied().unwrap_or(0));
    }
    table
        .column("MATERIAL", "NUMBER", Dim::None, WHOLE, |(_, element)| element.material)
        .column("GEOMETRY", "NUMBER", Dim::None, WHOLE, |(_, element)| element.geometry)
        .build()
}
