//! The hull of a structure by its panels QPPL and TPPL: mirrored by SYMX and SYMY, checked, and closed above the water.
//!
//! The nodes of a panel run counter-clockwise as seen from the water. Panels with DIFF lie below the water line (ZLWL), those without above it. A hull
//! that ends in the water line has upright walls above it, so that its stiffness is that of its water plane; one that ends above it is closed there.
//!
//! Source: [AQWA-REF deck 2] for the cards; sides and nodes of panels by decks of [BEMROSETTA-AQWA].

use super::Deck;
use super::elements::{StructureDeck, StructureElement};
use super::remarks::Remarks;
use nalgebra::Vector3;
use std::collections::HashMap;
use windlass_base::diagnostic::Diagnostic;
use windlass_base::span::Span;

/// Nodes nearer than this share of the size of the hull are one: cards have six digits or more.
const JOIN_SHARE: f64 = 1e-6;
/// Nodes within this share of the size of the hull of the water line are in it: cards of a cut hull often keep four digits.
const WATERLINE_SHARE: f64 = 1e-4;
/// Longest ring that is closed by one panel: a panel of the language has at most 256 corners.
const LONGEST_RING: usize = 250;
/// Most panels that are named of one fault.
const MOST_NAMED: usize = 5;

/// A corner of panels, in the units and axes of deck 1.
#[derive(Clone, Debug, PartialEq)]
pub struct HullVertex {
    /// The number of its node; with `X`, `Y` or `XY` behind it where it is mirrored, with `W` above the water line.
    pub name: String,
    /// Where it is.
    pub position: [f64; 3],
    /// The card of its node.
    pub span: Span,
}

/// A panel of a hull, counter-clockwise as seen from outside.
#[derive(Clone, Debug, PartialEq)]
pub struct HullPanel {
    /// Its corners, as indices of the vertices.
    pub corners: Vec<usize>,
    /// The keyword of its card; none of what closes the hull.
    pub keyword: Option<&'static str>,
    /// The card, or the header of the structure.
    pub span: Span,
}

/// The hull of a structure, closed.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct DeckHull {
    /// The corners of its panels.
    pub vertices: Vec<HullVertex>,
    /// Those of the cards with their mirror images, then those that close it.
    pub panels: Vec<HullPanel>,
    /// Displaced volume below the water line, in the units of the deck.
    pub volume: f64,
    /// Whether walls were added above the water line.
    pub has_walls: bool,
}

/// Vertices by place, so that one that is near another is that one.
struct JoinedVertices {
    list: Vec<HullVertex>,
    cells: HashMap<[i64; 3], Vec<usize>>,
    room: f64,
}

impl JoinedVertices {
    fn new(room: f64) -> Self {
        JoinedVertices { list: Vec::new(), cells: HashMap::new(), room }
    }

    fn add(&mut self, vertex: HullVertex) -> usize {
        let cell = vertex.position.map(|x| (x / self.room).floor() as i64);
        for dx in -1..=1 {
            for dy in -1..=1 {
                for dz in -1..=1 {
                    let near = [cell[0] + dx, cell[1] + dy, cell[2] + dz];
                    let found = self.cells.get(&near).into_iter().flatten().find(|index| {
                        let other = self.list.get(**index).map_or([f64::INFINITY; 3], |other| other.position);
                        (Vector3::from(other) - Vector3::from(vertex.position)).norm() <= self.room
                    });
                    if let Some(index) = found {
                        return *index;
                    }
                }
            }
        }
        self.cells.entry(cell).or_default().push(self.list.len());
        self.list.push(vertex);
        self.list.len() - 1
    }
}

/// A hull as its cards give it, open or not, with what is known of it.
struct RawHull {
    vertices: Vec<HullVertex>,
    /// Panels with whether they have DIFF.
    panels: Vec<(HullPanel, bool)>,
    waterline: f64,
    /// How far from the water line a corner may be and lie in it.
    room: f64,
}

/// Sides of panels by their ends, the lower index first: panels, and whether each runs along the side from the lower index.
type Sides = HashMap<[usize; 2], Vec<(usize, bool)>>;

