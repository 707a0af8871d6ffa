use super::known_size::{best_match_within, KnownSize};
use crate::body::ObjectAnswer;

/// What a user should know who gave sizes: of each size in a short list that no box in view has, and of each box that has none
/// of them. One line each.
pub fn size_warnings(objects: &[ObjectAnswer], sizes: &[KnownSize]) -> Vec<String> {
    if sizes.is_empty() {
        return Vec::new();
    }
    if objects.iter().all(|object| object.size.is_none()) {
        let what = match sizes {
            [size] => format!("the size {} ({})", size.name, millimetres(&size.outer_m)),
            _ => format!("any of the {} sizes", sizes.len()),
        };
        let seen = if objects.is_empty() { ": none was found" } else { "" };
        let head = format!("no box in view has {what}{seen}");
        return std::iter::once(head).chain(strangers(objects, sizes)).collect();
    }
    strangers(objects, sizes).collect()
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
