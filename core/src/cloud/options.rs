//! What a user can say about a cloud that its file does not.

use std::str::FromStr;

use super::depth::DepthDecode;
use crate::error::{InputError, Result};
use crate::geometry::Vec3;

/// Formats of clouds in files, depth images apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    Pcd,
    Ply,
    Npy,
}

/// Unit of the file's coordinates.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    Metre,
    Millimetre,
}

/// Convention of the camera's frame that the file is in. Coordinates stay as they are; the guards and whoever needs to
/// know where the camera looked read it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Frame {
    /// x right, y down, z forward.
    Optical,
    /// x right, y up, z backward.
    OpenGl,
}

#[derive(Debug, Clone, PartialEq)]
pub struct ReadOptions {
    pub unit: Unit,
    pub frame: Frame,
    /// Where the sensor stood, metres, input's frame; goes before what the file says.
    pub viewpoint: Option<Vec3>,
}

impl Unit {
    pub fn metres(self) -> f64 {
        match self {
            Self::Metre => 1.0,
            Self::Millimetre => 1e-3,
        }
    }
}

macro_rules! named {
    ($type:ident, $what:literal, $($name:literal => $value:ident),+) => {
        impl FromStr for $type {
            type Err = InputError;

            fn from_str(name: &str) -> Result<Self> {
                match name {
                    $($name => Ok(Self::$value),)+
                    _ => Err(InputError::new(format!("is {name:?}")).at($what).mend(concat!("must be one of:", $(" ", $name),+))),
                }
            }
        }
    };
}

named!(Format, "format", "pcd" => Pcd, "ply" => Ply, "npy" => Npy);
named!(Unit, "unit", "m" => Metre, "mm" => Millimetre);
named!(Frame, "frame", "optical" => Optical, "opengl" => OpenGl);
named!(DepthDecode, "depth_decode", "none" => Plain, "rotate3" => Rotate3);
