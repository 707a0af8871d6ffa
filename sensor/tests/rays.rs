//! Exact depth against closed forms and brute force.

use boxwright_sensor::{cast_exact, close_groups, Kinect, Scene, Triangle};

fn camera() -> Kinect {
    Kinect { width: 64, height: 48, fx: 57.58, fy: 57.58, cx: 31.5, cy: 23.5, ..Kinect::default() }
}

fn tilted_plane() -> Vec<Triangle> {
    // z = 1.2 + 0.3 x - 0.2 y
    let p = |x: f64, y: f64| [x, y, 1.2 + 0.3 * x - 0.2 * y];
    vec![[p(-4.0, -4.0), p(4.0, -4.0), p(4.0, 4.0)], [p(-4.0, -4.0), p(4.0, 4.0), p(-4.0, 4.0)]]
}

/// Small triangles all over the view, from a generator of this test's own.
fn confetti(count: usize) -> Vec<Triangle> {
    let mut state = 17u64;
    let mut draw = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / (1u64 << 31) as f64 - 0.5
    };
    let mut triangle = || {
        let centre = [1.5 * draw(), 1.2 * draw(), 1.5 + draw()];
        [0; 3].map(|_| centre.map(|c| c + 0.3 * draw()))
    };
    (0..count).map(|_| triangle()).collect()
}

fn brute_force(triangles: &[Triangle], direction: [f64; 3]) -> Option<(f64, usize)> {
    let hit = |t: &Triangle| {
        // Solve a + s (b - a) + r (c - a) = z * direction by Cramer's rule.
        let det = |m: [[f64; 3]; 3]| {
            m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
                + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])
        };
        let column = |k: usize, i: usize| t[k][i] - t[0][i];
        let row = |f: &dyn Fn(usize) -> [f64; 3]| [f(0), f(1), f(2)];
        let whole = det(row(&|i| [column(1, i), column(2, i), -direction[i]]));
        let s = det(row(&|i| [-t[0][i], column(2, i), -direction[i]])) / whole;
        let r = det(row(&|i| [column(1, i), -t[0][i], -direction[i]])) / whole;
        let z = det(row(&|i| [column(1, i), column(2, i), -t[0][i]])) / whole;
        (s >= 0.0 && r >= 0.0 && s + r <= 1.0 && z > 0.0).then_some(z)
    };
    let hits = triangles.iter().enumerate().filter_map(|(k, t)| hit(t).map(|z| (z, k)));
    hits.min_by(|a, b| a.0.total_cmp(&b.0))
}

#[test]
fn a_plane_is_met_at_its_equation() {
    let (triangles, camera) = (tilted_plane(), camera());
    let scene = Scene { triangles: &triangles, surface_ids: &[1, 1], colors: &[[0; 3]; 2] };
    let hits = cast_exact(&scene, &camera).unwrap();
    assert_eq!(hits.len(), 64 * 48);
    for (pixel, hit) in hits.iter().enumerate() {
        let (x, y) = (((pixel % 64) as f64 - camera.cx) / camera.fx, ((pixel / 64) as f64 - camera.cy) / camera.fy);
        let expected = 1.2 / (1.0 - 0.3 * x + 0.2 * y);
        assert!((hit.unwrap().depth_m - expected).abs() < 1e-9);
    }
}

#[test]
fn the_tree_finds_what_brute_force_finds() {
    let (triangles, camera) = (confetti(400), camera());
    let (ids, colors) = (vec![1; 400], vec![[0; 3]; 400]);
    let hits = cast_exact(&Scene { triangles: &triangles, surface_ids: &ids, colors: &colors }, &camera).unwrap();
    let mut met = 0;
    for (pixel, hit) in hits.iter().enumerate() {
        let (x, y) = (((pixel % 64) as f64 - camera.cx) / camera.fx, ((pixel / 64) as f64 - camera.cy) / camera.fy);
        match (hit, brute_force(&triangles, [x, y, 1.0])) {
            (Some(hit), Some((z, k))) => {
                assert!((hit.depth_m - z).abs() < 1e-9 && hit.triangle == k);
                met += 1;
            }
            (None, None) => {}
            other => panic!("pixel {pixel}: {other:?}"),
        }
    }
    assert!(met > 1000, "only {met} rays met anything");
}

#[test]
fn a_strip_before_a_wall_leaves_its_shadow_on_the_right() {
    let wall: [Triangle; 2] = [
        [[-4.0, -4.0, 2.0], [4.0, -4.0, 2.0], [4.0, 4.0, 2.0]],
        [[-4.0, -4.0, 2.0], [4.0, 4.0, 2.0], [-4.0, 4.0, 2.0]],
    ];
    let strip: [Triangle; 2] = [
        [[-0.1, -4.0, 1.0], [0.1, -4.0, 1.0], [0.1, 4.0, 1.0]],
        [[-0.1, -4.0, 1.0], [0.1, 4.0, 1.0], [-0.1, 4.0, 1.0]],
    ];
    let triangles = [wall, strip].concat();
    let camera = Kinect::default();
    let scene = Scene { triangles: &triangles, surface_ids: &[1, 1, 2, 2], colors: &[[0; 3]; 4] };
    let hits = cast_exact(&scene, &camera).unwrap();
    let row = &hits[240 * 640..241 * 640];
    let dark = row.iter().enumerate().filter(|(_, h)| h.is_some_and(|h| !h.lit)).map(|(u, _)| u);
    let (first, count) = (dark.clone().next().unwrap(), dark.count());
    // The shadow ends on the wall at x = 0.275 (from the projector past the strip's right edge) and starts where the camera
    // first sees the wall, at x = 0.2: 0.075 m at 2 m.
    assert!((first as f64 - (camera.cx + camera.fx * 0.1)).abs() < 1.0);
    assert!((count as f64 - camera.fx * 0.075 / 2.0).abs() <= 1.0);
}

#[test]
fn groups_are_close_when_their_nearest_points_are() {
    let at = |z: f64| [[0.0, 0.0, z], [1.0, 0.0, z], [0.0, 1.0, z]];
    let through = [[0.2, 0.2, -1.0], [0.2, 0.2, 1.0], [0.3, 0.3, 1.0]];
    let triangles = [at(0.0), at(0.1), at(5.0), through];
    let pairs = |gap| close_groups(&triangles, &[4, 2, 9, 7], gap).unwrap();
    assert_eq!(pairs(0.05), [(2, 7), (4, 7)]);
    assert_eq!(pairs(0.11), [(2, 4), (2, 7), (4, 7)]);
}
