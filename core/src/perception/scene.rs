use crate::geometry::{Plane, Rectangle, Vec3};

/// What ends a segment at one side of its rectangle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EdgeKind {
    /// The surface itself ends there: what is seen beyond it lies farther away, or nothing is.
    Edge,
    /// Another segment goes on from there.
    Crease,
    /// Something nearer hides what may follow.
    Occluded,
    /// The frame ends there.
    Border,
}

impl EdgeKind {
    /// What files call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Edge => "edge",
            Self::Crease => "crease",
            Self::Occluded => "occluded",
            Self::Border => "border",
        }
    }
}

/// Group of the support plane and of walls and floors, which belong to no thing.
pub const BACKGROUND: i32 = -1;

/// Planar segments as a structure of arrays; entry `s` of each array belongs to segment `s`.
#[derive(Debug, Clone, Default)]
pub struct Segments {
    /// Plane of the segment; its normal looks at the viewpoint where the cloud has one, else its sign means nothing.
    pub planes: Vec<Plane>,
    /// Minimum bounding rectangle of the segment's points, in its plane.
    pub rectangles: Vec<Rectangle>,
    /// Convex hull of the segment's points, in its plane, going round.
    pub hulls: Vec<Vec<Vec3>>,
    /// Root mean square distance of the points from the plane, metres.
    pub rms: Vec<f64>,
    /// What ends the segment at each side of its rectangle, side `k` running from corner `k` to the next.
    pub edges: Vec<[EdgeKind; 4]>,
    /// Number of the cluster (the group of things that touch), from 0; `BACKGROUND` for the support and the room.
    pub group: Vec<i32>,
    /// Point indices of all segments, one after another; those of `s` are `point_indices[point_starts[s]..point_starts[s + 1]]`.
    pub point_indices: Vec<u32>,
    /// One longer than the number of segments.
    pub point_starts: Vec<u32>,
}

impl Segments {
    pub fn len(&self) -> usize {
        self.planes.len()
    }

    pub fn is_empty(&self) -> bool {
        self.planes.is_empty()
    }

    /// Indices into the cloud of the points of segment `s`.
    pub fn points_of(&self, s: usize) -> &[u32] {
        &self.point_indices[self.point_starts[s] as usize..self.point_starts[s + 1] as usize]
    }

    /// The segment of each of the cloud's `point_count` points, -1 for none.
    pub fn labels(&self, point_count: usize) -> Vec<i32> {
        let mut labels = vec![-1; point_count];
        for s in 0..self.len() {
            // Runs of neighbours at once: in an image they are long.
            for run in self.points_of(s).chunk_by(|a, b| *b == a + 1) {
                labels[run[0] as usize..][..run.len()].fill(s as i32);
            }
        }
        labels
    }
}

/// What perception says of a cloud.
#[derive(Debug, Clone)]
pub struct Scene {
    /// Unit vector away from the support, input's frame.
    pub up: Vec3,
    /// The plane that the objects stand on, normal along `up`; `None` where the cloud shows none.
    pub support: Option<Plane>,
    /// Where the sensor stood, if the cloud says it; then segment normals are oriented.
    pub viewpoint: Option<Vec3>,
    pub segments: Segments,
    /// What a user should know about the answer, one line each.
    pub warnings: Vec<String>,
    /// Seconds of each stage, in order.
    pub stage_seconds: Vec<(&'static str, f64)>,
}
