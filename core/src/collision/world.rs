use super::solid::Solid;
use crate::geometry::Vec3;

/// A solid thing and what answers call it.
#[derive(Debug, Clone, PartialEq)]
pub struct Obstacle {
    pub name: String,
    pub solid: Solid,
}

/// What stands around the arm at one moment, in the base's frame. Things go by their index, which never changes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct World {
    obstacles: Vec<Obstacle>,
    bounds: Vec<Ball>,
}

/// A ball that encloses something: centre and radius, metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ball {
    pub centre: Vec3,
    pub radius_m: f64,
}

impl Ball {
    /// Whether another ball is at least so far away.
    pub(super) fn clear_by(&self, other: &Self, asked_m: f64) -> bool {
        let reach_m = self.radius_m + other.radius_m + asked_m;
        reach_m <= 0.0 || (self.centre - other.centre).norm_squared() >= reach_m * reach_m
    }

    /// How far a solid is from the ball at the least; below 0 it may be anything.
    pub(super) fn least_gap_m(&self, solid: &Solid, bounds: &Self) -> f64 {
        let centre_m = match solid {
            Solid::Box(b) => b.distance_to_point_sq_m2(&self.centre).sqrt(),
            Solid::Capsule(_) => (self.centre - bounds.centre).norm() - bounds.radius_m,
            Solid::HalfSpace(h) => h.normal.dot(&self.centre) - h.distance_m,
        };
        centre_m - self.radius_m
    }
}

impl World {
    pub fn new(obstacles: Vec<Obstacle>) -> Self {
        let bounds = obstacles.iter().map(|obstacle| ball(&obstacle.solid)).collect();
        Self { obstacles, bounds }
    }

    pub fn obstacles(&self) -> &[Obstacle] {
        &self.obstacles
    }

    pub(super) fn bounds(&self) -> &[Ball] {
        &self.bounds
    }

    /// Adds a thing and says its index.
    pub fn add(&mut self, name: impl Into<String>, solid: Solid) -> usize {
        self.bounds.push(ball(&solid));
        self.obstacles.push(Obstacle { name: name.into(), solid });
        self.obstacles.len() - 1
    }

    /// Moves a thing, or changes it: a flap that has turned.
    pub fn replace(&mut self, index: usize, solid: Solid) {
        self.bounds[index] = ball(&solid);
        self.obstacles[index].solid = solid;
    }

    pub fn index_of(&self, name: &str) -> Option<usize> {
        self.obstacles.iter().position(|obstacle| obstacle.name == name)
    }
}

fn ball(solid: &Solid) -> Ball {
    match solid {
        Solid::Box(b) => Ball { centre: b.centre(), radius_m: b.half_m.norm() },
        Solid::Capsule(c) => {
            Ball { centre: (c.from + c.to) / 2.0, radius_m: (c.to - c.from).norm() / 2.0 + c.radius_m }
        }
        Solid::HalfSpace(_) => Ball { centre: Vec3::zeros(), radius_m: f64::INFINITY },
    }
}
