use super::eigen::principal;
use super::flatness::{fit, sum_around, Window};
use super::voxels::{Voxels, NONE};
use crate::geometry::{Moments, Plane};

/// A voxel begins a surface where its surroundings' rms is below this many standard deviations, in so many ranks ...
const SEED_SIGMAS: f64 = 1.7;
const SEED_RANKS: usize = 32;
/// ... and it is no sparse fringe of the noise.
const SEED_FULLNESS: f64 = 0.4;
/// A voxel joins where its mean lies within `FIXED + SIGMAS + SIGMAS_OF_MEAN / sqrt(readings)` of the plane ...
const MEAN_FIXED_M: f64 = 0.0003;
const MEAN_SIGMAS: f64 = 1.2;
const MEAN_SIGMAS_OF_MEAN: f64 = 1.5;
/// ... and its rms about the plane is below the like.
const RMS_SIGMAS: f64 = 1.5;
const RMS_SIGMAS_OF_MEAN: f64 = 1.5;
/// Sparse voxels beside the surface are the noise's fringe: owned, but not fitted.
const FRINGE_FULLNESS: f64 = 0.35;
const FRINGE_SIGMAS: f64 = 3.2;
/// Surroundings that lean more than this from the plane do not belong to it: cosine of 24 degrees.
const LEAN_COSINE: f64 = 0.9135;
/// The plane is fitted anew when the surface has grown by this factor.
const REFIT_GROWTH: f64 = 1.25;
/// How often the whole border is tried again with the last plane.
const RETRIES: usize = 2;
/// How far the faces of a board lie from its middle.
const HALF_BOARD_M: f64 = 0.0025;
/// Readings and voxels of a surface, at least.
const MIN_COUNT: f64 = 25.0;
const MIN_VOXELS: usize = 4;

/// A flat piece of the cloud; its plane is told inside.
#[derive(Debug, Clone)]
pub struct Surface {
    pub plane: Plane,
    pub moments: Moments,
    /// Mean square distance from the plane, square metres.
    pub variance: f64,
    pub voxels: Vec<u32>,
}

/// All flat pieces, and whose each voxel is.
pub struct Surfaces {
    pub list: Vec<Surface>,
    pub owner: Vec<u32>,
}

impl Surfaces {
    /// Surfaces grown from the flattest surroundings, voxel by voxel; then, from what is left, thicker ones: boards of which
    /// both faces are seen.
    pub fn grow(voxels: &Voxels, windows: &[Window], sigma_m: f64) -> Self {
        let mut surfaces = Self { list: vec![], owner: vec![NONE; voxels.len()] };
        for sigma_m in [sigma_m, sigma_m.hypot(HALF_BOARD_M)] {
            for seed in seeds(windows, &surfaces.owner, sigma_m) {
                if surfaces.owner[seed as usize] == NONE {
                    surfaces.grow_from(voxels, windows, sigma_m, seed);
                }
            }
        }
        surfaces
    }

    fn grow_from(&mut self, voxels: &Voxels, windows: &[Window], sigma_m: f64, seed: u32) {
        let id = self.list.len() as u32;
        let Some((plane, variance)) = fit(&sum_around(voxels, seed as usize)) else { return };
        let mut surface = Surface { plane, moments: Moments::default(), variance, voxels: vec![] };
        if !self.take(voxels, windows, sigma_m, &mut surface, seed, id) {
            return;
        }
        let (mut tried, mut fitted_at, mut retries) = (0, voxels.count(seed as usize).max(MIN_COUNT), RETRIES);
        while tried < surface.voxels.len() {
            let voxel = surface.voxels[tried] as usize;
            tried += 1;
            for &next in voxels.neighbours.of(voxel) {
                if self.owner[next as usize] == NONE {
                    self.take(voxels, windows, sigma_m, &mut surface, next, id);
                }
            }
            let is_last = tried == surface.voxels.len();
            if surface.moments.weight > fitted_at * REFIT_GROWTH || (is_last && surface.moments.weight > fitted_at) {
                fitted_at = surface.moments.weight;
                surface.refit();
                if is_last && retries > 0 {
                    retries -= 1;
                    tried = 0;
                }
            }
        }
        self.keep_what_fits(voxels, windows, sigma_m, surface, id);
    }

