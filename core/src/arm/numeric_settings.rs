/// How the inverse is sought where there is no closed form.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NumericSettings {
    /// Starts of a search, at most: the given one, then fixed ones spread over the joints' ranges.
    pub starts: usize,
    /// Steps from one start, at most.
    pub steps: usize,
    /// Solutions after which a search ends.
    pub enough: usize,
    /// The tool is there when it is off by less, in metres and in radians.
    pub tolerance: f64,
    /// What keeps steps short near singularities, beside the error itself (m^2, rad^2).
    pub least_damping: f64,
    /// A joint turns no further in one step, rad.
    pub longest_step_rad: f64,
    /// Solutions are different ones when some joint differs by more, rad.
    pub apart_rad: f64,
}

impl Default for NumericSettings {
    fn default() -> Self {
        Self {
            starts: 32,
            steps: 60,
            enough: 4,
            tolerance: 1e-9,
            least_damping: 1e-9,
            longest_step_rad: 0.6,
            apart_rad: 0.05,
        }
    }
}
