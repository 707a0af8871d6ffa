//! boxwright's core: from a depth cloud to articulated objects.
//!
//! Layers, lowest first; each may use those above it in this list and no other:
//! `error`, `geometry`, `cloud`, `perception`, `free_space`, `model`, `inference`, `body`, `fit`, `open_box`, `pipeline`,
//! `arm`, `collision`, `planning`.
//! The paper's equations are numbered in `docs/maths.md`; the code cites the number.

pub mod arm;
pub mod body;
pub mod cloud;
pub mod collision;
pub mod error;
pub mod fit;
pub mod free_space;
pub mod geometry;
pub mod inference;
pub mod model;
pub mod open_box;
pub mod perception;
pub mod pipeline;
pub mod planning;
