//! The diffuse start against least squares, and against large finite variances.
