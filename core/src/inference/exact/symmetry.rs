//! One assignment of each class that the template's symmetries make.

/// The template's symmetries as the search asks for them.
#[derive(Debug, Clone)]
pub struct Symmetries {
    /// `sources[k][p]`: the part whose segment part `p` takes under symmetry `k`; the identity left out.
    sources: Vec<Vec<usize>>,
}

/// Stands for the state of a part that the search has not come to.
pub const UNDECIDED: usize = usize::MAX;

impl Symmetries {
    /// `maps[k][p]` is the part that takes the segment of part `p`.
    pub fn new(maps: &[Vec<usize>]) -> Self {
        let source = |map: &Vec<usize>| {
            let mut from = vec![0; map.len()];
            map.iter().enumerate().for_each(|(p, &to)| from[to] = p);
            from
        };
        let is_identity = |map: &&Vec<usize>| map.iter().enumerate().any(|(p, &to)| p != to);
        Self { sources: maps.iter().filter(is_identity).map(source).collect() }
    }

    /// False: whatever the undecided parts take, a symmetric copy comes later in the order of states. The search keeps
    /// the last of each class.
    pub fn may_lead(&self, states: &[usize]) -> bool {
        self.sources.iter().all(|from| {
            let pairs = states.iter().zip(from).enumerate().filter(|(p, (_, &from))| *p != from);
            let mut pairs = pairs.map(|(_, (&state, &from))| (state, states[from]));
            match pairs.find(|(state, turned)| *state == UNDECIDED || *turned == UNDECIDED || state != turned) {
                Some((UNDECIDED, _) | (_, UNDECIDED)) | None => true,
                Some((state, turned)) => state > turned,
            }
        })
    }

    /// Their numbers, the identity left out.
    pub fn all(&self) -> Vec<usize> {
        (0..self.sources.len()).collect()
    }

    /// The parts whose segment `part` takes under one of `group`; twice where two of them agree.
    pub fn orbit(&self, group: &[usize], part: usize) -> Vec<usize> {
        group.iter().map(|&k| self.sources[k][part]).collect()
    }

    /// Those of `group` that leave `part` in its place.
    pub fn fixing<'a>(&'a self, group: &'a [usize], part: usize) -> impl Iterator<Item = usize> + 'a {
        group.iter().copied().filter(move |&k| self.sources[k][part] == part)
    }

    /// The last of the assignment's copies in the order of states.
    pub fn leader(&self, states: &[usize]) -> Vec<usize> {
        let mut best = states.to_vec();
        for from in &self.sources {
            let turned = from.iter().map(|&p| states[p]);
            if turned.clone().gt(best.iter().copied()) {
                best = turned.collect();
            }
        }
        best
    }

    /// How many symmetries there are, the identity counted.
    pub fn count(&self) -> usize {
        self.sources.len() + 1
    }

    /// How many different copies the symmetries make of the assignment.
    pub fn copies(&self, states: &[usize]) -> usize {
        let stays = self.sources.iter().filter(|from| from.iter().zip(states).all(|(&p, &state)| states[p] == state));
        self.count() / (stays.count() + 1)
    }

    /// The copy that has most segments in the same parts as `reference`; of equals the last in the order of states.
    pub fn folded(&self, states: &[usize], reference: &[usize]) -> Vec<usize> {
        let agreement = |copy: &[usize]| copy.iter().zip(reference).filter(|(a, b)| a == b && **a != 0).count();
        let mut best = (agreement(states), states.to_vec());
        for from in &self.sources {
            let copy: Vec<usize> = from.iter().map(|&p| states[p]).collect();
            best = best.max((agreement(&copy), copy));
        }
        best.1
    }
}
