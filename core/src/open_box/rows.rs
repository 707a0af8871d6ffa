//! A board on an edge is asked for row by row: what a row's points share is worked out once, and what is plain in single precision is
//! told of four points at once.

use wide::f32x4;

use super::hinge_line::HingeLine;
use super::sight::{side_by_side, Says, Sight, LANES};
use crate::geometry::Vec3;

/// Columns of a row, at most.
pub const MOST_COLUMNS: usize = 12;
/// What is nearer to a bound, metres and pixels, double precision tells: single precision errs by a tenth of it.
const SURE_M: f32 = 5e-5;
const SURE_PX: f32 = 3e-3;
/// Nearer to the camera it errs by more.
const LEAST_DEPTH_M: f32 = 0.2;

/// Rows along an edge, asked at places in columns.
pub struct Rows<'a> {
    sight: &'a Sight<'a>,
    hinge: &'a HingeLine,
    /// How well the board is known.
    model_m: f64,
    columns_m: Vec<f64>,
    /// One metre along the rows, in pixels times depth.
    step: Vec3,
    single: Single,
}

/// What the camera says of a row's points, by bits, and the readings there.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Said {
    pub met: u32,
    pub through: u32,
    pub hidden: u32,
    /// Of what is met.
    pub indices: [u32; MOST_COLUMNS],
}

/// The same numbers for four points at once.
struct Single {
    columns_m: Vec<f32x4>,
    step: [f32x4; 3],
    size: [f32x4; 2],
    others: Others,
    eye_z: f32x4,
    model_m: f32x4,
}

/// Planes on which a reading is another panel's, each with its distance.
struct Others {
    parent: [f32x4; 4],
    off_parent: [f32x4; 4],
    base: [f32x4; 4],
    near_parent_m: f32x4,
}

impl<'a> Rows<'a> {
    /// At no more than so many places.
    pub fn new(sight: &'a Sight<'a>, hinge: &'a HingeLine, model_m: f64, columns_m: Vec<f64>) -> Self {
        let step = sight.place_from_level.times(&hinge.along);
        let single = Single::new(sight, hinge, &step, model_m, &columns_m);
        Self { sight, hinge, model_m, columns_m, step, single }
    }

    pub fn columns(&self) -> usize {
        self.columns_m.len()
    }

    /// Of the row through a point of a surface; the normal is square to the row. A reading of the panel that the edge belongs to, of the
    /// base or of the support is not met.
    #[inline]
    pub fn ask(&self, middle: &Vec3, normal: &Vec3) -> Said {
        let from_eye = middle - self.sight.eye;
        let row = Row {
            place: self.sight.place_from_level.times(&from_eye),
            normal: *normal,
            along: normal.dot(&from_eye),
            from_origin: normal.dot(middle),
        };
        let mut said = Said::default();
        let mut unsure = 0;
        for (block, columns_m) in self.single.columns_m.iter().enumerate() {
            let first = block * LANES;
            let (told, unsure_here) = self.single.ask(self.sight, &row, *columns_m);
            said.met |= told.met << first;
            said.through |= told.through << first;
            said.hidden |= told.hidden << first;
            said.indices[first..first + LANES].copy_from_slice(&told.indices[..LANES]);
            unsure |= unsure_here << first;
        }
        let all = (1 << self.columns_m.len()) - 1;
        unsure &= all;
        (said.met, said.through, said.hidden) = (said.met & all, said.through & all, said.hidden & all);
        while unsure != 0 {
            let column = unsure.trailing_zeros() as usize;
            unsure &= unsure - 1;
            let says = self.ask_one(&row, column, &mut said.indices[column]);
            let bit = |one: Says| u32::from(says == one) << column;
            let others = !(1 << column);
            said.met = said.met & others | bit(Says::Met);
            said.through = said.through & others | bit(Says::Through);
            said.hidden = said.hidden & others | bit(Says::Hidden);
        }
        said
    }

    /// The same of one point, in double precision.
    #[cold]
    fn ask_one(&self, row: &Row, column: usize, at: &mut u32) -> Says {
        let sight = self.sight;
        let Some(index) = sight.index_at(&(row.place + self.step * self.columns_m[column])) else {
            return Says::Outside;
        };
        let Some(look) = sight.look(index) else { return Says::Blank };
        *at = index as u32;
        match look.says(row.normal.dot(&look.at()) - row.from_origin, row.along, self.model_m) {
            Says::Met if self.hinge.is_of_others(sight.eye.z, look, self.model_m) => Says::Blank,
            says => says,
        }
    }
}

