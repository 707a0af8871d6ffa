//! Which panel of a body each reading lies on.

use super::faces::{Faces, On};
use super::footprints::Footprints;
use super::labels::{roles, Labels, Present};
use super::sight::{Sight, Turn, LANES};
use super::silhouette::Silhouette;
use super::surfaces::Surface;
use crate::fit::{layout, FittedBody, Rim, Role};
use crate::geometry::Vec3;

/// Every reading near the body, given to the panel whose face it is nearest to, in units of what it may lie off.
///
/// Of every `stride`-th column and row.
pub fn label(sight: &Sight, body: &FittedBody, present: &Present, model_m: f64, stride: usize) -> Labels {
    let roles = roles(present);
    let mut parts: Vec<(Role, Vec<u32>)> = roles.iter().map(|role| (*role, Vec::new())).collect();
    let (low, high) = object_bounds(body, present);
    let Some((outline, [left, right, top, bottom])) = bounds(sight, body, &low, &high) else {
        return Labels { parts, stride };
    };
    let panels = panels(sight, body, present);
    let faces = Faces::of(sight, body, &panels, [&low, &high], model_m);
    let exact = Exact { sight, panels: &panels, to_object: ToObject::of(body), low, high, model_m };
    let mut footprints = Footprints::of(sight, body, &panels, model_m);
    for row in (top..=bottom).step_by(stride) {
        let [first, last] = outline.columns(row as f64);
        let skipped = ((first - left as f64) / stride as f64).ceil().clamp(0.0, sight.width as f64);
        let first = left + skipped as usize * stride;
        let last = last.clamp(0.0, right as f64) as usize;
        if first > last {
            continue;
        }
        let (of_row, [from, to]) = footprints.of_row(row, [first, last]);
        let from = first + from.saturating_sub(first).div_ceil(stride) * stride;
        for column in (from..to + 1).step_by(stride * LANES) {
            // The last of a row's columns as often as it takes.
            let columns: [usize; LANES] = std::array::from_fn(|lane| (column + lane * stride).min(to));
            let may_be = columns.iter().fold(0, |bits, &column| bits | of_row[column]);
            if may_be == 0 {
                continue;
            }
            let indices = columns.map(|column| row * sight.width + column);
            let on = faces.nearest(indices.map(|index| sight.look_or_blank(index)), u32::from(may_be));
            let count = (to - column) / stride + 1;
            for (index, on) in indices.into_iter().zip(on).take(count) {
                let number = match on {
                    On::Nothing => None,
                    On::Panel(number) => Some(number),
                    On::Unsure => exact.nearest(index),
                };
                if let Some(number) = number {
                    parts[number].1.push(index as u32);
                }
            }
        }
    }
    Labels { parts, stride }
}

fn panels(sight: &Sight, body: &FittedBody, present: &Present) -> Vec<Surface> {
    let panel = |role: Role| Surface::new(sight, body, role).seen_from_edge(present.is_thin(role));
    roles(present).into_iter().map(panel).collect()
}

/// Readings one by one, in double precision.
struct Exact<'a> {
    sight: &'a Sight<'a>,
    panels: &'a [Surface],
    to_object: ToObject,
    low: Vec3,
    high: Vec3,
    model_m: f64,
}

struct ToObject {
    turn: Turn,
    shift: Vec3,
}

impl ToObject {
    fn of(body: &FittedBody) -> Self {
        let inverse = body.input_from_object.inverse();
        Self { turn: Turn::of(inverse.rotation.to_rotation_matrix().matrix()), shift: inverse.translation.vector }
    }
}

impl Exact<'_> {
    /// The panel that a reading lies on.
    fn nearest(&self, index: usize) -> Option<usize> {
        let (sight, model_m) = (self.sight, self.model_m);
        let look = sight.look(index)?;
        let point = look.at();
        let q = self.to_object.turn.times(&point) + self.to_object.shift;
        if (0..3).any(|a| q[a] < self.low[a] || q[a] > self.high[a]) {
            return None;
        }
        let (ray, sigma3) = (point - sight.eye, look.noise());
        // The support takes what it is nearest to, but for the base upon it.
        let on_support = point.z.abs() / (sigma3 * ray.z.abs() + model_m);
        let mut best = (on_support.min(1.0), None);
        for (number, panel) in self.panels.iter().enumerate() {
            let Some((off, reach)) = panel.off(&q, &ray) else { continue };
            let share = off.abs() / (sigma3 * reach + model_m);
            if share < best.0 || (panel.role() == Role::Base && share < 1.0 && best.1.is_none()) {
                best = (share, Some(number));
            }
        }
        best.1
    }
}

