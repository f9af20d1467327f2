//! Attributes, images and samplers: chapter 06.

mod course;

use course::{
    SIDE, Seen, all_near, at, block, buffer, draw, near, picture, pixel, program, real, reals, rgba, state, unit,
};
use fixel::blend::{ONE, Rgba};
use fixel::clip::Planes;
use fixel::depth::NoDepth;
use fixel::num::Block;
use fixel::pipeline::{
    self, ClampToEdge, Filtering, HeadRoom, LinearFilter, MirroredClampToEdge, MirroredRepeat, Picture, Repeat,
    Sampler, Wrap, Wrapping,
};
use fixel::texture::{Rgba8888, Texture};
use proptest::prelude::*;

/// The single value of every pixel, `None` where nothing was drawn.
fn values(
    state: &pipeline::State<impl pipeline::Interpolation, i32, i32, 1>,
    vertices: &[course::Vertex<1>],
) -> Vec<Option<f64>> {
    let mut pixels = picture(Seen::default());
    let look = program(|_, [v]: [i32; 1]| Some(Seen(v, 1, 0, 0)));
    if vertices.len() == 2 {
        pipeline::lines(state, &mut buffer(&mut pixels), &mut NoDepth, &look, vertices);
    } else {
        draw(state, &mut buffer(&mut pixels), &mut NoDepth, &look, vertices);
    }
    pixels.iter().map(|seen| (seen.1 == 1).then(|| real(seen.0))).collect()
}

#[test]
fn item_06_1_attributes_arrive_and_zero_is_a_value() {
    let corners = [((10.5, 10.5), 0.0), ((210.5, 10.5), 0.5), ((10.5, 210.5), 1.0)];
    let drawn = values(&state(), &corners.map(|(p, v)| at(p, [unit(v)])));
    for (x, y) in [(11, 11), (100, 50), (11, 200), (200, 12)] {
        let want = (f64::from(x) - 10.0) / 200.0 * 0.5 + (f64::from(y) - 10.0) / 200.0;
        near(pixel(&drawn, x, y).unwrap(), want, 1e-6);
    }
    // Zero at the later vertices.
    let drawn = values(
        &state(),
        &[1.0, 0.0, 0.0]
            .iter()
            .zip(corners)
            .map(|(v, (p, _))| at(p, [unit(*v)]))
            .collect::<Vec<_>>(),
    );
    near(pixel(&drawn, 60, 60).unwrap(), 0.5, 1e-6);
}

#[test]
fn item_06_2_linear_on_a_line() {
    // In units of the user's choice: 2^-20.
    let ends = [at((20.5, 30.5), [0]), at((30.5, 30.5), [10 << 20])];
    let drawn = values(&state(), &ends);
    for step in 0..=10 {
        let got = pixel(&drawn, 20 + step, 30).unwrap() * 256.0;
        near(got, f64::from(step), 1.0 / 4096.0);
    }
}

#[test]
fn item_06_3_t_is_the_projection_of_the_centre() {
    let (from, to) = ((-100.5, 10.5), (100.5, 10.5));
    let forward = values(&state(), &[at(from, [0]), at(to, [unit(1.0)])]);
    near(pixel(&forward, 0, 10).unwrap(), 101.0 / 201.0, 1e-6);
    let backward = values(&state(), &[at(to, [0]), at(from, [unit(1.0)])]);
    for x in 0..=100 {
        near(
            pixel(&backward, x, 10).unwrap(),
            1.0 - pixel(&forward, x, 10).unwrap(),
            1e-6,
        );
    }
    // Any direction, beyond the ends clamped.
    let mut random = course::Random(3);
    for _ in 0..300 {
        let [ax, ay, bx, by] = [(); 4].map(|()| f64::from(random.below(600 * 256)) / 256.0 - 150.0);
        let drawn = values(&state(), &[at((ax, ay), [unit(-1.0)]), at((bx, by), [unit(3.0)])]);
        let length = (bx - ax).powi(2) + (by - ay).powi(2);
        for y in 0..SIDE {
            for x in 0..SIDE {
                if let Some(got) = pixel(&drawn, x, y) {
                    let (px, py) = (f64::from(x) + 0.5 - ax, f64::from(y) + 0.5 - ay);
                    let t = ((px * (bx - ax) + py * (by - ay)) / length).clamp(0.0, 1.0);
                    near(got, -1.0 + 4.0 * t, 4e-6);
                }
            }
        }
    }
    // A line without length has its first end's value.
    let dot = values(&state(), &[at((7.2, 7.7), [unit(0.25)]), at((7.2, 7.7), [unit(0.75)])]);
    assert_eq!(pixel(&dot, 7, 7), Some(0.25));
}

