//! Blending and culling: chapters 10 and 11.

mod course;

use std::cell::RefCell;

use course::{
    Random, SIDE, Vertex, all_near, block, buffer, deep, draw, floats, lit, near, picture, pixel, program, reals, rgba,
    scaled, square, state, triangles_hit, unit,
};
use fixel::blend::{Blend, Blending, Equation, Factor, ONE, Replace, Rgba, Translucent};
use fixel::depth::{Depth, DepthBuffer, FAR, LessOrEqual, NoDepth, Options, Relation, Switched};
use fixel::matrix::Matrix;
use fixel::num::{Angle, SineTable};
use fixel::pipeline::shapes::BOX;
use fixel::pipeline::{self, Culling, HeadRoom, OneBit, PixelFormat, State, Surface};
use fixel::texture::{Rgb565, Rgba8888};
use fixel::viewport::Viewport;
use proptest::prelude::*;

fn opaque_black() -> Vec<Rgba> {
    picture(rgba([0.0, 0.0, 0.0, 1.0]))
}

fn color(c: [f64; 4]) -> [i32; 4] {
    c.map(unit)
}

fn paint() -> impl pipeline::Program<Vertex = Vertex<4>, Varying = [i32; 4], At = pipeline::FragCoord, Output = Rgba> {
    program(|_, [r, g, b, alpha]: [i32; 4]| {
        Some(Rgba {
            color: [r, g, b],
            alpha,
        })
    })
}

#[test]
fn item_10_1_off_by_default_and_the_defaults_replace() {
    let [source, below] = [[2.0, -1.0, 0.3, 0.5], [0.1, 0.7, 3.0, 0.25]].map(rgba);
    assert_eq!(Blend::default().blend(source, below), source);
    assert_eq!(Replace.blend(source, below), source);
    assert_eq!(None.blend(source, below), source);
    assert_eq!(Blend::default().constant, rgba([1.0; 4]));
    // No clamping in the buffer, and each buffer has its own blending.
    let sum = Blend {
        destination: Factor::One,
        ..Blend::default()
    };
    let (mut added, mut replaced) = (picture(rgba([0.75; 4])), picture(rgba([0.75; 4])));
    let mut targets = (
        Surface::new(buffer(&mut added), HeadRoom).blended(Some(sum)),
        Surface::new(buffer(&mut replaced), HeadRoom),
    );
    let both = program(|_, []: [i32; 0]| Some((rgba([0.75; 4]), rgba([0.5; 4]))));
    draw(
        &state(),
        &mut targets,
        &mut NoDepth,
        &both,
        &square([0.0, 0.0, 9.0, 9.0], 0.0, []),
    );
    assert_eq!(
        (pixel(&added, 5, 5), pixel(&replaced, 5, 5)),
        (rgba([1.5; 4]), rgba([0.5; 4]))
    );
}

#[test]
fn item_10_2_equations() {
    let [source, below] = [0.5, 0.2].map(|v| rgba([v; 4]));
    let rule = |equation| Blend {
        destination: Factor::One,
        equation,
        ..Blend::default()
    };
    let equations = [
        Equation::Add,
        Equation::Subtract,
        Equation::ReverseSubtract,
        Equation::Min,
        Equation::Max,
    ];
    let got = equations.map(|e| course::real(rule(e).blend(source, below).color[0]));
    all_near(got, [0.7, 0.3, -0.3, 0.2, 0.5], 1e-7);
    // The least and the largest are those of the unweighted colours.
    let zero = Blend {
        source: Factor::Zero,
        destination: Factor::Zero,
        ..rule(Equation::Max)
    };
    assert_eq!(zero.blend(source, below), source);
}

const FACTORS: [Factor; 15] = [
    Factor::Zero,
    Factor::One,
    Factor::SourceColor,
    Factor::OneMinusSourceColor,
    Factor::DestinationColor,
    Factor::OneMinusDestinationColor,
    Factor::SourceAlpha,
    Factor::OneMinusSourceAlpha,
    Factor::DestinationAlpha,
    Factor::OneMinusDestinationAlpha,
    Factor::ConstantColor,
    Factor::OneMinusConstantColor,
    Factor::ConstantAlpha,
    Factor::OneMinusConstantAlpha,
    Factor::SourceAlphaSaturate,
];

/// The factors in the order of [`FACTORS`], in float64.
fn weights(s: [f64; 4], d: [f64; 4], c: [f64; 4]) -> [[f64; 4]; 15] {
    let rest = |v: [f64; 4]| v.map(|v| 1.0 - v);
    let [sa, da, ca] = [s, d, c].map(|v| [v[3]; 4]);
    let saturate = [s[3].min(1.0 - d[3]); 4];
    [
        [0.0; 4],
        [1.0; 4],
        s,
        rest(s),
        d,
        rest(d),
        sa,
        rest(sa),
        da,
        rest(da),
        c,
        rest(c),
        ca,
        rest(ca),
        saturate,
    ]
}