/// Lowest and highest coordinates that a body reaches in its own frame.
fn object_bounds(body: &FittedBody, present: &Present) -> (Vec3, Vec3) {
    let (l, w, h) = (body.get(layout::LENGTH), body.get(layout::WIDTH), body.get(layout::HEIGHT));
    let rack = body.get(layout::RACK).tan().abs() * w / 2.0;
    let margin = 0.02;
    let mut low = Vec3::new(-l / 2.0 - rack - margin, -w / 2.0 - margin, -margin);
    let mut high = Vec3::new(l / 2.0 + rack + margin, w / 2.0 + margin, h + margin);
    for k in (0..4).filter(|&k| present.flaps[k]) {
        let tuck = if present.tucks[k] { body.get(layout::tuck(k) + layout::TUCK_LENGTH) } else { 0.0 };
        let reach = body.get(layout::flap(k) + layout::FLAP_LENGTH) + tuck + margin;
        let rim = Rim::new(body, k);
        let (along, inward) = rim.directions();
        let angle = body.get(layout::flap(k) + layout::FLAP_ANGLE);
        let free = (inward * angle.cos() + Vec3::z() * angle.sin()) * reach;
        let aside = along * (body.get(layout::flap(k) + layout::FLAP_WIDTH) / 2.0 + margin);
        for side in [-1.0, 1.0] {
            let corner = rim.place(0.0, 0.0, 0.0) + free + aside * side;
            let bow = 0.03 + tuck;
            low = low.zip_map(&(corner - Vec3::repeat(bow)), f64::min);
            high = high.zip_map(&(corner + Vec3::repeat(bow)), f64::max);
        }
    }
    (low, high)
}

/// Of what lies between two corners of the object's frame: its outline in the image, and left, right, top, bottom, inclusive.
fn bounds(sight: &Sight, body: &FittedBody, low: &Vec3, high: &Vec3) -> Option<(Silhouette, [usize; 4])> {
    let ends = [low, high];
    let corner = |[i, j, k]: [usize; 3]| Vec3::new(ends[i].x, ends[j].y, ends[k].z);
    let outline = Silhouette::of(|of| sight.pixel(&body.to_input(&corner(of))))?;
    let bounds = outline.bounds();
    let cell = |at: f64, count: usize| at.clamp(0.0, count as f64 - 1.0) as usize;
    let (width, height) = (sight.width, sight.height);
    let is_seen = bounds[1] >= 0.0 && bounds[0] < width as f64 && bounds[3] >= 0.0 && bounds[2] < height as f64;
    let cells = [cell(bounds[0], width), cell(bounds[1], width), cell(bounds[2], height), cell(bounds[3], height)];
    is_seen.then_some((outline, cells))
}

#[cfg(test)]
mod tests {
    use nalgebra::Isometry3;

    use super::*;
    use crate::cloud::CloudView;
    use crate::fit::Parameters;
    use crate::geometry::SplitMix64;
    use crate::perception::readings::Readings;
    use crate::perception::PerceptionSettings;