impl RawHull {
    /// That of a structure; none where it has no panels or one of their nodes is missing.
    fn new(deck: &Deck, structure: &StructureDeck) -> Option<Self> {
        let elements: Vec<&StructureElement> = structure.hull_elements().collect();
        let nodes: Vec<[f64; 3]> = elements
            .iter()
            .flat_map(|element| &element.nodes)
            .map(|node| deck.nodes.get(node).map(|node| node.position))
            .collect::<Option<_>>()?;
        let first = *nodes.first()?;
        let reach = |axis: usize| {
            let of = |pick: fn(f64, f64) -> f64| nodes.iter().fold(first[axis], |most, at| pick(most, at[axis]));
            of(f64::max) - of(f64::min)
        };
        let size = (0..3).map(reach).fold(0.0, f64::max);
        if size <= 0.0 {
            return None;
        }
        let mut joined = JoinedVertices::new(JOIN_SHARE * size);
        let mut panels = Vec::new();
        let [over_y, over_x] = structure.mirrors.map(|card| card.is_some());
        let signs = |mirrored: bool| if mirrored { &[1.0, -1.0][..] } else { &[1.0][..] };
        for x in signs(over_x) {
            for y in signs(over_y) {
                for element in &elements {
                    let mut corners: Vec<usize> = Vec::new();
                    for number in &element.nodes {
                        let node = deck.nodes.get(number)?;
                        let [at_x, at_y, at_z] = node.position;
                        let side = match (*x < 0.0, *y < 0.0) {
                            (false, false) => "",
                            (true, false) => "X",
                            (false, true) => "Y",
                            (true, true) => "XY",
                        };
                        let position = [x * at_x, y * at_y, at_z];
                        corners.push(joined.add(HullVertex {
                            name: format!("{number}{side}"),
                            position,
                            span: node.span,
                        }));
                    }
                    if x * y < 0.0 {
                        corners.reverse();
                    }
                    // a corner that is given twice makes a triangle of a panel of four
                    corners.dedup();
                    if corners.len() > 1 && corners.first() == corners.last() {
                        corners.pop();
                    }
                    let panel = HullPanel { corners, keyword: Some(element.shape.keyword()), span: element.span };
                    panels.push((panel, element.is_diffracting));
                }
            }
        }
        let waterline = structure.waterline.map_or(0.0, |(height, _)| height);
        Some(RawHull { vertices: joined.list, panels, waterline, room: WATERLINE_SHARE * size })
    }

    /// A corner with its height above the water line.
    fn corner(&self, index: usize) -> Vector3<f64> {
        let [x, y, z] = self.vertices.get(index).map_or([0.0; 3], |vertex| vertex.position);
        Vector3::new(x, y, z - self.waterline)
    }

    fn corners(&self, panel: &HullPanel) -> Vec<Vector3<f64>> {
        panel.corners.iter().map(|index| self.corner(*index)).collect()
    }

    fn name(&self, index: usize) -> &str {
        self.vertices.get(index).map_or("", |vertex| vertex.name.as_str())
    }

    fn sides(&self) -> Sides {
        let mut sides = Sides::new();
        for (number, (panel, _)) in self.panels.iter().enumerate() {
            let next = panel.corners.iter().cycle().skip(1);
            for (a, b) in panel.corners.iter().zip(next) {
                sides.entry([*a.min(b), *a.max(b)]).or_default().push((number, a < b));
            }
        }
        sides
    }

    /// Sides of one panel alone at or above the water line, each as the panel runs along it.
    fn rim(&self, sides: &Sides) -> Vec<[usize; 2]> {
        let mut rim: Vec<[usize; 2]> = sides
            .iter()
            .filter(|(ends, panels)| panels.len() == 1 && self.is_dry(**ends))
            .filter_map(|(ends, panels)| {
                let (_, along) = panels.first()?;
                let [a, b] = *ends;
                Some(if *along { [a, b] } else { [b, a] })
            })
            .collect();
        rim.sort_unstable();
        rim
    }

