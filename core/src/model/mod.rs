//! Object models as data: templates, features, relations, weights.
