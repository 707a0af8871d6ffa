//! The fast front end for clouds with an image grid: planes grow from moments of small cells, in inverse depth.

mod background;
mod bases;
mod camera;
mod cells;
mod chain;
mod ground;
mod islands;
mod merge;
mod noise;
mod piece;
mod pixels;
mod pose;
mod quads;
mod ray_moments;
mod rays;
mod regions;
mod roundness;
mod runs;
mod things;
mod touching;

pub use chain::perceive_on_grid;