#[test]
fn item_10_3_fifteen_factors() {
    let (s, d, c) = ([0.2, 0.4, 0.6, 0.5], [1.0, 0.5, 0.0, 0.25], [0.1, 0.2, 0.3, 0.4]);
    let want = weights(s, d, c);
    assert_eq!(want[14], [0.5; 4]);
    for (factor, want) in FACTORS.into_iter().zip(want) {
        // The factor of a source, alone.
        let rule = Blend {
            source: factor,
            destination: Factor::Zero,
            equation: Equation::Add,
            constant: rgba(c),
        };
        let got = reals(rule.blend(rgba(s), rgba(d)));
        let product = [0, 1, 2, 3].map(|i| want[i] * s[i]);
        all_near(got, product, 1e-8);
        let rule = Blend {
            source: Factor::Zero,
            destination: factor,
            ..rule
        };
        all_near(
            reals(rule.blend(rgba(s), rgba(d))),
            [0, 1, 2, 3].map(|i| want[i] * d[i]),
            1e-8,
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// Half a unit, or saturated; 2^-52 of the products for float64 itself.
    #[test]
    fn any_blend_is_that_of_float64(
        parts in prop::array::uniform3(prop::array::uniform4(prop_oneof![any::<i32>(), 0..=ONE])),
        source in 0..15usize, destination in 0..15usize, equation in 0..5usize,
    ) {
        let color = |[r, g, b, alpha]: [i32; 4]| Rgba { color: [r, g, b], alpha };
        let real = |c: [i32; 4]| c.map(course::real);
        let [s, d, c] = parts.map(real);
        let equations = [Equation::Add, Equation::Subtract, Equation::ReverseSubtract, Equation::Min, Equation::Max];
        let rule = Blend {
            source: FACTORS[source],
            destination: FACTORS[destination],
            equation: equations[equation],
            constant: color(parts[2]),
        };
        let got = rule.blend(color(parts[0]), color(parts[1]));
        let got = [got.color[0], got.color[1], got.color[2], got.alpha];
        let all = weights(s, d, c);
        for i in 0..4 {
            let (over, under) = (all[source][i] * s[i], all[destination][i] * d[i]);
            let want = [over + under, over - under, under - over, s[i].min(d[i]), s[i].max(d[i])][equation];
            let units = (want * f64::from(ONE)).clamp(f64::from(i32::MIN), f64::from(i32::MAX));
            prop_assert!((f64::from(got[i]) - units).abs() <= 0.5 + 1e-4, "{} for {}", got[i], units);
        }
    }

    /// A pixel that is read and written again is the same, and the nearest one is written.
    #[test]
    fn formats_write_what_they_read(word in any::<u16>(), bytes in any::<[u8; 4]>(), bit in any::<bool>()) {
        prop_assert_eq!(Rgb565.encode(Rgb565.decode(word)), word);
        prop_assert_eq!(Rgba8888.encode(Rgba8888.decode(bytes)), bytes);
        prop_assert_eq!(OneBit.encode(OneBit.decode(bit)), bit);
        let [red, green, blue] = Rgb565.decode(word).color.map(course::real);
        for (got, level, most) in [(red, word >> 11, 31.0), (green, word >> 5 & 63, 63.0), (blue, word & 31, 31.0)] {
            prop_assert!((got - f64::from(level) / most).abs() * f64::from(ONE) < 1.0);
        }
    }
}

/// The eight rectangles; the picture itself is compared in the host tools' `pipeline_pictures`.
#[test]
fn item_10_4_the_usual_transparency() {
    let rectangles = [
        ([10.0, 10.0, 100.0, 100.0], [1.0, 0.0, 0.0, 0.5]),
        ([80.0, 20.0, 100.0, 100.0], [0.0, 1.0, 0.0, 0.5]),
        ([70.0, 60.0, 40.0, 200.0], [0.0, 0.0, 1.0, 0.75]),
        ([20.0, 240.0, 200.0, 20.0], [1.0, 1.0, 1.0, 1.0]),
        ([20.0, 200.0, 200.0, 20.0], [1.0, 1.0, 1.0, 0.75]),
        ([20.0, 160.0, 200.0, 20.0], [1.0, 1.0, 1.0, 0.5]),
        ([20.0, 120.0, 200.0, 20.0], [1.0, 1.0, 1.0, 0.25]),
        ([20.0, 80.0, 200.0, 20.0], [1.0, 1.0, 1.0, 0.15]),
    ];
    let mut pixels = opaque_black();
    let mut at_run_time = opaque_black();
    for ([x, y, w, h], c) in rectangles {
        let vertices = square([x, y, x + w, y + h], 0.0, color(c));
        let mut surface = Surface::new(buffer(&mut pixels), HeadRoom).blended(Translucent);
        draw(&state(), &mut surface, &mut NoDepth, &paint(), &vertices);
        let mut surface = Surface::new(buffer(&mut at_run_time), HeadRoom).blended(Some(Blend::TRANSLUCENT));
        draw(&state(), &mut surface, &mut NoDepth, &paint(), &vertices);
    }
    assert!(pixels == at_run_time);
    let want = [
        ((15, 15), [0.5, 0.0, 0.0, 0.75]),
        ((90, 30), [0.25, 0.5, 0.0, 0.625]),
        ((90, 90), [0.203125, 0.25625, 0.7875, f64::NAN]),
        ((90, 170), [0.5, 0.5, 0.875, f64::NAN]),
        ((30, 90), [0.575, 0.15, 0.15, f64::NAN]),
    ];
    for ((x, y), want) in want {
        for (got, want) in reals(pixel(&pixels, x, y))
            .into_iter()
            .zip(want)
            .filter(|(_, want)| !want.is_nan())
        {
            near(got, want, 1e-7);
        }
    }
}

/// Logs what each step does at one pixel: depth and blending by types of its own.
#[test]
fn item_10_5_order_per_fragment() {
    let log = RefCell::new(Vec::new());
    struct Logged<'a>(&'a RefCell<Vec<&'static str>>);
    impl Blending for Logged<'_> {
        fn blend(&self, source: Rgba, _: Rgba) -> Rgba {
            self.0.borrow_mut().push("blend");
            source
        }
    }
    impl PixelFormat for Logged<'_> {
        type Pixel = Rgba;
        fn encode(&self, color: Rgba) -> Rgba {
            self.0.borrow_mut().push("write");
            color
        }
        fn decode(&self, pixel: Rgba) -> Rgba {
            pixel
        }
    }
    struct LoggedDepth<'a>(&'a RefCell<Vec<&'static str>>, bool);
    impl Depth for LoggedDepth<'_> {
        type Cell<'c> = (&'c RefCell<Vec<&'static str>>, bool);
        type Cells<'c>
            = std::iter::RepeatN<Self::Cell<'c>>
        where
            Self: 'c;
        type Block<'c>
            = std::convert::Infallible
        where
            Self: 'c;
        const ENABLED: bool = true;
        fn limit(&self, window: fixel::window::Window) -> fixel::window::Window {
            window
        }
        fn cells(&mut self, span: &fixel::span::Span) -> Self::Cells<'_> {
            std::iter::repeat_n((self.0, self.1), (span.right - span.left) as usize)
        }
        fn block(&mut self, _: &fixel::window::Window, _: usize, _: usize) -> Option<Self::Block<'_>> {
            None
        }
        fn block_cells<'c, 'd: 'c>(block: &'c mut Self::Block<'d>, _: usize, _: usize) -> Self::Cells<'c>
        where
            Self: 'd,
        {
            match *block {}
        }
        fn test((log, passes): Self::Cell<'_>, _: u32) -> bool {
            log.borrow_mut().push("depth");
            passes
        }
    }
    let run = |keep: bool, passes: bool| {
        let mut pixels = opaque_black();
        let shader = program(|_, []: [i32; 0]| {
            log.borrow_mut().push("program");
            keep.then_some(rgba([1.0; 4]))
        });
        let mut surface = Surface::new(buffer(&mut pixels), Logged(&log)).blended(Logged(&log));
        let dot = square([5.0, 5.0, 6.0, 6.0], 0.5, []);
        draw(&state(), &mut surface, &mut LoggedDepth(&log, passes), &shader, &dot);
        log.take()
    };
    assert_eq!(run(true, true), ["program", "depth", "blend", "write"]);
    assert_eq!(run(true, false), ["program", "depth"]);
    assert_eq!(run(false, true), ["program"]);
}