    /// Whether a side lies at or above the water line.
    fn is_dry(&self, ends: [usize; 2]) -> bool {
        ends.iter().all(|index| self.corner(*index).z >= -self.room)
    }

    /// Of each panel whether it faces into the hull: panels that share a side run along it both ways, and the parts that hang together displace water.
    fn turned(&self, sides: &Sides) -> Vec<bool> {
        let mut neighbours: Vec<Vec<(usize, bool)>> = vec![Vec::new(); self.panels.len()];
        for panels in sides.values() {
            if let [(a, one), (b, other)] = panels.as_slice() {
                for (from, to) in [(*a, *b), (*b, *a)] {
                    if let Some(list) = neighbours.get_mut(from) {
                        list.push((to, one == other));
                    }
                }
            }
        }
        let mut turned: Vec<Option<bool>> = vec![None; self.panels.len()];
        for seed in 0..self.panels.len() {
            if turned.get(seed).is_none_or(Option::is_some) {
                continue;
            }
            let (mut part, mut open) = (Vec::new(), vec![(seed, false)]);
            while let Some((panel, is_turned)) = open.pop() {
                match turned.get_mut(panel) {
                    Some(known @ None) => *known = Some(is_turned),
                    _ => continue,
                }
                part.push(panel);
                let next = neighbours.get(panel).into_iter().flatten();
                open.extend(next.map(|(other, differs)| (*other, is_turned != *differs)));
            }
            let own = |panel: &usize| {
                let volume = self.panels.get(*panel).map_or(0.0, |(panel, _)| wet_volume(&self.corners(panel)));
                if turned.get(*panel).copied().flatten() == Some(true) { -volume } else { volume }
            };
            if part.iter().map(own).sum::<f64>() < 0.0 {
                for panel in part {
                    if let Some(Some(known)) = turned.get_mut(panel) {
                        *known = !*known;
                    }
                }
            }
        }
        turned.into_iter().map(|known| known == Some(true)).collect()
    }
}

/// What a panel below the water line adds to the displaced volume, by the divergence of (0, 0, z).
fn wet_volume(corners: &[Vector3<f64>]) -> f64 {
    let mut wet: Vec<Vector3<f64>> = Vec::new();
    let next = corners.iter().cycle().skip(1);
    for (a, b) in corners.iter().zip(next) {
        if a.z <= 0.0 {
            wet.push(*a);
        }
        if (a.z < 0.0) != (b.z < 0.0) && a.z != b.z {
            wet.push(a + (b - a) * (a.z / (a.z - b.z)));
        }
    }
    let Some((first, rest)) = wet.split_first() else { return 0.0 };
    let triangle =
        |b: &Vector3<f64>, c: &Vector3<f64>| 0.5 * (b - first).cross(&(c - first)).z * (first.z + b.z + c.z) / 3.0;
    rest.windows(2).map(|pair| if let [b, c] = pair { triangle(b, c) } else { 0.0 }).sum()
}

/// Area of a panel.
fn area(corners: &[Vector3<f64>]) -> f64 {
    let Some((first, rest)) = corners.split_first() else { return 0.0 };
    let sum: Vector3<f64> = rest
        .windows(2)
        .map(|pair| if let [b, c] = pair { (b - first).cross(&(c - first)) } else { Vector3::zeros() })
        .sum();
    0.5 * sum.norm()
}

