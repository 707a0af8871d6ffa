use super::super::readings::Readings;
use super::super::scene::EdgeKind;
use super::exits::Exit;
use super::SegmentImage;
use crate::geometry::{Plane, Vec3};

/// How many pixels beyond a segment's boundary are looked at for a reading.
const REACH_PX: usize = 12;
/// Sensors leave the image's outermost columns and rows without readings: up to this share of its width or height.
const MAX_MARGIN_SHARE: f64 = 0.06;
/// A reading off every segment counts where the next one lies within this share of the way to it: else it may hang in the
/// air between two surfaces.
const STRAY_SHARE: f64 = 1.0 / 3.0;

/// What lies beyond the boundary of segments.
pub struct Beyond<'a> {
    readings: &'a Readings<'a>,
    image: &'a SegmentImage<'a>,
    planes: Vec<Plane>,
    support: Option<Plane>,
    /// The columns and rows, low to high (exclusive), in which the sensor measures.
    columns: (isize, isize),
    rows: (isize, isize),
}

impl<'a> Beyond<'a> {
    /// `None` where nobody knows from where the image was seen.
    pub fn new(
        readings: &'a Readings<'a>,
        image: &'a SegmentImage<'a>,
        planes: &[Plane],
        support: Option<&Plane>,
    ) -> Option<Self> {
        let viewpoint = readings.viewpoint?;
        let facing = |p: &Plane| if p.height_of(&viewpoint) < 0.0 { p.flipped() } else { *p };
        let (width, height) = (image.width, image.height);
        let measured = |pixel: usize| readings.is_reading(pixel as u32);
        let columns = measured_span(width, |u| (0..height).any(|v| measured(v * width + u)));
        let rows = measured_span(height, |v| (0..width).any(|u| measured(v * width + u)));
        let planes = planes.iter().map(facing).collect();
        Some(Self { readings, image, planes, support: support.map(facing), columns, rows })
    }

    /// What ends the segment there (eq. 39), `None` where it goes on after a gap.
    pub fn kind(&self, exit: &Exit) -> Option<EdgeKind> {
        let own = &self.planes[exit.segment];
        let last = self.readings.point(exit.pixel as u32);
        let tolerance_m = self.readings.tolerance_m(&last);
        let (mut column, mut row) = (exit.column as isize, exit.row as isize);
        for _ in 0..REACH_PX {
            (column, row) = (column + exit.step.0, row + exit.step.1);
            let Some(pixel) = self.pixel(column, row) else { return Some(EdgeKind::Border) };
            let Some(reading) = self.reading(pixel) else { continue };
            let label = self.image.labels[pixel];
            if label == exit.segment as i32 {
                return None;
            }
            let height_m = own.height_of(&reading);
            if let Some(other) = self.surface(label, &reading) {
                return Some(self.meeting(&last, other.height_of(&last), &reading, height_m, tolerance_m));
            }
            let next = self.pixel(column + exit.step.0, row + exit.step.1).and_then(|pixel| self.reading(pixel));
            let steady_m = tolerance_m.max(STRAY_SHARE * (reading - last).norm());
            if height_m.abs() > tolerance_m && next.is_some_and(|next| (next - reading).norm() <= steady_m) {
                return Some(if height_m > 0.0 { EdgeKind::Occluded } else { EdgeKind::Edge });
            }
        }
        Some(EdgeKind::Edge)
    }

    /// The segment's last reading lies `last_height_m` over the other's plane, the other's first `first_height_m` over the
    /// segment's; normals look at the viewpoint.
    fn meeting(
        &self,
        last: &Vec3,
        last_height_m: f64,
        first: &Vec3,
        first_height_m: f64,
        tolerance_m: f64,
    ) -> EdgeKind {
        if first_height_m < -tolerance_m && last_height_m > tolerance_m {
            return EdgeKind::Edge;
        }
        if first_height_m > tolerance_m && last_height_m < -tolerance_m {
            return EdgeKind::Occluded;
        }
        if (first - last).norm() <= self.readings.cluster_gap_m() + tolerance_m {
            EdgeKind::Crease
        } else if first_height_m > tolerance_m {
            EdgeKind::Occluded
        } else {
            EdgeKind::Edge
        }
    }

    /// The plane of the segment that a reading belongs to, or the support where that is none.
    fn surface(&self, label: i32, reading: &Vec3) -> Option<&Plane> {
        match usize::try_from(label) {
            Ok(segment) => Some(&self.planes[segment]),
            Err(_) => {
                let on = |p: &&Plane| p.height_of(reading).abs() <= self.readings.tolerance_m(reading);
                self.support.as_ref().filter(on)
            }
        }
    }

    fn pixel(&self, column: isize, row: isize) -> Option<usize> {
        let within = |x: isize, (low, high): (isize, isize)| low <= x && x < high;
        (within(column, self.columns) && within(row, self.rows))
            .then(|| row as usize * self.image.width + column as usize)
    }

    fn reading(&self, pixel: usize) -> Option<Vec3> {
        self.readings.is_reading(pixel as u32).then(|| self.readings.point(pixel as u32))
    }
}

/// From the first to behind the last of `count` lines that hold a reading; lines far from the image's edge all count.
fn measured_span(count: usize, holds_reading: impl Fn(usize) -> bool) -> (isize, isize) {
    let most = (MAX_MARGIN_SHARE * count as f64) as usize;
    let empty = |line: &usize| !holds_reading(*line);
    let low = (0..most).take_while(empty).count();
    let high = count - (0..most).map(|k| count - 1 - k).take_while(empty).count();
    (low as isize, high as isize)
}
