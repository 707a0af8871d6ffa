use super::world::World;
use crate::arm::Arm;

/// The clearance of a pair that is not looked at.
pub const IGNORED: f64 = f64::NEG_INFINITY;

/// How far apart what must be: metres, for each thing of a world and body of the arm.
#[derive(Debug, Clone, PartialEq)]
pub struct Rules {
    /// Between bodies of the arm themselves.
    pub self_clearance_m: f64,
    bodies: usize,
    clearances_m: Vec<f64>,
}

impl Rules {
    /// The same clearance everywhere, to itself too.
    pub fn new(arm: &Arm, world: &World, clearance_m: f64) -> Self {
        let bodies = arm.body_count();
        Self {
            self_clearance_m: clearance_m,
            bodies,
            clearances_m: vec![clearance_m; bodies * world.obstacles().len()],
        }
    }

    /// One body and one thing: a finger and the flap that it pushes get 0, or a little below for rounding.
    pub fn set(&mut self, body: usize, obstacle: usize, clearance_m: f64) {
        self.clearances_m[obstacle * self.bodies + body] = clearance_m;
    }

    /// One thing and every body.
    pub fn set_obstacle(&mut self, obstacle: usize, clearance_m: f64) {
        self.clearances_m[obstacle * self.bodies..][..self.bodies].fill(clearance_m);
    }

    /// One body and every thing: the base does not move, and is looked at once.
    pub fn set_body(&mut self, body: usize, clearance_m: f64) {
        self.clearances_m.iter_mut().skip(body).step_by(self.bodies).for_each(|clearance| *clearance = clearance_m);
    }

    /// That body's clearances to all things, by obstacle.
    pub(super) fn of(&self, body: usize, obstacle: usize) -> f64 {
        self.clearances_m[obstacle * self.bodies + body]
    }
}