#[test]
fn item_06_4_barycentric_on_a_triangle() {
    let corners = [
        ((10.0, 10.0), [1.0, 0.0, 0.0]),
        ((290.0, 10.0), [0.0, 1.0, 0.0]),
        ((20.0, 150.0), [0.0, 0.0, 1.0]),
    ];
    let mut pixels = picture(Rgba::default());
    let color = program(|_, color: [i32; 3]| Some(Rgba { color, alpha: ONE }));
    draw(
        &state(),
        &mut buffer(&mut pixels),
        &mut NoDepth,
        &color,
        &corners.map(|(p, c)| at(p, c.map(unit))),
    );
    all_near(
        reals(pixel(&pixels, 100, 50)),
        [0.397832, 0.312883, 0.289286, 1.0],
        1e-5,
    );
}

/// Cut by x ≥ 150, an attribute that equals x is still x, in 4D: with different w, perspective-corrected and linear.
#[test]
fn item_06_5_cutting_interpolates_attributes_as_positions() {
    let mut planes = Planes::<i32, 1>::default();
    planes.push(Block::from_integers([1, 0, 0, 0])).unwrap();
    let state = state().with_planes(planes);
    // Clip positions; the attribute is x in clip space, which is linear there.
    let corner = |x: f64, y: f64, w: f64| (block([x, y, 0.0, w]), [unit(x)]);
    let triangle = [corner(-1.0, -0.9, 1.0), corner(0.9, -0.8, 2.0), corner(-0.2, 0.95, 1.5)];
    for drawn in [values(&state, &triangle), values(&state.clone().linear(), &triangle)] {
        // Column 150 begins at the cut: its centres lie half a pixel from it, where x = w/300.
        let rows: Vec<_> = (0..SIDE).filter_map(|y| pixel(&drawn, 150, y)).collect();
        assert!(rows.len() > 50, "{}", rows.len());
        assert!(rows.iter().all(|v| (0.0..0.012).contains(v)), "{rows:?}");
        assert!((0..SIDE).all(|y| pixel(&drawn, 149, y).is_none()));
    }
    // Corrected, it is x everywhere: xn·w with w from the plane through the three corners.
    let drawn = values(&state, &triangle);
    let window = |(x, y, w): (f64, f64, f64)| ((x / w + 1.0) * 150.0, (y / w + 1.0) * 150.0);
    let corners = [(-1.0, -0.9, 1.0), (0.9, -0.8, 2.0), (-0.2, 0.95, 1.5)];
    let [a, b, c] = corners.map(window);
    let e = |a: (f64, f64), b: (f64, f64), p: (f64, f64)| (b.0 - a.0) * (p.1 - a.1) - (b.1 - a.1) * (p.0 - a.0);
    for y in 0..SIDE {
        for x in 150..SIDE {
            if let Some(got) = pixel(&drawn, x, y) {
                let p = (f64::from(x) + 0.5, f64::from(y) + 0.5);
                let weights = [e(b, c, p), e(c, a, p), e(a, b, p)].map(|v| v / e(a, b, c));
                let over = |f: fn((f64, f64, f64)) -> f64| -> f64 { (0..3).map(|i| weights[i] * f(corners[i])).sum() };
                let want = over(|(x, _, w)| x / w) / over(|(_, _, w)| 1.0 / w);
                // Corners are snapped: 1/512 px, where x changes by less than 1/75 a pixel.
                near(got, want, 1e-4);
            }
        }
    }
}