#[test]
fn item_10_6_opaque_ones_first_then_back_to_front() {
    /// A square of a colour; `z` is that of view space.
    struct Pane {
        z: f64,
        color: [f64; 4],
    }
    let projection =
        Matrix::<i32>::perspective::<SineTable>(Angle::from_degrees(90), scaled(1.0), scaled(1.0), scaled(9.0));
    let projection = projection.unwrap();
    let vertices = |pane: &Pane| {
        let corner = |x: f64, y: f64| (projection.transform(block([x, y, pane.z, 1.0])), color(pane.color));
        [
            corner(-1.0, -1.0),
            corner(1.0, -1.0),
            corner(1.0, 1.0),
            corner(-1.0, -1.0),
            corner(1.0, 1.0),
            corner(-1.0, 1.0),
        ]
    };
    let scene = |panes: &[&Pane], walls: &[Pane]| {
        let (mut pixels, mut depths) = (opaque_black(), picture(FAR));
        let mut depth = Switched::new(buffer(&mut depths));
        let mut surface = Surface::new(buffer(&mut pixels), HeadRoom).blended(None);
        for wall in walls {
            draw(&state(), &mut surface, &mut depth, &paint(), &vertices(wall));
        }
        let mut sorted = panes.to_vec();
        sorted.sort_by(|a, b| a.z.total_cmp(&b.z));
        (depth.options.stores, surface.blending) = (false, Some(Blend::TRANSLUCENT));
        for pane in sorted {
            draw(&state(), &mut surface, &mut depth, &paint(), &vertices(pane));
        }
        pixel(&pixels, 150, 150)
    };
    let red = Pane {
        z: -2.0,
        color: [1.0, 0.0, 0.0, 0.5],
    };
    let green = Pane {
        z: -3.0,
        color: [0.0, 1.0, 0.0, 0.5],
    };
    for order in [[&red, &green], [&green, &red]] {
        all_near(reals(scene(&order, &[])), [0.5, 0.25, 0.0, 0.625], 1e-7);
    }
    let wall = Pane {
        z: -2.5,
        color: [0.0, 0.0, 1.0, 1.0],
    };
    all_near(reals(scene(&[&green], &[wall])), [0.0, 0.0, 1.0, 1.0], 1e-7);
}