/// What a row's points share.
struct Row {
    place: Vec3,
    normal: Vec3,
    /// From the eye along the normal.
    along: f64,
    from_origin: f64,
}

impl Single {
    fn new(sight: &Sight, hinge: &HingeLine, step: &Vec3, model_m: f64, columns_m: &[f64]) -> Self {
        let block = |of: &[f64]| f32x4::new(std::array::from_fn(|lane| of.get(lane).map_or(0.0, |at| *at as f32)));
        let plane =
            |(normal, distance): (Vec3, f64)| [splat(normal.x), splat(normal.y), splat(normal.z), splat(distance)];
        let [parent, off_parent, base] = hinge.others().map(plane);
        Self {
            columns_m: columns_m.chunks(LANES).map(block).collect(),
            step: [step.x, step.y, step.z].map(splat),
            size: [splat(sight.width as f64), splat(sight.height as f64)],
            others: Others { parent, off_parent, base, near_parent_m: splat(model_m + HingeLine::HALF_BOARD_M) },
            eye_z: splat(sight.eye.z),
            model_m: splat(model_m),
        }
    }

    /// Of four points, and of which of them it is not sure.
    #[inline(always)]
    fn ask(&self, sight: &Sight, row: &Row, columns_m: f32x4) -> (Said, u32) {
        let (zero, half, sure_m) = (f32x4::ZERO, f32x4::splat(0.5), f32x4::splat(SURE_M));
        let at = |axis: usize| splat(row.place[axis]) + self.step[axis] * columns_m;
        let (u, v, depth) = (at(0), at(1), at(2));
        let inverse = f32x4::splat(1.0) / depth;
        let (x, y) = (u * inverse + half, v * inverse + half);
        let is_inside = x.simd_gt(zero) & y.simd_gt(zero) & x.simd_lt(self.size[0]) & y.simd_lt(self.size[1]);
        let (column, line) = (x.fast_trunc_int(), y.fast_trunc_int());
        // How far from the next pixel.
        let off_px = |x: f32x4, whole: f32x4| (x - whole - half).abs();
        let off_px = off_px(x, column.round_float()).fast_max(off_px(y, line.round_float()));
        let mut unsure = off_px.simd_gt(half - f32x4::splat(SURE_PX)) | depth.simd_lt(f32x4::splat(LEAST_DEPTH_M));
        let (inside, column, line) = (is_inside.to_bitmask(), column.to_array(), line.to_array());
        let indices: [u32; LANES] = std::array::from_fn(|lane| {
            if inside >> lane & 1 == 1 {
                line[lane] as u32 * sight.width as u32 + column[lane] as u32
            } else {
                0
            }
        });
        let [x, y, z, noise] = side_by_side(indices.map(|index| &sight.looks[index as usize]));
        let is_reading = is_inside & x.simd_eq(x);
        let normal = [row.normal.x, row.normal.y, row.normal.z].map(splat);
        let off = normal[0] * x + normal[1] * y + normal[2] * z - splat(row.from_origin);
        let tolerance = noise * splat(row.along.abs()) + self.model_m;
        let beyond = off.abs() - tolerance;
        unsure |= beyond.abs().simd_lt(sure_m);
        let of_others = self.others.within(&[x, y, z], noise * (z - self.eye_z).abs() + self.model_m);
        let is_on = beyond.simd_lt(zero);
        unsure |= is_on & of_others.abs().simd_lt(sure_m);
        let (is_on, is_reading) = (is_on.to_bitmask(), is_reading.to_bitmask());
        let behind = if row.along > 0.0 { off.simd_gt(zero) } else { off.simd_lt(zero) }.to_bitmask();
        let off = is_reading & !is_on;
        let met = is_reading & is_on & of_others.simd_lt(zero).to_bitmask();
        let mut said = Said { met, through: off & behind, hidden: off & !behind, ..Said::default() };
        said.indices[..LANES].copy_from_slice(&indices);
        (said, unsure.to_bitmask())
    }
}