    /// Gives a free voxel to the surface if it fits; whether it did.
    fn take(
        &mut self,
        voxels: &Voxels,
        windows: &[Window],
        sigma_m: f64,
        surface: &mut Surface,
        voxel: u32,
        id: u32,
    ) -> bool {
        match fitting(voxels, windows, sigma_m, &surface.plane, voxel as usize) {
            Fit::No => return false,
            Fit::Fringe => {}
            Fit::Yes => surface.moments.add(&voxels.moments[voxel as usize]),
        }
        self.owner[voxel as usize] = id;
        surface.voxels.push(voxel);
        true
    }

    /// The plane may have moved since a voxel joined.
    fn keep_what_fits(&mut self, voxels: &Voxels, windows: &[Window], sigma_m: f64, mut surface: Surface, id: u32) {
        let mut kept = Surface { moments: Moments::default(), voxels: vec![], ..surface };
        for voxel in std::mem::take(&mut surface.voxels) {
            self.owner[voxel as usize] = NONE;
            self.take(voxels, windows, sigma_m, &mut kept, voxel, id);
        }
        if kept.moments.weight < MIN_COUNT || kept.voxels.len() < MIN_VOXELS {
            kept.voxels.iter().for_each(|&v| self.owner[v as usize] = NONE);
            return;
        }
        kept.refit();
        self.list.push(kept);
    }
}

impl Surfaces {
    /// Drops the empty ones; the largest come first (ties: the lowest voxel), their voxels by place.
    pub fn number_anew(&mut self) {
        self.list.retain(|s| !s.voxels.is_empty());
        self.list.iter_mut().for_each(|s| s.voxels.sort_unstable());
        self.list.sort_by(|a, b| b.moments.weight.total_cmp(&a.moments.weight).then(a.voxels[0].cmp(&b.voxels[0])));
        self.own_anew();
    }

    /// Gives all that one surface has to another; owners are not written down anew.
    pub fn join(&mut self, into: usize, from: usize) {
        let gone = std::mem::take(&mut self.list[from].voxels);
        let moments = self.list[from].moments;
        let surface = &mut self.list[into];
        surface.voxels.extend(gone);
        surface.moments.add(&moments);
        surface.refit();
    }

    /// Writes down whose each voxel is.
    pub fn own_anew(&mut self) {
        self.owner.fill(NONE);
        for (id, surface) in self.list.iter().enumerate() {
            surface.voxels.iter().for_each(|&v| self.owner[v as usize] = id as u32);
        }
    }
}

impl Surface {
    /// Length and width of a rectangle that is spread like the surface, metres.
    pub fn sides_m(&self) -> [f64; 2] {
        let [_, middle, most] = principal(&self.moments.covariance()).variances;
        [most, middle].map(|variance| (12.0 * variance).sqrt())
    }

    pub fn refit(&mut self) {
        if let Some((plane, variance)) = fit(&self.moments) {
            (self.plane, self.variance) = (plane, variance);
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Fit {
    Yes,
    Fringe,
    No,
}

fn fitting(voxels: &Voxels, windows: &[Window], sigma_m: f64, plane: &Plane, voxel: usize) -> Fit {
    let (moments, window) = (&voxels.moments[voxel], &windows[voxel]);
    if window.is_flat() && window.normal.dot(&plane.normal).abs() < LEAN_COSINE {
        return Fit::No;
    }
    let (height_m, few) = (plane.height_of(&voxels.centers[voxel]).abs(), 1.0 / moments.weight.sqrt());
    let squares = moments.squares_about(&plane.normal, plane.distance) / moments.weight;
    let is_near = height_m <= MEAN_FIXED_M + sigma_m * (MEAN_SIGMAS + MEAN_SIGMAS_OF_MEAN * few);
    let is_thin = squares.sqrt() <= MEAN_FIXED_M + sigma_m * (RMS_SIGMAS + RMS_SIGMAS_OF_MEAN * few);
    if is_near && is_thin {
        Fit::Yes
    } else if window.fullness < FRINGE_FULLNESS && height_m <= FRINGE_SIGMAS * sigma_m {
        Fit::Fringe
    } else {
        Fit::No
    }
}

/// Voxels of nobody's with flat surroundings, the flattest first (in ranks; within one by place).
fn seeds(windows: &[Window], owner: &[u32], sigma_m: f64) -> Vec<u32> {
    let most = (SEED_SIGMAS * sigma_m).powi(2);
    let mut ranks: Vec<Vec<u32>> = vec![Vec::new(); SEED_RANKS];
    for (v, window) in windows.iter().enumerate() {
        let is_free = owner[v] == NONE;
        if is_free && window.is_flat() && window.variance < most && window.fullness >= SEED_FULLNESS {
            ranks[(window.variance / most * SEED_RANKS as f64) as usize].push(v as u32);
        }
    }
    ranks.concat()
}
