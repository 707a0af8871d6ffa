//! From the file's degrees to a checked [`Arm`]; every error names the key and what would fit.

use super::file::{GripperEntry, JointEntry, LinkEntry, OpwEntry, PlaceEntry, RobotFile};
use super::gripper::Gripper;
use super::inverse::MAX_SOLUTIONS;
use super::joint::{Joint, Limits};
use super::model::{Arm, Link, FINGERS, GRIPPER};
use super::numeric_settings::NumericSettings;
use super::opw::Opw;
use super::positions::JointPositions;
use super::shape::Shape;
use super::wraps::most_wraps;
use crate::error::{InputError, Result};
use crate::geometry::{Rigid, Vec3};

const FORMAT: &str = "boxwright.robot";
const VERSION: u32 = 1;
const AXES: [usize; 2] = [6, 7];
/// Joints that go further round than this would have no end of wraps.
const WIDEST_DEG: f64 = 360.0;
/// Axes shorter than this have no direction.
const LEAST_AXIS: f64 = 1e-6;
/// Shapes of all links: with the gripper's they must fit into what collision places on the stack.
const MOST_SHAPES: usize = 40;
const CLOSED_FORM_BRANCHES: usize = 8;

pub fn arm(file: RobotFile) -> Result<Arm> {
    check_head(&file)?;
    let opw = file.opw.as_ref().map(opw).transpose()?;
    let joints = joints(&file.joints, opw.as_ref())?;
    let links = links(&file.links, joints.len())?;
    let names: Vec<&str> = links.iter().map(|link| link.name.as_str()).chain([GRIPPER, FINGERS]).collect();
    let may_touch = file.may_touch.iter().map(|pair| body_pair(pair, &names)).collect::<Result<_>>()?;
    let arm = Arm {
        ready: ready(&file.ready_deg, &joints)?,
        last_link_from_flange: flange(file.flange.as_ref(), opw.as_ref())?,
        gripper: gripper(&file.gripper)?,
        numeric: NumericSettings::default(),
        name: file.name,
        may_touch,
        joints,
        opw,
        links,
    };
    check_wraps(&arm)?;
    check_pieces(&arm)?;
    Ok(arm)
}

fn at(key: impl Into<String>, problem: impl Into<String>) -> InputError {
    InputError::new(problem).at(key)
}

fn check_head(file: &RobotFile) -> Result<()> {
    if file.format != FORMAT {
        return Err(at("format", format!("is \"{}\"", file.format)).mend(format!("a robot says \"{FORMAT}\"")));
    }
    if file.version != VERSION {
        return Err(at("version", format!("is {}", file.version)).mend(format!("this program reads {VERSION}")));
    }
    let joints = file.joints.iter().map(|joint| joint.name.as_str());
    let names = joints.chain(file.links.iter().map(|link| link.name.as_str())).chain([file.name.as_str()]);
    if let Some(name) = names.into_iter().find(|name| !is_name(name)) {
        return Err(
            at("name", format!("is \"{name}\"")).mend("a name is a letter, then letters, digits and underscores")
        );
    }
    let axes = file.joints.len();
    if !AXES.contains(&axes) {
        return Err(at("joint", format!("there are {axes}")).mend("an arm has 6 or 7 revolute joints"));
    }
    if file.opw.is_some() && axes != 6 {
        return Err(at("opw", format!("there are {axes} joints")).mend("an ortho-parallel arm has 6; leave opw out"));
    }
    Ok(())
}

/// Safe as it stands in URDF, MJCF, ROS and file names.
fn is_name(name: &str) -> bool {
    name.starts_with(|c: char| c.is_ascii_alphabetic()) && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
}

fn finite(key: &str, what: &str, values: &[f64]) -> Result<()> {
    match values.iter().find(|value| !value.is_finite()) {
        Some(value) => Err(at(key, format!("{what} holds {value}")).mend("it must be finite")),
        None => Ok(()),
    }
}

fn positive(key: &str, what: &str, values: &[f64]) -> Result<()> {
    finite(key, what, values)?;
    match values.iter().find(|&&value| value <= 0.0) {
        Some(value) => Err(at(key, format!("{what} holds {value}")).mend("it must be above 0")),
        None => Ok(()),
    }
}

