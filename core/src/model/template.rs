use super::{Feature, Relation};
use crate::error::{InputError, Result};
use crate::model::template_file::TemplateFile;

/// An articulated object's model: parts, hinges, symmetries, features and relations. Parts are named by index from here on.
#[derive(Debug, Clone, PartialEq)]
pub struct Template {
    pub name: String,
    pub description: String,
    pub parts: Vec<Part>,
    pub joints: Vec<Joint>,
    /// Every permutation of the parts that leaves the score unchanged, the identity first; `symmetries[k][p]` is the part
    /// that takes the segment of part `p`.
    pub symmetries: Vec<Vec<usize>>,
    pub features: Vec<FeatureTerm>,
    pub relations: Vec<RelationTerm>,
    pub accept: Accept,
    pub body: Body,
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Part {
    pub name: String,
    /// What kind of panel it is ("side"): figures of merit and corruptions in learning go by it.
    pub class: String,
}

#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    pub parent: usize,
    pub child: usize,
    pub limits_rad: [f64; 2],
}

/// A named feature; its values over `parts` are summed and share one weight.
#[derive(Debug, Clone, PartialEq)]
pub struct FeatureTerm {
    pub name: String,
    pub feature: Feature,
    pub parts: Vec<usize>,
}

/// A named relation; its values over `pairs` are summed and share one weight.
#[derive(Debug, Clone, PartialEq)]
pub struct RelationTerm {
    pub name: String,
    pub relation: Relation,
    pub pairs: Vec<(usize, usize)>,
}

/// What an assignment needs before it is called an object, whatever its score.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Accept {
    pub min_parts: usize,
    pub requirements: Vec<Requirement>,
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Requirement {
    pub parts: Vec<usize>,
    pub at_least: usize,
}

impl Accept {
    pub fn allows(&self, assignment: &[Option<usize>]) -> bool {
        let filled = |parts: &[usize]| parts.iter().filter(|&&p| assignment[p].is_some()).count();
        assignment.iter().flatten().count() >= self.min_parts
            && self.requirements.iter().all(|r| filled(&r.parts) >= r.at_least)
    }
}

/// How unseen parts and hinges follow from the seen ones.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Body {
    /// Nothing is known beyond the joints: parts stay as seen, hinges lie where two rectangles meet.
    Free,
    /// A base, four sides in a ring, and what hangs on their rims.
    OpenBox(OpenBoxRoles),
    /// A base, four sides in a ring, and a top that lies on their rims as flap 0 of an open box would if it were shut.
    ClosedBox(OpenBoxRoles),
}

impl Body {
    /// Of a box, open or closed.
    pub fn box_roles(&self) -> Option<&OpenBoxRoles> {
        match self {
            Self::Free => None,
            Self::OpenBox(roles) | Self::ClosedBox(roles) => Some(roles),
        }
    }
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OpenBoxRoles {
    pub base: usize,
    /// Counter-clockwise seen from above.
    pub sides: [usize; 4],
    /// `flaps[k]` hangs on `sides[k]`.
    pub flaps: [Option<usize>; 4],
    /// `tucks[k]` hangs on `flaps[k]`.
    pub tucks: [Option<usize>; 4],
}

impl Template {
    /// Reads a template from TOML text.
    ///
    /// # Errors
    /// A line naming the key that does not fit and what would.
    pub fn from_toml(text: &str) -> Result<Self> {
        let file: TemplateFile = toml::from_str(text).map_err(|error| InputError::of_toml(text, &error))?;
        file.check()
    }

    pub fn part_index(&self, name: &str) -> Option<usize> {
        self.parts.iter().position(|part| part.name == name)
    }

    /// Names of all features, then of all relations: the order of every feature vector and weight vector.
    pub fn term_names(&self) -> impl Iterator<Item = &str> {
        let features = self.features.iter().map(|term| term.name.as_str());
        features.chain(self.relations.iter().map(|term| term.name.as_str()))
    }

    /// The paper's names of the terms' kinds, in the order of `term_names`.
    pub fn term_symbols(&self) -> impl Iterator<Item = &'static str> + '_ {
        let features = self.features.iter().map(|term| term.feature.symbol());
        features.chain(self.relations.iter().map(|term| term.relation.symbol()))
    }

    pub fn term_count(&self) -> usize {
        self.features.len() + self.relations.len()
    }
}