#[test]
fn item_11_1_front_is_counter_clockwise() {
    let corners = [(0.0, 0.0), (10.0, 0.0), (0.0, 10.0)].map(|p| course::at(p, []));
    let [a, b, c] = corners;
    let drawn = |culling, vertices: &[Vertex<0>]| {
        let mut state = state();
        state.culling = culling;
        lit(&triangles_hit(&state, vertices)).len()
    };
    // Twice the area is 100: 45 centres within, 10 on the long edge, which is a left or upper one for one of the two.
    let all = drawn(Culling::Off, &corners);
    assert_eq!(all.abs_diff(50), 5);
    assert_eq!(
        (drawn(Culling::Back, &corners), drawn(Culling::Front, &corners)),
        (all, 0)
    );
    assert_eq!(
        (drawn(Culling::Back, &[a, c, b]), drawn(Culling::Front, &[a, c, b])),
        (0, all)
    );
    // On the whole clipped polygon: one corner behind the camera would turn the triangle of projected corners over.
    let behind = [[-2.0, -1.0, -2.0, 1.0], [2.0, -1.0, -2.0, 1.0], [0.0, -1.0, 2.0, 1.0]];
    let projection =
        Matrix::<i32>::perspective::<SineTable>(Angle::from_degrees(90), scaled(1.0), scaled(1.0), scaled(9.0));
    let floor = behind.map(|p| (projection.unwrap().transform(block(p)), []));
    // Seen from above; (−2, −1), (2, −1), (0, −1) behind: front would be with y up the order left, right, far.
    let front = drawn(Culling::Back, &floor);
    assert_eq!((front, drawn(Culling::Front, &floor)), (0, drawn(Culling::Off, &floor)));
    let [a, b, c] = floor;
    assert_eq!(drawn(Culling::Back, &[a, c, b]), drawn(Culling::Off, &floor));
}

/// The cube of ±1 seen from a corner, its vertices in any order of triangles.
fn cube(colors: impl Fn(usize) -> [f64; 4]) -> Vec<[Vertex<4>; 3]> {
    let eye = block([2.5, 2.0, 3.5]);
    let view = Matrix::<i32>::look_at(eye, block([0.0; 3]), block([0.0, 1.0, 0.0])).unwrap();
    let projection = Matrix::perspective::<SineTable>(Angle::from_degrees(60), scaled(1.0), scaled(1.0), scaled(9.0));
    let both = projection.unwrap().product(&view);
    let triangle = |(i, corners): (usize, &[pipeline::shapes::Corner])| {
        [0, 1, 2].map(|k| (both.transform(corners[k].point()), color(colors(i))))
    };
    BOX.chunks(3).enumerate().map(triangle).collect()
}