fn opw(entry: &OpwEntry) -> Result<Opw> {
    let lengths = [entry.a1_m, entry.a2_m, entry.b_m, entry.c1_m, entry.c2_m, entry.c3_m, entry.c4_m];
    finite("opw", "its lengths", &lengths)?;
    finite("opw", "offsets_deg", &entry.offsets_deg)?;
    positive("opw", "c2_m and c3_m", &[entry.c2_m, entry.c3_m])?;
    if entry.signs.iter().any(|sign| sign.abs() != 1.0) {
        return Err(at("opw", format!("signs are {:?}", entry.signs)).mend("each is 1 or -1"));
    }
    let [a1_m, a2_m, b_m, c1_m, c2_m, c3_m, c4_m] = lengths;
    let offsets_rad = entry.offsets_deg.map(f64::to_radians);
    Ok(Opw { a1_m, a2_m, b_m, c1_m, c2_m, c3_m, c4_m, offsets_rad, signs: entry.signs })
}

fn joints(entries: &[JointEntry], opw: Option<&Opw>) -> Result<Vec<Joint>> {
    let places = match opw {
        Some(opw) => opw.joints().to_vec(),
        None => entries.iter().map(joint_place).collect::<Result<_>>()?,
    };
    entries.iter().zip(places).map(|(entry, place)| joint(entry, opw.is_some(), place)).collect()
}

fn joint(entry: &JointEntry, by_opw: bool, (parent_from_joint, axis): (Rigid, Vec3)) -> Result<Joint> {
    let key = format!("joint {}", entry.name);
    if by_opw && (entry.xyz_m.is_some() || entry.rpy_deg.is_some() || entry.axis.is_some()) {
        return Err(at(key, "its place is told beside opw").mend("leave out xyz_m, rpy_deg and axis, or opw"));
    }
    let [low, high] = entry.limits_deg;
    finite(&key, "limits_deg", &entry.limits_deg)?;
    if low >= high || low < -WIDEST_DEG || high > WIDEST_DEG {
        let mend = format!("the lower comes first, both lie within {WIDEST_DEG} either way");
        return Err(at(key, format!("limits_deg are {:?}", entry.limits_deg)).mend(mend));
    }
    positive(&key, "speed_deg_per_s", &[entry.speed_deg_per_s])?;
    positive(&key, "acceleration_deg_per_s2", &[entry.acceleration_deg_per_s2])?;
    let limits = Limits {
        lower_rad: low.to_radians(),
        upper_rad: high.to_radians(),
        speed_rad_per_s: entry.speed_deg_per_s.to_radians(),
        acceleration_rad_per_s2: entry.acceleration_deg_per_s2.to_radians(),
    };
    Ok(Joint::new(entry.name.clone(), parent_from_joint, axis, limits))
}

fn joint_place(entry: &JointEntry) -> Result<(Rigid, Vec3)> {
    let key = format!("joint {}", entry.name);
    let (Some(xyz), Some(rpy), Some(axis)) = (entry.xyz_m, entry.rpy_deg, entry.axis) else {
        return Err(at(key, "its place is missing").mend("without opw a joint has xyz_m, rpy_deg and axis"));
    };
    finite(&key, "axis", &axis)?;
    let axis = Vec3::from(axis);
    if axis.norm() < LEAST_AXIS {
        return Err(at(key, "its axis has no length").mend("an axis is a direction, as [0, 0, 1]"));
    }
    Ok((place(&key, xyz, rpy)?, axis.normalize()))
}

fn place(key: &str, xyz_m: [f64; 3], rpy_deg: [f64; 3]) -> Result<Rigid> {
    finite(key, "xyz_m", &xyz_m)?;
    finite(key, "rpy_deg", &rpy_deg)?;
    Ok(Rigid::from_xyz_rpy(xyz_m.into(), rpy_deg.map(f64::to_radians).into()))
}

fn flange(entry: Option<&PlaceEntry>, opw: Option<&Opw>) -> Result<Rigid> {
    match (entry, opw) {
        (None, Some(opw)) => Ok(opw.last_link_from_flange()),
        (Some(entry), None) => place("flange", entry.xyz_m, entry.rpy_deg),
        (None, None) => {
            Err(at("flange", "is missing").mend("without opw say xyz_m and rpy_deg, last link from flange"))
        }
        (Some(_), Some(_)) => Err(at("flange", "is told beside opw").mend("opw's c4_m says where it is")),
    }
}

