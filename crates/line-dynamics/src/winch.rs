//! Elements that appear at a winch and go back into it.

use super::error::RodError;
use super::mesh::{Rod, RodElement};
use super::state::RodState;
use nalgebra::Vector3;

impl Rod {
    /// Changes the unstretched length (m) of an element and the rate (m/s) at which it changes, as a winch does.
    /// Its mass and everything else that goes by length follow.
    ///
    /// # Errors
    /// An element that is not there, or a length that is not positive.
    pub fn set_length(&mut self, element: usize, length: f64, rate: f64) -> Result<(), RodError> {
        let segment = self.element(element)?.segment;
        if !(length.is_finite() && length > 0.0 && rate.is_finite()) {
            return Err(self.refuse(format!("element {} cannot be {length} m long", element + 1)));
        }
        let made = self
            .segments
            .get(segment)
            .map(|properties| RodElement { rate, ..RodElement::new(properties, segment, length) });
        self.elements.change(|elements| {
            if let (Some(position), Some(made)) = (elements.get_mut(element), made) {
                *position = made;
            }
        });
        Ok(())
    }

    /// Divides an element, as one that a winch has let out far enough, into two of half its length with a node
    /// between them. Of an element at an end the part beside that end keeps the rate, and the new node moves as the
    /// rest of the rod; of another both halves grow. The rod then needs a new [`RodSolver`](super::RodSolver).
    ///
    /// # Errors
    /// An element that is not there, too many elements, or a rod with torsional stiffness, whose elements cannot be divided.
    pub fn divide(&mut self, element: usize, state: &mut RodState) -> Result<(), RodError> {
        let old = self.changeable(element, state)?;
        if self.elements.len() >= super::MAX_ELEMENTS {
            return Err(self.refuse(format!("it has {} elements already", self.elements.len())));
        }
        // the part beside the end it comes from goes on growing, and the rest moves as one
        let (first, last) = (element == 0, element + 1 == self.elements.len());
        let half = self.scaled_element(&old, 0.5);
        let rates = if first {
            [old.rate, 0.0]
        } else if last {
            [0.0, old.rate]
        } else {
            [half.rate, half.rate]
        };
        self.elements.change(|elements| {
            elements.splice(element..=element, rates.map(|rate| RodElement { rate, ..half.clone() }));
        });
        if let Some(strain) = state.yielded.get(element).copied() {
            state.yielded.insert(element, strain);
        }
        let middle = |list: &[Vector3<f64>]| (list[element] + list[element + 1]) * 0.5;
        let position = middle(&state.position);
        state.position.insert(element + 1, position);
        for list in [&mut state.velocity, &mut state.acceleration, &mut state.averaged] {
            let made = if first {
                list[element + 1]
            } else if last {
                list[element]
            } else {
                middle(list)
            };
            list.insert(element + 1, made);
        }
        state.stuck.insert(element + 1, 0.5 * (state.stuck[element] + state.stuck[element + 1]));
        state.bedding.insert(element + 1, 0.5 * (state.bedding[element] + state.bedding[element + 1]));
        for attachment in self.attachments.iter_mut().filter(|a| a.node > element) {
            attachment.node += 1;
        }
        Ok(())
    }

    /// Makes one of an element and the next, as one that a winch has hauled in far enough; it is of the segment of the next. The rod
    /// then needs a new [`RodSolver`](super::RodSolver).
    ///
    /// # Errors
    /// An element that is not there or has none after it, something attached between the two, or a rod with torsional stiffness.
    pub fn join(&mut self, element: usize, state: &mut RodState) -> Result<(), RodError> {
        let first = self.changeable(element, state)?;
        let second = self.changeable(element + 1, state)?;
        if self.attachments.iter().any(|a| a.node == element + 1) {
            let why = format!("elements {} and {} cannot be one", element + 1, element + 2);
            return Err(self.refuse(why));
        }
        let joined = RodElement {
            rate: first.rate + second.rate,
            ..self.scaled_element(&second, (first.rest + second.rest) / second.rest)
        };
        self.elements.change(|elements| {
            elements.splice(element..=element + 1, [joined]);
        });
        for list in [&mut state.position, &mut state.velocity, &mut state.acceleration, &mut state.averaged] {
            list.remove(element + 1);
        }
        state.stuck.remove(element + 1);
        state.bedding.remove(element + 1);
        if let [a, b] = [element, element + 1].map(|i| state.yielded.get(i).copied())
            && let (Some(a), Some(b)) = (a, b)
        {
            state.yielded[element] = (a * first.rest + b * second.rest) / (first.rest + second.rest);
            state.yielded.remove(element + 1);
        }
        for attachment in self.attachments.iter_mut().filter(|a| a.node > element) {
            attachment.node -= 1;
        }
        Ok(())
    }

    /// An element of the same segment that is `share` as long, and grows by that share of its rate.
    fn scaled_element(&self, element: &RodElement, share: f64) -> RodElement {
        let rest = element.rest * share;
        self.segments.get(element.segment).map_or_else(
            || element.clone(),
            |properties| RodElement {
                rate: element.rate * share,
                ..RodElement::new(properties, element.segment, rest)
            },
        )
    }

    fn element(&self, element: usize) -> Result<RodElement, RodError> {
        let there = self.elements.get(element).cloned();
        there.ok_or_else(|| self.refuse(format!("there is no element {}", element + 1)))
    }

    /// An element whose nodes may come and go.
    fn changeable(&self, element: usize, state: &RodState) -> Result<RodElement, RodError> {
        if !state.fits(self) {
            return Err(self.refuse("the state is not that of this rod".to_string()));
        }
        if self.twists() {
            return Err(self.refuse("elements with torsional stiffness cannot be divided or joined".to_string()));
        }
        self.element(element)
    }

    fn refuse(&self, why: String) -> RodError {
        RodError::Shape { rod: self.name.clone(), why }
    }
}
