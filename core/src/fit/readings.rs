//! What the segments of a box's parts tell of it: readings on faces, and where panels end.

use super::body::FittedBody;
use super::panel::{outward_coordinate, Panel};
use super::roles::Role;
use super::sensor::Sensor;
use super::settings::FitSettings;
use crate::geometry::{Rectangle, Vec3};
use crate::perception::EdgeKind;

/// The readings of one part.
#[derive(Debug, Clone, Copy)]
pub struct PartSegment<'a> {
    pub role: Role,
    /// Towards the viewpoint where there is one.
    pub normal: Vec3,
    pub center: Vec3,
    pub ends: PartEnds<'a>,
    /// Indices into the cloud.
    pub points: &'a [u32],
}

/// What ends a part at each of its ends.
#[derive(Debug, Clone, Copy)]
pub enum PartEnds<'a> {
    /// As perception says of the sides of the segment's rectangle.
    OfRectangle(&'a Rectangle, [EdgeKind; 4]),
    /// End by end; `None` where nothing does, or its readings do not tell where.
    Told([Option<EdgeKind>; 4]),
}

impl PartEnds<'_> {
    fn are_told(&self) -> bool {
        !matches!(self, Self::Told([None, None, None, None]))
    }

    /// Of the end that lies that way.
    fn kind(&self, end: usize, outward: &Vec3) -> Option<EdgeKind> {
        match self {
            Self::OfRectangle(rectangle, edges) => Some(edges[rectangle_side(rectangle, outward)]),
            Self::Told(kinds) => kinds[end],
        }
    }
}

/// A reading that lies on the part's face.
#[derive(Debug, Clone, Copy)]
pub struct FaceReading {
    pub point: Vec3,
    pub sigma_m: f64,
}

/// The outermost reading of a strip across one of the part's ends; the end lies `reach_m` beyond it, or farther where
/// something hides it.
#[derive(Debug, Clone, Copy)]
pub struct EndReading {
    pub point: Vec3,
    pub end: usize,
    pub reach_m: f64,
    pub sigma_m: f64,
    pub is_least: bool,
    pub information: f64,
}

/// All that one part's readings tell.
#[derive(Debug, Clone)]
pub struct PartReadings {
    pub role: Role,
    /// Half boards from the middle to the face that is seen: 1 or -1 along the panel's normal, 0 where nobody knows.
    pub face: f64,
    pub faces: Vec<FaceReading>,
    /// What one reading on the face counts, of 1: they share errors.
    pub face_information: f64,
    pub ends: Vec<EndReading>,
}

impl PartReadings {
    pub fn new(segment: &PartSegment, start: &FittedBody, sensor: &Sensor, settings: &FitSettings) -> Self {
        let panel = Panel::new(start, segment.role);
        let face = if sensor.viewpoint.is_some() { facing(&panel, start, &segment.normal) } else { 0.0 };
        let count = segment.points.len();
        let taken = count.min(settings.face_samples);
        // In the order of the image the same steps go over the whole of it.
        let faces: Vec<FaceReading> = (0..taken)
            .map(|i| sensor.point(segment.points[(2 * i + 1) * count / (2 * taken)]))
            .map(|point| FaceReading { point, sigma_m: sensor.sigma_m(&point, &segment.normal, settings) })
            .collect();
        let information = (count as f64 / settings.readings_that_agree).min(settings.most_face_information);
        let told = if segment.ends.are_told() { segment.points } else { &[] };
        let coordinates = Coordinates::new(told, panel.axes().map(|axis| start.input_from_object * axis), sensor);
        let ends = (0..4).flat_map(|end| end_readings(segment, &coordinates, sensor, settings, end));
        // Those of a segment are one surface's; those near a side that was only asked for may be its neighbour's.
        let is_asked_side = matches!((segment.ends, segment.role), (PartEnds::Told(_), Role::Side(_)));
        let tells = |reading: &EndReading| !is_asked_side || covered(&panel, start, reading, face) > LEAST_COVERED;
        let ends = ends.filter(tells).collect();
        Self { role: segment.role, face, faces, face_information: information / taken.max(1) as f64, ends }
    }
}

fn facing(panel: &Panel, start: &FittedBody, normal: &Vec3) -> f64 {
    if (start.input_from_object * panel.normal()).dot(normal) >= 0.0 {
        1.0
    } else {
        -1.0
    }
}

/// Readings that reach over less of a side do not tell where that ends: they are of its neighbour, which it meets where they are.
const LEAST_COVERED: f64 = 0.3;

