//! The arm's shapes against a world of convex pieces, and against itself.