impl Deck {
    /// The hull of a structure by its panels, closed above the water; none of a structure without panels.
    pub fn hull(&self, structure: &StructureDeck) -> Option<DeckHull> {
        let raw = RawHull::new(self, structure)?;
        let sides = raw.sides();
        let rim = raw.rim(&sides);
        let volume = raw.panels.iter().map(|(panel, _)| wet_volume(&raw.corners(panel))).sum();
        let draught = (0..raw.vertices.len()).map(|index| -raw.corner(index).z).fold(0.0, f64::max);
        let mut made = DeckHull {
            panels: raw.panels.iter().map(|(panel, _)| panel.clone()).collect(),
            vertices: raw.vertices.clone(),
            volume,
            has_walls: false,
        };
        let mut after: HashMap<usize, usize> = rim.iter().map(|[a, b]| (*b, *a)).collect();
        let mut starts: Vec<usize> = after.keys().copied().collect();
        starts.sort_unstable();
        for start in starts {
            let mut ring = Vec::new();
            let mut at = start;
            while let Some(next) = after.remove(&at) {
                ring.push(at);
                at = next;
            }
            if ring.len() < 3 {
                continue;
            }
            let ends_in_water = ring.iter().all(|index| raw.corner(*index).z.abs() <= raw.room);
            made.close(&ring, ends_in_water.then_some(draught), structure.span);
        }
        Some(made)
    }
}

impl DeckHull {
    /// Closes a ring, counter-clockwise about the hull as seen from above, by walls of a height and a plane, or by a plane alone.
    fn close(&mut self, ring: &[usize], walls: Option<f64>, span: Span) {
        let panel = |corners: Vec<usize>| HullPanel { corners, keyword: None, span };
        let Some(height) = walls else {
            self.cover(ring, span);
            return;
        };
        self.has_walls = true;
        let mut upper = Vec::new();
        for index in ring {
            let Some(below) = self.vertices.get(*index).cloned() else { return };
            let [x, y, z] = below.position;
            upper.push(self.vertices.len());
            let name = format!("{}W", below.name);
            self.vertices.push(HullVertex { name, position: [x, y, z + height], span: below.span });
        }
        let next = ring.iter().zip(&upper).cycle().skip(1);
        for ((a, above_a), (b, above_b)) in ring.iter().zip(&upper).zip(next) {
            self.panels.push(panel(vec![*a, *b, *above_b, *above_a]));
        }
        self.cover(&upper, span);
    }

    /// Closes a ring by a plane: one panel, or triangles about its middle.
    fn cover(&mut self, ring: &[usize], span: Span) {
        if ring.len() <= LONGEST_RING {
            self.panels.push(HullPanel { corners: ring.to_vec(), keyword: None, span });
            return;
        }
        let corners: Vec<Vector3<f64>> =
            ring.iter().filter_map(|index| self.vertices.get(*index)).map(|vertex| vertex.position.into()).collect();
        let middle = corners.iter().sum::<Vector3<f64>>() / corners.len().max(1) as f64;
        let centre = self.vertices.len();
        self.vertices.push(HullVertex { name: format!("C{centre}"), position: middle.into(), span });
        let next = ring.iter().cycle().skip(1);
        let triangles = ring.iter().zip(next).map(|(a, b)| vec![*a, *b, centre]);
        self.panels.extend(triangles.map(|corners| HullPanel { corners, keyword: None, span }));
    }
}

/// Checks the panels of the structures whose hull they are.
pub fn check(deck: &Deck, remarks: &mut Remarks) {
    for structure in &deck.structures {
        if deck.database(structure).is_none()
            && let Some(hull) = RawHull::new(deck, structure)
        {
            check_hull(&hull, structure, remarks);
        }
    }
}

/// Faults of one kind: the first are named each, the others are counted with the last of these.
struct NamedFaults {
    list: Vec<(Span, Box<Diagnostic>)>,
    count: usize,
}

impl NamedFaults {
    fn new() -> Self {
        NamedFaults { list: Vec::new(), count: 0 }
    }

    /// A fault of a card; the mirror images of its panel have it too, and are not named.
    fn add(&mut self, span: Span, said: impl FnOnce() -> Box<Diagnostic>) {
        if self.list.iter().any(|(other, _)| *other == span) {
            return;
        }
        self.count += 1;
        if self.list.len() < MOST_NAMED {
            self.list.push((span, said()));
        }
    }

    fn tell(self, remarks: &mut Remarks) {
        let more = self.count.saturating_sub(self.list.len());
        let last = self.list.len();
        for (number, (_, said)) in self.list.into_iter().enumerate() {
            let is_last = number + 1 == last && more > 0;
            remarks.add(if is_last { said.help(format!("{more} more panels of this structure are so")) } else { said });
        }
    }
}

