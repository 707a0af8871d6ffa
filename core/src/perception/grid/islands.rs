use super::runs::{Run, Runs};

/// Connected pixels of one label below this number are strays.
const MIN_ISLAND_PX: u32 = 12;

/// The runs of each label in image order, without strays.
pub fn runs_by_label(runs: &Runs, count: usize) -> Vec<Vec<Run>> {
    let component = runs.components(1);
    let mut size = vec![0; runs.runs.len()];
    for (run, &c) in runs.runs.iter().zip(&component) {
        size[c as usize] += run.len();
    }
    let mut of_label = vec![Vec::new(); count];
    for (run, &c) in runs.runs.iter().zip(&component) {
        if size[c as usize] >= MIN_ISLAND_PX {
            of_label[usize::from(run.label)].push(*run);
        }
    }
    of_label
}
