//! From a cloud to planar segments with rectangles. Knows no template: meaning begins in `model`.

mod scene;

pub use scene::{Scene, Segments};