fn check_hull(hull: &RawHull, structure: &StructureDeck, remarks: &mut Remarks) {
    let [mut flat, mut above, mut below, mut open, mut crowded, mut inward] =
        std::array::from_fn(|_| NamedFaults::new());
    let card = |panel: &HullPanel| format!("deck 2, {}, columns 21-80", panel.keyword.unwrap_or_default());
    let nodes = |panel: &HullPanel| -> String {
        panel.corners.iter().map(|index| hull.name(*index)).collect::<Vec<_>>().join(" ")
    };
    for (panel, is_diffracting) in &hull.panels {
        let corners = hull.corners(panel);
        let size = corners.iter().flat_map(|a| corners.iter().map(move |b| (a - b).norm())).fold(0.0, f64::max);
        if area(&corners) <= JOIN_SHARE * size * size {
            flat.add(panel.span, || {
                let text = format!("{}: the panel of nodes {} has no area", card(panel), nodes(panel));
                Diagnostic::error(text, panel.span).label("its nodes are on one line")
            });
            continue;
        }
        let (low, high) =
            corners.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| (low.min(at.z), high.max(at.z)));
        if *is_diffracting && high > hull.room {
            above.add(panel.span, || {
                let text = format!("{}: a DIFF panel reaches {high:.4} above the water line", card(panel));
                let said =
                    Diagnostic::error(text, panel.span).label("panels with DIFF in columns 12-15 are in the water");
                match structure.waterline {
                    Some((_, line)) => said.other(line, "the water line of ZLWL"),
                    None => said.help(
                        "ZLWL, (height) from column 21 on, gives the height of the water line; without it it is 0",
                    ),
                }
                .help("divide the panel at the water line; panels above it have no DIFF")
            });
        } else if !*is_diffracting && low < -hull.room {
            below.add(panel.span, || {
                let text = format!("{}: a panel without DIFF reaches {:.4} below the water line", card(panel), -low);
                Diagnostic::error(text, panel.span).label("DIFF belongs in columns 12-15").help(
                    "the waves would not act on it: divide it at the water line, and give the part in the water DIFF",
                )
            });
        }
    }
    let sides = hull.sides();
    let mut ends: Vec<_> = sides.iter().collect();
    ends.sort_unstable();
    for (side, panels) in ends {
        let Some((panel, _)) = panels.first().and_then(|(number, _)| hull.panels.get(*number)) else { continue };
        let [a, b] = side.map(|index| hull.name(index));
        if panels.len() == 1 && !hull.is_dry(*side) {
            let depth = side.iter().map(|index| -hull.corner(*index).z).fold(0.0, f64::max);
            open.add(panel.span, || {
                let text = format!(
                    "{}: no other panel has the side from node {a} to node {b}, {depth:.4} below the water line",
                    card(panel)
                );
                Diagnostic::error(text, panel.span)
                    .label("the hull is open here")
                    .help("panels that meet share the nodes of their sides; SYMX mirrors at Y = 0, SYMY at X = 0")
            });
        } else if panels.len() > 2 {
            crowded.add(panel.span, || {
                let text = format!("{}: {} panels have the side from node {a} to node {b}", card(panel), panels.len());
                Diagnostic::error(text, panel.span)
                    .label("two panels meet at a side")
                    .help("leave out panels within the hull, and those given twice")
            });
        }
    }
    let turned = hull.turned(&sides);
    for ((panel, _), is_turned) in hull.panels.iter().zip(turned) {
        if is_turned {
            inward.add(panel.span, || {
                let text = format!("{}: the panel of nodes {} faces into the hull", card(panel), nodes(panel));
                Diagnostic::error(text, panel.span)
                    .label("nodes run counter-clockwise as seen from the water")
                    .help("give its nodes the other way round")
            });
        }
    }
    // a panel without area has sides of no meaning
    if flat.count > 0 {
        flat.tell(remarks);
        return;
    }
    for faults in [above, below, open, crowded, inward] {
        faults.tell(remarks);
    }
}