fn links(entries: &[LinkEntry], joints: usize) -> Result<Vec<Link>> {
    if entries.len() != joints + 1 {
        let problem = format!("there are {} links and {joints} joints", entries.len());
        return Err(at("link", problem).mend("the base is the first link, then comes one for each joint"));
    }
    for (k, entry) in entries.iter().enumerate() {
        let taken = [GRIPPER, FINGERS].contains(&entry.name.as_str());
        if taken || entries[..k].iter().any(|other| other.name == entry.name) {
            return Err(at(format!("link {}", entry.name), "the name is taken").mend("each link has its own"));
        }
    }
    entries.iter().map(link).collect()
}

fn link(entry: &LinkEntry) -> Result<Link> {
    let key = format!("link {}", entry.name);
    positive(&key, "mass_kg", &[entry.mass_kg])?;
    let mut shapes = Vec::new();
    for capsule in &entry.capsules {
        finite(&key, "a capsule", &[capsule.from_m, capsule.to_m].concat())?;
        positive(&key, "radius_m", &[capsule.radius_m])?;
        let (from_m, to_m) = (capsule.from_m.into(), capsule.to_m.into());
        shapes.push(Shape::Capsule { from_m, to_m, radius_m: capsule.radius_m });
    }
    for entry in &entry.boxes {
        positive(&key, "size_m", &entry.size_m)?;
        let body_from_box = place(&key, entry.centre_m, entry.rpy_deg)?;
        shapes.push(Shape::Box { body_from_box, half_m: Vec3::from(entry.size_m) / 2.0 });
    }
    Ok(Link { name: entry.name.clone(), mass_kg: entry.mass_kg, shapes })
}

fn gripper(entry: &GripperEntry) -> Result<Gripper> {
    let key = "gripper";
    positive(key, "mass_kg", &[entry.mass_kg])?;
    positive(key, "body_size_m", &entry.body_size_m)?;
    positive(key, "finger_size_m", &entry.finger_size_m)?;
    finite(key, "tool_point_m", &entry.tool_point_m)?;
    let [least, widest] = entry.opening_m;
    if !(0.0 <= least && least <= widest && widest.is_finite()) {
        return Err(
            at(key, format!("opening_m is {:?}", entry.opening_m)).mend("the least gap, 0 or more, comes first")
        );
    }
    Ok(Gripper {
        mass_kg: entry.mass_kg,
        body_size_m: entry.body_size_m.into(),
        finger_size_m: entry.finger_size_m.into(),
        opening_m: entry.opening_m,
        tool_point_m: entry.tool_point_m.into(),
    })
}

fn ready(ready_deg: &[f64], joints: &[Joint]) -> Result<JointPositions> {
    if ready_deg.len() != joints.len() {
        let problem = format!("has {} positions for {} joints", ready_deg.len(), joints.len());
        return Err(at("ready_deg", problem).mend("one for each joint"));
    }
    let positions: Vec<f64> = ready_deg.iter().map(|deg| deg.to_radians()).collect();
    match joints.iter().zip(&positions).find(|(joint, &q)| !joint.allows(q)) {
        Some((joint, q)) => {
            let problem = format!("{} at {} is outside its limits", joint.name, q.to_degrees());
            Err(at("ready_deg", problem).mend("take a position that the joint may have"))
        }
        None => Ok(JointPositions::from_slice(&positions)),
    }
}

fn body_pair(names: &[String; 2], known: &[&str]) -> Result<(usize, usize)> {
    let index = |name: &String| {
        let found = known.iter().position(|&other| other == name);
        found.ok_or_else(|| at("may_touch", format!("no link {name}")).mend(format!("links are {}", known.join(", "))))
    };
    Ok((index(&names[0])?, index(&names[1])?))
}

/// Every closed-form branch comes in all its wraps: they must fit into what the inverse returns.
fn check_wraps(arm: &Arm) -> Result<()> {
    let wraps: usize = arm.joints.iter().map(|joint| most_wraps(joint.lower_rad, joint.upper_rad)).product();
    if arm.opw.is_some() && wraps * CLOSED_FORM_BRANCHES > MAX_SOLUTIONS {
        let problem = format!("the limits let one tool pose be reached in {} ways", wraps * CLOSED_FORM_BRANCHES);
        return Err(at("joint", problem).mend(format!("narrow limits_deg until they are {MAX_SOLUTIONS} at most")));
    }
    Ok(())
}

fn check_pieces(arm: &Arm) -> Result<()> {
    let pieces: usize = arm.links.iter().map(|link| link.shapes.len()).sum();
    if pieces > MOST_SHAPES {
        return Err(
            at("link", format!("there are {pieces} shapes")).mend(format!("{MOST_SHAPES} at most: draw more coarsely"))
        );
    }
    Ok(())
}