impl Others {
    /// How far within what takes them readings lie, negative outside; `tolerance` is theirs off level planes.
    #[inline(always)]
    fn within(&self, [x, y, z]: &[f32x4; 3], tolerance: f32x4) -> f32x4 {
        let height = |[a, b, c, distance]: &[f32x4; 4]| *a * *x + *b * *y + *c * *z - *distance;
        let on_parent = height(&self.parent).fast_min(self.near_parent_m - height(&self.off_parent).abs());
        let on_ground = tolerance - z.abs().fast_min(height(&self.base).abs());
        on_parent.fast_max(on_ground)
    }
}

fn splat(number: f64) -> f32x4 {
    f32x4::splat(number as f32)
}

#[cfg(test)]
mod tests {
    use nalgebra::Isometry3;

    use super::super::sight::Reading;
    use super::*;
    use crate::cloud::CloudView;
    use crate::fit::{layout, FittedBody, Parameters};
    use crate::geometry::SplitMix64;
    use crate::perception::readings::Readings;
    use crate::perception::PerceptionSettings;

    #[test]
    fn rows_say_what_their_points_say() {
        // A wavy floor before a pinhole camera, with holes.
        let (width, height, focal) = (160, 120, 130.0_f32);
        let place = |i: usize| {
            let (u, v) = ((i % width) as f32, (i / width) as f32);
            let z = match i % 11 {
                0 => f32::NAN,
                _ => 1.2 + 0.02 * (u / 7.0).sin() * (v / 5.0).cos(),
            };
            [(u - 80.0) / focal * z, (v - 60.0) / focal * z, z]
        };
        let points: Vec<[f32; 3]> = (0..width * height).map(place).collect();
        let cloud = CloudView { points: &points, width, height, viewpoint: Some(Vec3::zeros()) };
        let settings = PerceptionSettings::default();
        let readings = Readings::new(&cloud, &settings);
        let sight = Sight::in_level(&cloud, &readings, Isometry3::identity()).unwrap();
        let mut numbers = Parameters::zeros();
        let lengths = [(layout::LENGTH, 0.4), (layout::WIDTH, 0.3), (layout::HEIGHT, 0.05)];
        lengths.iter().for_each(|&(place, length_m)| numbers[place] = length_m);
        let mut random = SplitMix64::new(3);
        let mut draw = |low: f64, high: f64| low + random.unit() * (high - low);
        let mut counts = [0; 6];
        for case in 0..800 {
            let turn = Vec3::new(draw(-0.5, 0.5), draw(-0.5, 0.5), draw(-3.0, 3.0));
            let shift = Vec3::new(draw(-0.6, 0.6), draw(-0.4, 0.4), draw(1.1, 1.2));
            let body = FittedBody { input_from_object: Isometry3::new(shift, turn), numbers };
            let hinge = HingeLine::of_side(&body, case % 4);
            let columns_m: Vec<f64> =
                (0..if case % 2 == 0 { 12 } else { 6 }).map(|i| 0.02 * (f64::from(i) - 5.5)).collect();
            let normal = hinge.along.cross(&Vec3::new(draw(-1.0, 1.0), draw(-1.0, 1.0), draw(-1.0, 1.0))).normalize();
            let middle = Vec3::new(draw(-0.8, 0.8), draw(-0.6, 0.6), draw(1.15, 1.25));
            let said = Rows::new(&sight, &hinge, 0.004, columns_m.clone()).ask(&middle, &normal);
            for (column, column_m) in columns_m.iter().enumerate() {
                let (says, look) = sight.ask(&(middle + hinge.along * *column_m), &normal, 0.004);
                let is_of_others = look.is_some_and(|look| hinge.is_of_others(sight.eye.z, look, 0.004));
                let is_met = says == Says::Met && !is_of_others;
                let expected = [is_met, says == Says::Through, says == Says::Hidden];
                let told = [said.met, said.through, said.hidden].map(|bits| bits >> column & 1 == 1);
                assert_eq!(told, expected, "{case} {column}");
                if is_met {
                    assert_eq!(sight.reading(said.indices[column] as usize), look.map(Reading::at));
                }
                counts[if says == Says::Met && is_of_others { 5 } else { says as usize }] += 1;
            }
        }
        assert_eq!(counts.iter().sum::<usize>(), 7200);
        assert!(counts.iter().all(|count| *count > 50), "{counts:?}");
    }
}
