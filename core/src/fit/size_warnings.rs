use super::known_size::{best_match_within, KnownSize};
use crate::body::ObjectAnswer;

/// What a user should know who gave sizes: of each size in a short list that no box in view has, and of each box that has none
/// of them. One line each.
pub fn size_warnings(objects: &[ObjectAnswer], sizes: &[KnownSize]) -> Vec<String> {
    if sizes.is_empty() {
        return Vec::new();
    }
    let has = |size: &KnownSize| objects.iter().flat_map(|object| &object.size).any(|found| found.name == size.name);
    let seen = if objects.is_empty() { ": none was found" } else { "" };
    let unmet = |what: String| format!("no box in view has {what}{seen}");
    let mut out: Vec<String> = Vec::new();
    if sizes.len() <= SHORT_LIST {
        out.extend(sizes.iter().filter(|size| !has(size)).map(|size| unmet(format!("the size {}", named(size)))));
    } else if !sizes.iter().any(has) {
        out.push(unmet(format!("any of the {} sizes", sizes.len())));
    }
    out.extend(strangers(objects, sizes));
    out
}

/// Of so many sizes each that no box has is told.
const SHORT_LIST: usize = 4;

/// By its name, and its lengths where the name does not say them.
fn named(size: &KnownSize) -> String {
    let lengths = millimetres(&size.outer_m);
    let letters = |text: &str| text.chars().filter(|c| !c.is_whitespace()).collect::<String>();
    if letters(&size.name) == letters(&lengths) {
        size.name.clone()
    } else {
        format!("{} ({lengths})", size.name)
    }
}

/// Boxes of no given size, and what comes nearest to them.
fn strangers<'a>(objects: &'a [ObjectAnswer], sizes: &'a [KnownSize]) -> impl Iterator<Item = String> + 'a {
    objects.iter().enumerate().filter(|(_, object)| object.size.is_none()).map(|(number, object)| {
        let name = format!("object {number} ({})", object.template);
        let measured =
            object.outer_dimensions.and_then(|outer_m| Some((outer_m, best_match_within(outer_m, 0.0, sizes)?)));
        let Some((outer_m, nearest)) = measured else {
            return format!("{name} has no dimensions to match a size with");
        };
        let near = format!("{} ({})", sizes[nearest.size].name, millimetres(&nearest.outer_m));
        format!("{name} is {} outside and of no given size; the nearest is {near}", millimetres(&outer_m))
    })
}

fn millimetres(lengths_m: &[f64; 3]) -> String {
    let [length, width, height] = lengths_m.map(|m| 1e3 * m);
    format!("{length:.0} x {width:.0} x {height:.0} mm")
}