/// 9×9 texels, white where x + y is even.
fn board() -> Vec<[u8; 4]> {
    (0..81)
        .map(|i| {
            if (i % 9 + i / 9) % 2 == 0 {
                [255; 4]
            } else {
                [0, 0, 0, 255]
            }
        })
        .collect()
}

fn fine(uv: [f64; 2]) -> [i32; 2] {
    uv.map(|v| (v * 65536.0).round() as i32)
}

#[test]
fn item_06_6_nearest_floors_then_wraps() {
    let texels = board();
    let sampler = Sampler::new(Texture::new(Rgba8888, &texels, 9, 9).unwrap(), 16);
    let white = |uv| sampler.sample(fine(uv)).color[0] == ONE;
    assert!(white([0.0, 0.0]));
    assert!(!white([0.12, 0.0]));
    assert!(white([1.0, 1.0]));
    // v upwards: row 0 is at v = 0.
    let rows = [[0, 0, 0, 0], [255; 4]];
    let upright = Sampler::new(Texture::new(Rgba8888, &rows, 1, 2).unwrap(), 16);
    assert_eq!([0.1, 0.9].map(|v| upright.sample(fine([0.5, v])).alpha), [0, ONE]);
}

#[test]
fn item_06_7_linear_between_texel_centres() {
    let texels = [[0; 4], [255; 4]];
    let sampler = Sampler::new(Texture::new(Rgba8888, &texels, 2, 1).unwrap(), 16).filtered(LinearFilter);
    let value = |u: f64| real(sampler.sample(fine([u, 0.5])).alpha);
    for (u, want) in [(0.25, 0.0), (0.5, 0.5), (0.6, 0.7), (0.9, 1.0)] {
        near(value(u), want, 1.0 / 4096.0);
    }
    let repeated = sampler.wrapped(Repeat, Repeat);
    near(real(repeated.sample(fine([0.9, 0.5])).alpha), 0.7, 1.0 / 4096.0);
}

/// The spec's formulas, in whole numbers without bound.
fn wrapped(wrapping: Wrapping, i: i64, n: i64) -> i64 {
    let mirror = |a: i64| if a >= 0 { a } else { -1 - a };
    match wrapping {
        Wrapping::ClampToEdge => i.clamp(0, n - 1),
        Wrapping::Repeat => i.rem_euclid(n),
        Wrapping::MirroredRepeat => (n - 1) - mirror(i.rem_euclid(2 * n) - n),
        Wrapping::MirroredClampToEdge => mirror(i).clamp(0, n - 1),
    }
}

const WRAPPINGS: [Wrapping; 4] = [
    Wrapping::ClampToEdge,
    Wrapping::Repeat,
    Wrapping::MirroredRepeat,
    Wrapping::MirroredClampToEdge,
];

#[test]
fn item_06_8_four_ways_to_wrap() {
    let all = |wrap: &dyn Fn(i32) -> u16| (-5..=8).map(wrap).collect::<Vec<_>>();
    assert_eq!(
        all(&|i| ClampToEdge.wrap(i, 4)),
        [0, 0, 0, 0, 0, 0, 1, 2, 3, 3, 3, 3, 3, 3]
    );
    assert_eq!(all(&|i| Repeat.wrap(i, 4)), [3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0]);
    assert_eq!(
        all(&|i| MirroredRepeat.wrap(i, 4)),
        [3, 3, 2, 1, 0, 0, 1, 2, 3, 3, 2, 1, 0, 0]
    );
    assert_eq!(
        all(&|i| MirroredClampToEdge.wrap(i, 4)),
        [3, 3, 2, 1, 0, 0, 1, 2, 3, 3, 3, 3, 3, 3]
    );
    // Separately for s and t, and by default clamped and nearest.
    let texels = [1, 2, 3, 4].map(|v| [v; 4]);
    let image = Texture::new(Rgba8888, &texels, 2, 2).unwrap();
    let mixed = Sampler::new(image, 16).wrapped(Repeat, MirroredRepeat);
    let level = |color: Rgba| (real(color.alpha) * 255.0).round() as u8;
    assert_eq!(level(mixed.sample(fine([1.25, 1.25]))), 3);
    assert_eq!(level(Sampler::new(image, 16).sample(fine([1.25, 1.25]))), 4);
    assert_eq!(
        (Wrapping::default(), Filtering::default()),
        (Wrapping::ClampToEdge, Filtering::Nearest)
    );
}

