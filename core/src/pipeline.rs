//! The two ways through: from a cloud to articulated objects in one call.
