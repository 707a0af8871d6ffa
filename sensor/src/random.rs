//! Random numbers by counter: a hash of (seed, stream, index), so that a pixel's draw does not depend on the order of the pixels.

/// Which quantity a number is drawn for; every use has its own stream.
#[derive(Clone, Copy)]
pub enum Stream {
    JitterU = 1,
    JitterV,
    WhiteRadius,
    WhiteAngle,
    Patch,
    Ripple,
    EdgeU,
    EdgeV,
    Flying,
    FlyingMix,
    Grazing,
    GrazingPatch,
}

/// SplitMix64's finalizer (Steele, Lea, Flood 2014).
fn mix(mut x: u64) -> u64 {
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// Uniform in [0, 1).
pub fn uniform(seed: u64, stream: Stream, index: u64) -> f64 {
    let key = mix(seed.wrapping_add((stream as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15)));
    let bits = mix(key ^ mix(index.wrapping_add(0x632b_e59b_d9b4_e019)));
    (bits >> 11) as f64 / (1u64 << 53) as f64
}

/// Standard normal by Box and Muller.
pub fn normal(seed: u64, radius: Stream, angle: Stream, index: u64) -> f64 {
    let u = 1.0 - uniform(seed, radius, index);
    (-2.0 * u.ln()).sqrt() * (std::f64::consts::TAU * uniform(seed, angle, index)).cos()
}
