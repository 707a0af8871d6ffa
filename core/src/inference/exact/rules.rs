use crate::model::Accept;

/// Which assignments are wanted.
#[derive(Debug, Clone, Copy)]
pub struct Rules<'a> {
    /// How many, best first.
    pub most: usize,
    /// None that scores less.
    pub floor: f64,
    /// None that this refuses.
    pub accept: Option<&'a Accept>,
}
