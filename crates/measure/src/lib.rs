//! Exact measures of and between vertices, edges and faces: what a viewer's measuring tool shows.
//!
//! [`facts`] tells what one item is (length, area, radius, axis, …), [`between`] how two of them lie to each other
//! (smallest distance, angle, distance of axes, …). All of it comes from the exact curves and surfaces, where
//! instances put them; triangles only say where to start. [`whole()`] tells area, volume and centre of gravity of a part.
//! World coordinates, millimetres, degrees.

mod area;
mod between;
mod bvh;
mod carrier;
mod descend;
mod element;
mod facts;
mod isolines;
mod item;
mod length;
mod middle;
mod sampled;
mod search;
mod simplex;
mod whole;

pub use between::{Between, between};
pub use carrier::Axis;
pub use facts::{Facts, facts};
pub use item::{Feature, Item};
pub use whole::{Whole, whole};
