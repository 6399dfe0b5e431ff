//! The tables of the listing that show the data of decks 1 to 5, in the units of the deck.

use super::Deck;
use super::elements::{ElementShape, StructureDeck, StructureElement};
use super::properties::Geometry;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;

const NO_DECIMALS: Digits = Digits::Decimals(0);
const PLACE: Digits = Digits::Decimals(3);
const FIVE: Digits = Digits::Scientific(5);

impl Deck {
    /// The tables of the listing for decks 1 to 5: coordinates, the elements of each structure, materials, geometries,
    /// global parameters, and mass and inertia of each structure.
    pub fn data_tables(&self) -> Vec<Table> {
        let mut list = vec![self.coordinates()];
        list.extend(self.structures.iter().map(topology));
        list.extend([self.material_table(), self.geometry_table(), self.global_table()]);
        list.extend(self.structures.iter().map(|structure| self.mass_table(structure)));
        list
    }

    fn coordinates(&self) -> Table {
        let nodes: Vec<_> = self.nodes.iter().enumerate().collect();
        Table::new("Coordinate Data")
            .with_rows(&nodes)
            .column("Input", "Sequence", Dim::None, NO_DECIMALS, |(index, _)| index + 1)
            .column("Node", "Number", Dim::None, NO_DECIMALS, |(_, (number, _))| **number)
            .columns("", ["X", "Y", "Z"], Dim::None, PLACE, |(_, (_, node))| node.position)
            .build()
    }

    fn material_table(&self) -> Table {
        let materials: Vec<_> = self.materials.iter().collect();
        Table::new("Material Properties")
            .with_rows(&materials)
            .column("Group", "Number", Dim::None, NO_DECIMALS, |(number, _)| **number)
            .columns("", ["Density/Param 1", "Param 2", "Param 3"], Dim::None, FIVE, |(_, material)| {
                material.properties.map(|field| field.value)
            })
            .build()
    }

    fn geometry_table(&self) -> Table {
        let geometries: Vec<_> = self.geometries.values().enumerate().collect();
        let is_mass = |geometry: &Geometry| geometry.shape == ElementShape::PointMass;
        Table::new("Geometric Properties")
            .with_rows(&geometries)
            .column("Input", "Sequence", Dim::None, NO_DECIMALS, |(index, _)| index + 1)
            .column("Group", "Number", Dim::None, NO_DECIMALS, |(_, geometry)| geometry.group)
            .column("Element", "Type", Dim::None, NO_DECIMALS, |(_, geometry)| geometry.shape.keyword())
            .columns("Geometric Parameter", ["1", "2", "3", "4", "5", "6"], Dim::None, FIVE, |(_, geometry)| {
                geometry.parameters.map(|field| field.value)
            })
            .column(
                "Drag",
                "Cd",
                Dim::None,
                Digits::Decimals(2),
                |(_, geometry)| {
                    if is_mass(geometry) { 0.0 } else { geometry.drag() }
                },
            )
            .column("Added Mass", "Cm", Dim::None, Digits::Decimals(2), |(_, geometry)| {
                if is_mass(geometry) { 0.0 } else { geometry.added_mass() }
            })
            .build()
    }

    fn global_table(&self) -> Table {
        Table::new("Global Parameters")
            .fact("Water Depth", self.global.depth, Dim::None)
            .fact("Density of Water", self.global.density, Dim::None)
            .fact("Acceleration due to Gravity", self.global.gravity, Dim::None)
    }

    fn mass_table(&self, structure: &StructureDeck) -> Table {
        let found = self.mass_properties(structure);
        let gravity = self.global.gravity;
        let mut rows: Vec<(&str, usize, f64)> =
            found.kinds.iter().map(|kind| (kind.shape.keyword(), kind.count, kind.mass)).collect();
        rows.push(("Total", found.kinds.iter().map(|kind| kind.count).sum(), found.mass));
        let mut table = Table::new(format!("Mass and Inertia Properties of Structure {}", structure.number))
            .with_rows(&rows)
            .column("Element", "Type", Dim::None, NO_DECIMALS, |(kind, _, _)| *kind)
            .column("Number of", "Elements", Dim::None, NO_DECIMALS, |(_, count, _)| *count)
            .column("", "Mass", Dim::None, FIVE, |(_, _, mass)| *mass)
            .column("", "Weight", Dim::None, FIVE, |(_, _, mass)| mass * gravity)
            .build();
        for (name, value) in ["X", "Y", "Z"].into_iter().zip(found.centre) {
            table = table.fact(&format!("Centre of Gravity {name}"), value, Dim::None);
        }
        let axes = ["X", "Y", "Z"];
        for (i, row) in found.inertia.iter().enumerate() {
            for (j, value) in row.iter().enumerate().skip(i) {
                let name = format!("Inertia {}{}", axes.get(i).unwrap_or(&""), axes.get(j).unwrap_or(&""));
                table = table.fact(&name, *value, Dim::None);
            }
        }
        table
    }
}

fn topology(structure: &StructureDeck) -> Table {
    let elements: Vec<(usize, &StructureElement)> = structure.elements.iter().enumerate().collect();
    Table::new(format!("Element Topology for Structure {}", structure.number))
        .with_rows(&elements)
        .column("Element", "Number", Dim::None, NO_DECIMALS, |(index, _)| index + 1)
        .column("Element", "Type", Dim::None, NO_DECIMALS, |(_, element)| element.shape.keyword())
        .columns("Node Number", ["1", "2", "3", "4"], Dim::None, NO_DECIMALS, |(_, element)| {
            // an element with fewer nodes is listed with 0 in their place
            [0, 1, 2, 3].map(|k| element.nodes.get(k).copied().unwrap_or(0))
        })
        .column("Material", "Number", Dim::None, NO_DECIMALS, |(_, element)| element.material)
        .column("Geometry", "Number", Dim::None, NO_DECIMALS, |(_, element)| element.geometry)
        .build()
}
