//! A depth camera that looks at triangles: exact depth by ray casting, then a Kinect's errors.
//!
//! Shares no code with `boxwright-core` on purpose: what measures perception must not contain it.