/// How far along the way from the end across to its own a reading lies, share of that way.
fn covered(panel: &Panel, body: &FittedBody, reading: &EndReading, face: f64) -> f64 {
    let place = body.to_object(&reading.point);
    let beyond = |end: usize| panel.beyond(&place, end, face).value;
    let across = beyond(reading.end ^ 1);
    across / (across + beyond(reading.end))
}

/// Strips are at least this wide, pixels.
const STRIP_PX: f64 = 3.0;
/// Left out of an end where it meets its neighbours, share of its length.
const CORNER_SHARE: f64 = 0.06;
const LEAST_READINGS_OF_STRIP: usize = 3;

/// Readings of a part along the two directions in which it reaches: all of its ends ask for them.
struct Coordinates {
    axes: [Vec3; 2],
    along: [Vec<f64>; 2],
    /// Least and most of them.
    spans: [[f64; 2]; 2],
}

impl Coordinates {
    fn new(points: &[u32], axes: [Vec3; 2], sensor: &Sensor) -> Self {
        let mut along = [Vec::with_capacity(points.len()), Vec::with_capacity(points.len())];
        let mut spans = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
        for &index in points {
            let point = sensor.point(index);
            for ((axis, along), span) in axes.iter().zip(&mut along).zip(&mut spans) {
                let at = point.dot(axis);
                along.push(at);
                *span = [if at < span[0] { at } else { span[0] }, if at > span[1] { at } else { span[1] }];
            }
        }
        Self { axes, along, spans }
    }
}

fn end_readings(
    segment: &PartSegment,
    coordinates: &Coordinates,
    sensor: &Sensor,
    settings: &FitSettings,
    end: usize,
) -> Vec<EndReading> {
    let (bounded, sign) = outward_coordinate(segment.role, end);
    let (outward, across) = (coordinates.axes[bounded] * sign, coordinates.axes[1 - bounded]);
    let Some(kind) = segment.ends.kind(end, &outward) else { return Vec::new() };
    let strips = Strips::new(coordinates.spans[1 - bounded], sensor.pixel_m(&segment.center, &across), settings);
    let blur_m = if kind == EdgeKind::Crease { settings.crease_sigma_m } else { settings.edge_sigma_m };
    let outermost = strips.outermost(&coordinates.along[1 - bounded], &coordinates.along[bounded], sign);
    let information = (settings.most_end_information / outermost.len().max(1) as f64).min(1.0);
    let reading = |number: usize| {
        let point = sensor.point(segment.points[number]);
        let pixel_m = sensor.pixel_m(&point, &outward);
        EndReading {
            point,
            end,
            reach_m: settings.last_pixel * pixel_m,
            sigma_m: blur_m.hypot(pixel_m / 2.0),
            is_least: matches!(kind, EdgeKind::Occluded | EdgeKind::Border),
            information,
        }
    };
    outermost.into_iter().map(reading).collect()
}

/// The rectangle's side that lies that way.
fn rectangle_side(rectangle: &Rectangle, outward: &Vec3) -> usize {
    let center = rectangle.center();
    let agreement = |k: usize| {
        let (a, b) = rectangle.edge(k);
        ((a + b) / 2.0 - center).try_normalize(1e-9).map_or(-1.0, |direction| direction.dot(outward))
    };
    (1..4).fold(0, |best, k| if agreement(k) > agreement(best) { k } else { best })
}

/// Strips of equal width, side by side across an end.
struct Strips {
    low: f64,
    width: f64,
    count: usize,
}

impl Strips {
    fn new([low, high]: [f64; 2], pixel_m: f64, settings: &FitSettings) -> Self {
        let (low, high) = (low + CORNER_SHARE * (high - low), high - CORNER_SHARE * (high - low));
        let fit = ((high - low) / (STRIP_PX * pixel_m)) as usize;
        let count = fit.clamp(1, settings.end_strips);
        Self { low, width: (high - low) / count as f64, count }
    }

    /// The number of the reading of each strip that lies farthest along `sign` times `outward`.
    fn outermost(&self, across: &[f64], outward: &[f64], sign: f64) -> Vec<usize> {
        let mut found = vec![(f64::NEG_INFINITY, 0_usize, 0_usize); self.count];
        for (number, (across, outward)) in across.iter().zip(outward).enumerate() {
            let strip = (across - self.low) / self.width;
            if strip >= 0.0 && strip < self.count as f64 {
                // Signed: to unsigned numbers of that size takes twice as long.
                let (farthest, at, readings) = &mut found[strip as i32 as usize];
                *readings += 1;
                let out = sign * outward;
                if out > *farthest {
                    (*farthest, *at) = (out, number);
                }
            }
        }
        let enough = found.iter().filter(|(_, _, readings)| *readings >= LEAST_READINGS_OF_STRIP);
        enough.map(|&(_, number, _)| number).collect()
    }
}
