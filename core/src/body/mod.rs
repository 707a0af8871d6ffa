//! From an assignment of segments to parts to an articulated body: corners, hinges, angles.
