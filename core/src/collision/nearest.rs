/// What a body of the arm is near to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Other {
    /// A thing of the world, by its index.
    Obstacle(usize),
    /// Another body of the arm.
    Body(usize),
}

/// The pair that has least to spare.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearest {
    pub body: usize,
    pub other: Other,
    pub distance_m: f64,
    /// The distance less what the rules ask for: below 0 is a conflict.
    pub spare_m: f64,
}
