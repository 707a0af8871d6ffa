//! Search for the best assignments of segments to parts.
