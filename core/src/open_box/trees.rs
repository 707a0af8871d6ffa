use serde::Deserialize;

/// A small decision tree, as it is written: what it adds to the log odds at each leaf.
///
/// In JSON a leaf is a number, a split a list: the feature's name, the bound, the tree up to it, the tree above.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(untagged)]
pub enum Tree {
    Leaf(f64),
    Split(String, f64, Box<Tree>, Box<Tree>),
}

/// Trees that ask for features by their numbers: a box is judged dozens of times in a frame.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Forest {
    nodes: Vec<Node>,
    roots: Vec<usize>,
}

/// A leaf with what it adds, or a split with its bound: the tree above it is rooted one before, the tree up to it where that is told.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Node {
    value: f64,
    /// `LEAF` of a leaf.
    feature: u32,
    up_to: u32,
}

const LEAF: u32 = u32::MAX;

impl Forest {
    /// # Errors
    /// The name of a feature that a tree asks for and that is not among the known ones.
    pub fn new(trees: &[Tree], known: &[&str]) -> Result<Self, String> {
        let mut out = Self::default();
        for tree in trees {
            let root = out.add(tree, known)?;
            out.roots.push(root);
        }
        Ok(out)
    }

    fn add(&mut self, tree: &Tree, known: &[&str]) -> Result<usize, String> {
        let node = match tree {
            Tree::Leaf(value) => Node { value: *value, feature: LEAF, up_to: 0 },
            Tree::Split(name, bound, up_to, above) => {
                let feature = known.iter().position(|other| other == name).ok_or_else(|| name.clone())?;
                let up_to = self.add(up_to, known)? as u32;
                self.add(above, known)?;
                Node { value: *bound, feature: feature as u32, up_to }
            }
        };
        self.nodes.push(node);
        Ok(self.nodes.len() - 1)
    }

    /// The sum of all trees at these values of the known features.
    pub fn sum(&self, values: &[f64]) -> f64 {
        self.roots.iter().map(|&root| self.at(root, values)).sum()
    }

    fn at(&self, mut number: usize, values: &[f64]) -> f64 {
        loop {
            let node = self.nodes[number];
            if node.feature == LEAF {
                return node.value;
            }
            number = if values[node.feature as usize] <= node.value { node.up_to as usize } else { number - 1 };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn trees_are_followed_to_their_leaves() {
        let tree: Tree = serde_json::from_str(r#"["a", 0.5, -1.0, ["b", 2, 0.25, 3]]"#).unwrap();
        let forest = Forest::new(&[tree.clone(), Tree::Leaf(0.5)], &["b", "a"]).unwrap();
        let at = |a: f64, b: f64| forest.sum(&[b, a]);
        assert_eq!([at(0.5, 9.0), at(0.6, 2.0), at(0.6, 2.1)], [-0.5, 0.75, 3.5]);
        assert_eq!(Forest::new(&[tree], &["a"]), Err("b".into()));
    }

    #[test]
    fn what_is_no_tree_is_refused() {
        for text in [r#"["a", 0.5, 1]"#, r#"[0.5, "a", 1, 2]"#, r#""a""#] {
            assert!(serde_json::from_str::<Tree>(text).is_err(), "{text}");
        }
    }
}