fn cube_picture(culling: Culling, vertices: &[[Vertex<4>; 3]], depth: bool, translucent: bool) -> Vec<Rgba> {
    let (mut pixels, mut depths) = (opaque_black(), picture(FAR));
    let mut state = state();
    state.culling = culling;
    let mut buffers = Switched::new(buffer(&mut depths));
    if !depth {
        buffers.options = Options {
            passes: Relation::Always,
            stores: false,
        };
    }
    let blending = translucent.then_some(Blend::TRANSLUCENT);
    let mut surface = Surface::new(buffer(&mut pixels), HeadRoom).blended(blending);
    draw(&state, &mut surface, &mut buffers, &paint(), &vertices.concat());
    pixels
}

fn shades(i: usize) -> [f64; 4] {
    [(i / 2 + 1) as f64 / 8.0, (i % 3) as f64 / 4.0, 0.5, 0.5]
}

#[test]
fn item_11_2_culling_front_back_or_both() {
    let cube = cube(shades);
    let colors = |pixels: &[Rgba]| {
        let mut seen: Vec<_> = pixels.iter().map(|p| p.color[0]).filter(|&red| red != 0).collect();
        seen.sort();
        seen.dedup();
        seen.len()
    };
    let [off, back, front] = [Culling::Off, Culling::Back, Culling::Front].map(|c| cube_picture(c, &cube, true, false));
    assert_eq!(colors(&back), 3);
    assert!(off == back);
    // Its inside: the other three faces.
    assert_eq!(colors(&front), 3);
    assert!(front != back);
    assert_eq!(colors(&cube_picture(Culling::FrontAndBack, &cube, true, false)), 0);
    let mut pixels = opaque_black();
    let mut nothing = state();
    nothing.culling = Culling::FrontAndBack;
    pipeline::lines(&nothing, &mut buffer(&mut pixels), &mut NoDepth, &paint(), cube[0]);
    assert!(colors(&pixels) > 0);
}

#[test]
fn item_11_3_a_convex_translucent_object_in_any_order() {
    let mut cube = cube(shades);
    let first = cube_picture(Culling::Back, &cube, false, true);
    let every = cube_picture(Culling::Off, &cube, false, true);
    assert!(first != every);
    let mut random = Random(11);
    for _ in 0..10 {
        for i in (1..cube.len()).rev() {
            cube.swap(i, random.below(i as u32 + 1) as usize);
        }
        assert!(cube_picture(Culling::Back, &cube, false, true) == first);
    }
}

#[test]
fn item_11_4_winding_is_the_same_in_every_viewport() {
    let corners = [
        deep((10.0, 10.0), 0.5, []),
        deep((200.0, 10.0), 0.5, []),
        deep((10.0, 200.0), 0.5, []),
    ];
    let side = SIDE as u16;
    let viewports = [
        Viewport::<i32>::new(0, 0, side, side).unwrap(),
        Viewport::new(40, 70, 20, 90).unwrap().samples_at_centers(),
        Viewport::new(0, 0, side, side).unwrap().y_up(),
        Viewport::new(100, 100, 90, 30).unwrap().y_up().samples_at_centers(),
    ];
    for viewport in viewports {
        let mut state = State::<_, i32, i32, 1>::new(viewport);
        let [a, b, c] = corners;
        for (culling, front, back) in [(Culling::Back, true, false), (Culling::Front, false, true)] {
            state.culling = culling;
            assert_eq!(
                !lit(&triangles_hit(&state, &[a, b, c])).is_empty(),
                front,
                "{viewport:?}"
            );
            assert_eq!(
                !lit(&triangles_hit(&state, &[a, c, b])).is_empty(),
                back,
                "{viewport:?}"
            );
        }
    }
    all_near(
        floats(corners[0].0).map(|v| v / 300.0),
        [-280.0 / 300.0, -280.0 / 300.0, 0.0, 1.0],
        1e-6,
    );
}

/// A depth buffer as it is used by type, beside the switched one of the other tests.
#[test]
fn translucent_panes_do_not_store_depth_by_type() {
    let (mut pixels, mut depths) = (opaque_black(), picture(FAR));
    let mut depth = DepthBuffer::<_, fixel::depth::Keep<LessOrEqual>>::new(buffer(&mut depths));
    let mut surface = Surface::new(buffer(&mut pixels), HeadRoom).blended(Translucent);
    let pane = square([0.0, 0.0, 9.0, 9.0], 0.5, color([1.0, 0.0, 0.0, 0.5]));
    draw(&state(), &mut surface, &mut depth, &paint(), &pane);
    assert!(depths.iter().all(|&d| d == FAR));
    assert_eq!(pixels[0].color[0], ONE / 2);
}