    #[test]
    fn readings_are_given_to_the_panels_that_each_by_itself_lies_on() {
        // A wavy floor before a pinhole camera, with holes.
        let (width, height, focal) = (200, 150, 170.0_f32);
        let place = |i: usize| {
            let (u, v) = ((i % width) as f32, (i / width) as f32);
            let z = match i % 17 {
                0 => f32::NAN,
                _ => 1.2 + 0.03 * (u / 9.0).sin() * (v / 7.0).cos(),
            };
            [(u - 100.0) / focal * z, (v - 75.0) / focal * z, z]
        };
        let points: Vec<[f32; 3]> = (0..width * height).map(place).collect();
        let cloud = CloudView { points: &points, width, height, viewpoint: Some(Vec3::zeros()) };
        let settings = PerceptionSettings::default();
        let readings = Readings::new(&cloud, &settings);
        let mut random = SplitMix64::new(5);
        let mut draw = |low: f64, high: f64| low + random.unit() * (high - low);
        let (mut of_bases, mut of_sides, mut of_flaps, mut of_tucks) = (0, 0, 0, 0);
        for case in 0..120 {
            // Some upon a support that is the floor, most above one.
            let support_m = if case % 3 == 0 { 1.2 } else { 0.0 };
            let sight = Sight::in_level(&cloud, &readings, Isometry3::translation(0.0, 0.0, support_m)).unwrap();
            let mut numbers = Parameters::zeros();
            let dimensions = [(layout::LENGTH, 0.4), (layout::WIDTH, 0.3), (layout::HEIGHT, 0.2)];
            dimensions.iter().for_each(|&(place, most)| numbers[place] = draw(0.3 * most, most));
            (numbers[layout::RACK], numbers[layout::THICKNESS]) = (draw(-0.05, 0.05), draw(-0.001, 0.006));
            for k in 0..4 {
                numbers[layout::bulge(k)] = draw(-0.01, 0.01);
                let flap = [
                    (layout::FLAP_LENGTH, 0.05, 0.3),
                    (layout::FLAP_WIDTH, 0.1, 0.4),
                    (layout::FLAP_TAPER, -0.01, 0.03),
                    (layout::FLAP_OFFSET, -0.02, 0.02),
                    (layout::FLAP_ANGLE, -0.3, 4.3),
                    (layout::FLAP_CURL, -2.0, 2.0),
                ];
                flap.iter().for_each(|&(at, low, high)| numbers[layout::flap(k) + at] = draw(low, high));
                let tuck =
                    [(layout::TUCK_ANGLE, -1.5, 1.5), (layout::TUCK_LENGTH, 0.02, 0.1), (layout::TUCK_WIDTH, 0.1, 0.4)];
                tuck.iter().for_each(|&(at, low, high)| numbers[layout::tuck(k) + at] = draw(low, high));
            }
            let turn = Vec3::new(draw(-0.6, 0.6), draw(-0.6, 0.6), draw(-3.0, 3.0));
            let shift = Vec3::new(draw(-0.3, 0.3), draw(-0.3, 0.3), draw(1.05, 1.2) - support_m);
            let body = FittedBody { input_from_object: Isometry3::new(shift, turn), numbers };
            let some = |n: usize| std::array::from_fn(|k| (case + k) % n != 0);
            let present = Present { flaps: some(3), tucks: some(2), thin: some(5) };
            let panels = panels(&sight, &body, &present);
            let (low, high) = object_bounds(&body, &present);
            let exact =
                Exact { sight: &sight, panels: &panels, to_object: ToObject::of(&body), low, high, model_m: 0.004 };
            let mut expected: Vec<Vec<u32>> = vec![Vec::new(); panels.len()];
            (0..width * height)
                .filter_map(|i| Some((i, exact.nearest(i)?)))
                .for_each(|(i, number)| expected[number].push(i as u32));
            let labels = label(&sight, &body, &present, 0.004, 1);
            let coarse = label(&sight, &body, &present, 0.004, 3);
            for ((told, few), expected) in labels.parts.iter().zip(&coarse.parts).zip(&expected) {
                assert_eq!(&told.1, expected, "{case} {:?}", told.0);
                assert!(few.1.iter().all(|point| expected.contains(point)), "{case} {:?}", told.0);
                *match told.0 {
                    Role::Base => &mut of_bases,
                    Role::Side(_) => &mut of_sides,
                    Role::Flap(_) => &mut of_flaps,
                    Role::Tuck(_) => &mut of_tucks,
                } += expected.len();
            }
            let sum = |labels: &Labels| labels.parts.iter().map(|(_, points)| points.len()).sum::<usize>() as f64;
            assert!((9.0 * sum(&coarse) - sum(&labels)).abs() < 150.0 + 0.3 * sum(&labels), "{case}");
        }
        let counts = [of_bases, of_sides, of_flaps, of_tucks];
        assert!(counts.iter().all(|count| *count > 1500), "{counts:?}");
    }
}
