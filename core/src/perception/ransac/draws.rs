//! Planes of a set of sites, one after another (Fischler and Bolles 1981; triples from a neighbourhood: Schnabel et al. 2007).

use super::super::PerceptionSettings;
use super::components::{components, NONE};
use super::sites::Sites;
use crate::geometry::{Moments, Plane, SplitMix64, Vec3};

/// Hypotheses of a draw that are refined and compared by their largest piece.
const FINALISTS: usize = 4;
const REFITS: usize = 3;
/// Steps away from the first site at which the two others are looked for.
const TRIES: usize = 12;

/// A plane and the connected sites that lie on it.
#[derive(Debug, Clone)]
pub struct SitePlane {
    pub plane: Plane,
    pub sites: Vec<u32>,
}

/// How planes are searched in one set of sites.
pub struct PlaneSearch<'a> {
    pub sites: &'a Sites,
    pub settings: &'a PerceptionSettings,
    pub reach_m: f64,
    /// Worth of a site: its readings, or 1 where area counts.
    pub worth: Vec<f64>,
    pub min_worth: f64,
    pub max_planes: usize,
    pub seed: u64,
}

impl PlaneSearch<'_> {
    /// The planes found, each with its largest connected piece; the rest of its inliers goes back to the pool.
    pub fn run(&self) -> Vec<SitePlane> {
        let mut rng = SplitMix64::new(self.seed);
        let mut free = vec![true; self.sites.len()];
        let mut found = Vec::new();
        let mut failures = 0;
        while found.len() < self.max_planes && failures < 2 {
            match self.best_plane(&free, &mut rng) {
                Some(plane) => {
                    plane.sites.iter().for_each(|&s| free[s as usize] = false);
                    found.push(plane);
                }
                None => failures += 1,
            }
        }
        found
    }

    fn best_plane(&self, free: &[bool], rng: &mut SplitMix64) -> Option<SitePlane> {
        let pool: Vec<u32> = (0..self.sites.len() as u32).filter(|&s| free[s as usize]).collect();
        if pool.iter().map(|&s| self.worth[s as usize]).sum::<f64>() < self.min_worth {
            return None;
        }
        let finalists = self.finalists(&pool, free, rng);
        let refined = finalists.iter().filter_map(|plane| self.refine(plane, free));
        refined.fold(None, |best: Option<SitePlane>, candidate| match best {
            Some(b) if self.worth_of(&b.sites) >= self.worth_of(&candidate.sites) => Some(b),
            _ => Some(candidate),
        })
    }

    /// The hypotheses with the most inliers, best first.
    fn finalists(&self, pool: &[u32], free: &[bool], rng: &mut SplitMix64) -> Vec<Plane> {
        let mut best: Vec<(f64, Plane)> = Vec::with_capacity(FINALISTS + 1);
        for _ in 0..self.settings.ransac_draws {
            let Some(plane) = self.draw(pool, free, rng) else { continue };
            let worth = self.inlier_worth(&plane, pool);
            let place = best.partition_point(|(w, _)| *w >= worth);
            if worth >= self.min_worth && place < FINALISTS {
                best.insert(place, (worth, plane));
                best.truncate(FINALISTS);
            }
        }
        best.into_iter().map(|(_, plane)| plane).collect()
    }

    /// The plane through a site and two others within reach, if its normal agrees with the first site's.
    fn draw(&self, pool: &[u32], free: &[bool], rng: &mut SplitMix64) -> Option<Plane> {
        let first = pool[rng.below(pool.len())] as usize;
        let second = self.site_near(first, free, rng)?;
        let third = self.site_near(first, free, rng)?;
        let at = |s: usize| self.sites.surfels.centers[s];
        let (a, b) = (at(second) - at(first), at(third) - at(first));
        let cross = a.cross(&b);
        // Slivers: less than about 17 degrees between the two arms.
        if cross.norm_squared() < 0.09 * a.norm_squared() * b.norm_squared() || cross.norm_squared() == 0.0 {
            return None;
        }
        let normal = cross.normalize();
        let plane = Plane { normal, distance: normal.dot(&at(first)) };
        self.agrees(&plane, first).then_some(plane)
    }

    fn site_near(&self, first: usize, free: &[bool], rng: &mut SplitMix64) -> Option<usize> {
        let reach = (self.reach_m / self.sites.voxels.size_m).ceil().max(1.0) as i32;
        let [x, y, z] = self.sites.voxels.cells[first];
        let mut step = || rng.below(2 * reach as usize + 1) as i32 - reach;
        for _ in 0..TRIES {
            // Along the surface where it is known: a cell of the box around would mostly be empty.
            let offset = Vec3::new(f64::from(step()), f64::from(step()), f64::from(step()));
            let normal = &self.sites.surfels.normals[first];
            let flat = offset - normal * normal.dot(&offset);
            let [dx, dy, dz] = [flat.x.round() as i32, flat.y.round() as i32, flat.z.round() as i32];
            if let Some(found) = self.sites.voxels.find([x + dx, y + dy, z + dz]) {
                if found as usize != first && free[found as usize] {
                    return Some(found as usize);
                }
            }
        }
        None
    }

    fn inlier_worth(&self, plane: &Plane, pool: &[u32]) -> f64 {
        pool.iter().filter(|&&s| self.is_inlier(plane, s as usize)).map(|&s| self.worth[s as usize]).sum()
    }

    fn worth_of(&self, sites: &[u32]) -> f64 {
        sites.iter().map(|&s| self.worth[s as usize]).sum()
    }

    fn is_inlier(&self, plane: &Plane, site: usize) -> bool {
        plane.height_of(&self.sites.surfels.centers[site]).abs() <= self.sites.surfels.tolerance_m[site]
            && self.agrees(plane, site)
    }

    /// Whether the site's surroundings are not known to lean away from the plane.
    fn agrees(&self, plane: &Plane, site: usize) -> bool {
        let normal = &self.sites.surfels.normals[site];
        *normal == Vec3::zeros() || normal.dot(&plane.normal).abs() >= self.settings.normal_tolerance_rad.cos()
    }

    /// Least squares over the largest piece of the inliers, again and again.
    pub fn refine(&self, start: &Plane, free: &[bool]) -> Option<SitePlane> {
        let mut plane = *start;
        let mut result = None;
        for _ in 0..REFITS {
            let piece = self.largest_piece(&plane, free);
            if self.worth_of(&piece) < self.min_worth {
                return None;
            }
            let mut moments = Moments::default();
            piece.iter().for_each(|&s| moments.add(&self.sites.moments[s as usize]));
            (plane, _) = moments.fit_plane()?;
            result = Some(SitePlane { plane, sites: piece });
        }
        result
    }

    fn largest_piece(&self, plane: &Plane, free: &[bool]) -> Vec<u32> {
        let (component, count) = components(&self.sites.surfels.neighbours, |s| free[s] && self.is_inlier(plane, s));
        let mut worth = vec![0.0; count];
        for (s, &c) in component.iter().enumerate().filter(|(_, &c)| c != NONE) {
            worth[c as usize] += self.worth[s];
        }
        let best = (0..count).fold(0, |best, c| if worth[c] > worth[best] { c } else { best });
        (0..component.len() as u32).filter(|&s| component[s as usize] as usize == best && count > 0).collect()
    }
}
