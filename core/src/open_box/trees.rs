use serde::Deserialize;

use super::features::{named, Features};

/// A small decision tree: what it adds to the log odds at each leaf.
///
/// In JSON a leaf is a number, a split a list: the feature's name, the bound, the tree up to it, the tree above.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(untagged)]
pub enum Tree {
    Leaf(f64),
    Split(String, f64, Box<Tree>, Box<Tree>),
}

impl Tree {
    pub fn at(&self, features: &Features) -> f64 {
        match self {
            Self::Leaf(value) => *value,
            Self::Split(name, bound, up_to, above) => {
                let next = if named(features, name) <= *bound { up_to } else { above };
                next.at(features)
            }
        }
    }

    /// The names of the features that it asks for.
    pub fn features(&self) -> Vec<&str> {
        match self {
            Self::Leaf(_) => Vec::new(),
            Self::Split(name, _, up_to, above) => {
                let below = up_to.features().into_iter().chain(above.features());
                std::iter::once(name.as_str()).chain(below).collect()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tree_is_followed_to_its_leaf() {
        let tree: Tree = serde_json::from_str(r#"["a", 0.5, -1.0, ["b", 2, 0.25, 3]]"#).unwrap();
        let at = |a: f64, b: f64| tree.at(&vec![("a", a), ("b", b)]);
        assert_eq!([at(0.5, 9.0), at(0.6, 2.0), at(0.6, 2.1)], [-1.0, 0.25, 3.0]);
        assert_eq!(tree.features(), ["a", "b"]);
    }

    #[test]
    fn what_is_no_tree_is_refused() {
        for text in [r#"["a", 0.5, 1]"#, r#"[0.5, "a", 1, 2]"#, r#""a""#] {
            assert!(serde_json::from_str::<Tree>(text).is_err(), "{text}");
        }
    }
}