proptest! {
    #[test]
    fn any_index_wraps_as_the_formulas_say(i in prop_oneof![any::<i32>(), -300_000..300_000], n in 1..=u16::MAX) {
        for wrapping in WRAPPINGS {
            prop_assert_eq!(i64::from(wrapping.wrap(i, n)), wrapped(wrapping, i.into(), n.into()), "{:?}", wrapping);
        }
    }

    /// Against float64 and the spec's formulas; texels anywhere in their range.
    #[test]
    fn any_sample_is_that_of_float64(
        texels in prop::collection::vec(prop::array::uniform4(any::<i32>()), 35),
        uv in prop::array::uniform2(prop_oneof![any::<i32>(), -400_000..400_000]),
        s in prop::sample::select(&WRAPPINGS[..]), t in prop::sample::select(&WRAPPINGS[..]), bits in 16..=30u32,
    ) {
        let pixels: Vec<_> = texels.iter().map(|&[r, g, b, alpha]| Rgba { color: [r, g, b], alpha }).collect();
        let image = Picture::new(HeadRoom, &pixels, 7, 5).unwrap();
        let sampler = Sampler::new(image, bits).wrapped(s, t);
        // Exact: 31 bits times 3.
        let [x, y] = [f64::from(uv[0]) * 7.0, f64::from(uv[1]) * 5.0].map(|v| v / 2f64.powi(bits as i32));
        let texel = |i: f64, j: f64| {
            texels[(wrapped(t, j as i64, 5) * 7 + wrapped(s, i as i64, 7)) as usize].map(f64::from)
        };
        let nearest = sampler.sample(uv);
        let got = [nearest.color[0], nearest.color[1], nearest.color[2], nearest.alpha].map(f64::from);
        prop_assert_eq!(got, texel(x.floor(), y.floor()));

        let linear = sampler.filtered(LinearFilter).sample(uv);
        let (x, y) = (x - 0.5, y - 0.5);
        let (i, j) = (x.floor(), y.floor());
        let (a, b, c, d) = (texel(i, j), texel(i + 1.0, j), texel(i, j + 1.0), texel(i + 1.0, j + 1.0));
        for (k, got) in [linear.color[0], linear.color[1], linear.color[2], linear.alpha].into_iter().enumerate() {
            let mix = |a: f64, b: f64, t: f64| a + (b - a) * t;
            let want = mix(mix(a[k], b[k], x - i), mix(c[k], d[k], x - i), y - j);
            let four = [a[k], b[k], c[k], d[k]];
            let distance = four.iter().fold(f64::MIN, |m, v| m.max(*v)) - four.iter().fold(f64::MAX, |m, v| m.min(*v));
            let off = (f64::from(got) - want).abs();
            prop_assert!(off <= 1.0 + 0.5 + 2f64.powi(-27) * distance, "off by {off}");
        }
    }
}

#[test]
fn images_of_other_sizes_are_refused() {
    assert!(Picture::new(HeadRoom, &[rgba([0.0; 4]); 3], 2, 2).is_err());
    assert!(Picture::new(HeadRoom, &[], 0, 2).is_err());
}
