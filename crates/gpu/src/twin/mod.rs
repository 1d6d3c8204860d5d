//! The evaluators' passes on the CPU: the same names, tables and order of operations as in `shaders/`, in f32.

mod bezier;
mod finish;
mod krishnamurthy;
mod tan;
mod tensor;

pub(crate) use bezier::{bezier_basis, bezier_grid};
pub(crate) use krishnamurthy::{krishnamurthy_indexed, krishnamurthy_packed, krishnamurthy_unpacked};
pub(crate) use tan::{tan_columns, tan_rows};
pub(crate) use tensor::{Product, tensor_points};
