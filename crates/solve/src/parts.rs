//! The parts of a system that come to rest by themselves: bodies and junctions that connectors join, directly or one by another.
//!
//! What is not joined shares neither a step nor the help of a search, so that one part does not hold up another. The parts are found
//! by joining sets [TARJAN-1975].

use super::link::EndAttachment;
use super::system::System;

/// The bodies of a system that one search brings to rest: one a body, whether it is among them.
pub(super) type BodySubset = Vec<bool>;

/// The parts of a system, in the order of their first bodies.
pub(super) fn parts(system: &System) -> Vec<BodySubset> {
    let count = system.nodes.len();
    // each body points at another of its part, the first of a part at itself
    let mut leads: Vec<usize> = (0..count).collect();
    for link in &system.links {
        let mut bodies = link.ends.iter().filter_map(|end| match end {
            EndAttachment::Body(body, _) if *body < count => Some(*body),
            _ => None,
        });
        let Some(first) = bodies.next() else { continue };
        for other in bodies {
            let (a, b) = (leader(&mut leads, first), leader(&mut leads, other));
            if let Some(lead) = leads.get_mut(a.max(b)) {
                *lead = a.min(b);
            }
        }
    }
    let all: Vec<usize> = (0..count).map(|body| leader(&mut leads, body)).collect();
    let firsts = all.iter().enumerate().filter(|(body, lead)| body == *lead).map(|(body, _)| body);
    firsts.map(|first| all.iter().map(|lead| *lead == first).collect()).collect()
}

/// The first body of a body's part; the way there is halved for the next time.
fn leader(leads: &mut [usize], mut body: usize) -> usize {
    while let Some(next) = leads.get(body).copied().filter(|next| *next != body) {
        let beyond = leads[next];
        leads[body] = beyond;
        body = beyond;
    }
    body
}
