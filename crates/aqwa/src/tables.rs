//! The tables of the listing that show the data of decks 1 to 5, in the units of the deck.

use super::Deck;
use super::elements::{Shape, Structure};
use windlass_base::table::{Cell, Digits, Table, TableError};
use windlass_base::units::Dim;

const WHOLE: Digits = Digits::Decimals(0);
const PLACE: Digits = Digits::Decimals(3);
const FIVE: Digits = Digits::Scientific(5);

impl Deck {
    /// The tables of the listing for decks 1 to 5: coordinates, the elements of each structure, materials, geometries,
    /// global parameters, and mass and inertia of each structure.
    ///
    /// # Errors
    /// Never from a deck; [`TableError`] if a row did not fit its table.
    pub fn data_tables(&self) -> Result<Vec<Table>, TableError> {
        let mut list = vec![self.coordinates()?];
        for structure in &self.structures {
            list.push(topology(structure)?);
        }
        list.push(self.material_table()?);
        list.push(self.geometry_table()?);
        list.push(self.global_table());
        for structure in &self.structures {
            list.push(self.mass_table(structure)?);
        }
        Ok(list)
    }

    fn coordinates(&self) -> Result<Table, TableError> {
        let mut table = Table::new("Coordinate Data")
            .column("Input", "Sequence", Dim::None, WHOLE)
            .column("Node", "Number", Dim::None, WHOLE)
            .column("", "X", Dim::None, PLACE)
            .column("", "Y", Dim::None, PLACE)
            .column("", "Z", Dim::None, PLACE);
        for (index, (number, node)) in self.nodes.iter().enumerate() {
            let [x, y, z] = node.position;
            table.push(vec![(index + 1).into(), Cell::Integer(*number), x.into(), y.into(), z.into()])?;
        }
        Ok(table)
    }

    fn material_table(&self) -> Result<Table, TableError> {
        let mut table = Table::new("Material Properties")
            .column("Group", "Number", Dim::None, WHOLE)
            .column("", "Density/Param 1", Dim::None, FIVE)
            .column("", "Param 2", Dim::None, FIVE)
            .column("", "Param 3", Dim::None, FIVE);
        for (number, material) in &self.materials {
            let mut row = vec![Cell::Integer(*number)];
            row.extend(material.properties.map(|field| Cell::Number(field.value)));
            table.push(row)?;
        }
        Ok(table)
    }

    fn geometry_table(&self) -> Result<Table, TableError> {
        let mut table = Table::new("Geometric Properties")
            .column("Input", "Sequence", Dim::None, WHOLE)
            .column("Group", "Number", Dim::None, WHOLE)
            .column("Element", "Type", Dim::None, WHOLE);
        for name in ["1", "2", "3", "4", "5", "6"] {
            table = table.column("Geometric Parameter", name, Dim::None, FIVE);
        }
        table = table.column("Drag", "Cd", Dim::None, Digits::Decimals(2)).column(
            "Added Mass",
            "Cm",
            Dim::None,
            Digits::Decimals(2),
        );
        for (index, geometry) in self.geometries.values().enumerate() {
            let mut row: Vec<Cell> =
                vec![(index + 1).into(), Cell::Integer(geometry.group), geometry.shape.keyword().into()];
            row.extend(geometry.parameters.map(|field| Cell::Number(field.value)));
            let mass = geometry.shape == Shape::PointMass;
            row.push(Cell::Number(if mass { 0.0 } else { geometry.drag() }));
            row.push(Cell::Number(if mass { 0.0 } else { geometry.added_mass() }));
            table.push(row)?;
        }
        Ok(table)
    }

    fn global_table(&self) -> Table {
        Table::new("Global Parameters")
            .fact("Water Depth", self.global.depth, Dim::None)
            .fact("Density of Water", self.global.density, Dim::None)
            .fact("Acceleration due to Gravity", self.global.gravity, Dim::None)
    }

    fn mass_table(&self, structure: &Structure) -> Result<Table, TableError> {
        let found = self.mass_properties(structure);
        let gravity = self.global.gravity;
        let mut table = Table::new(format!("Mass and Inertia Properties of Structure {}", structure.number))
            .column("Element", "Type", Dim::None, WHOLE)
            .column("Number of", "Elements", Dim::None, WHOLE)
            .column("", "Mass", Dim::None, FIVE)
            .column("", "Weight", Dim::None, FIVE);
        for kind in &found.kinds {
            table.push(vec![
                kind.shape.keyword().into(),
                kind.count.into(),
                kind.mass.into(),
                (kind.mass * gravity).into(),
            ])?;
        }
        let count: usize = found.kinds.iter().map(|kind| kind.count).sum();
        table.push(vec!["Total".into(), count.into(), found.mass.into(), (found.mass * gravity).into()])?;
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
        Ok(table)
    }
}

fn topology(structure: &Structure) -> Result<Table, TableError> {
    let mut table = Table::new(format!("Element Topology for Structure {}", structure.number))
        .column("Element", "Number", Dim::None, WHOLE)
        .column("Element", "Type", Dim::None, WHOLE);
    for name in ["1", "2", "3", "4"] {
        table = table.column("Node Number", name, Dim::None, WHOLE);
    }
    table = table.column("Material", "Number", Dim::None, WHOLE).column("Geometry", "Number", Dim::None, WHOLE);
    for (index, element) in structure.elements.iter().enumerate() {
        let mut row: Vec<Cell> = vec![(index + 1).into(), element.shape.keyword().into()];
        row.extend((0..4).map(|k| Cell::Integer(element.nodes.get(k).copied().unwrap_or(0))));
        row.push(Cell::Integer(element.material));
        row.push(Cell::Integer(element.geometry));
        table.push(row)?;
    }
    Ok(table)
}
