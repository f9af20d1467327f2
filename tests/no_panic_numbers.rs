//! Numbers, matrices, viewports and angles: no input whatsoever panics or overflows (`no_panic.rs` draws). What comes
//! out is only asked to be well formed: mantissas within the word's bits, normalised.

use fixel::blend::{ONE, Rgba, over565, over888};
use fixel::clip::{DepthRange, Planes};
use fixel::edge::Edge;
use fixel::fragment::Fragment;
use fixel::matrix::{Directions, Matrix};
use fixel::mesh::Normalized;
use fixel::num::{
    Angle, Block, OneStep, Precision, Scaled, ShortSine, SineTable, Table, Trigonometry, TwoSteps, Word, reciprocal,
};
use fixel::pipeline::{ClampToEdge, MirroredRepeat};
use fixel::span::scan;
use fixel::srgb::{decode, decode_wide, encode};
use fixel::supersample::Level;
use fixel::texture::{Bilinear565, Rgb565, Texel, Texture, TiledBilinear565};
use fixel::varying::Perspective32;
use fixel::viewport::Viewport;
use fixel::window::Window;
use proptest::prelude::*;

fn int() -> impl Strategy<Value = i32> + Clone {
    const ENDS: &[i32] = &[i32::MIN, i32::MIN + 1, i32::MAX, 0, 1, -1, 1 << 30, -(1 << 30), 1 << 29];
    prop_oneof![3 => any::<i32>(), 2 => prop::sample::select(ENDS), 2 => -300..300i32, 1 => (0..31u32).prop_map(|b| 1 << b)]
}

fn long() -> impl Strategy<Value = i64> + Clone {
    const ENDS: &[i64] = &[i64::MIN, i64::MIN + 1, i64::MAX, 0, 1, -1, 1 << 62, -(1 << 62), 1 << 61];
    prop_oneof![3 => any::<i64>(), 2 => prop::sample::select(ENDS), 2 => -300..300i64, 1 => (0..63u32).prop_map(|b| 1 << b)]
}

fn wide_int() -> impl Strategy<Value = i64> {
    prop_oneof![long(), Just(i64::MAX - 1)]
}

fn wide_long() -> impl Strategy<Value = i128> {
    prop_oneof![
        any::<i128>(),
        long().prop_map(i128::from),
        Just(i128::MAX),
        Just(i128::MIN),
        Just(1 << 124)
    ]
}

fn rgba() -> impl Strategy<Value = Rgba> + Clone {
    let alpha = prop_oneof![int(), 0..=ONE, prop::sample::select(&[ONE - 1, ONE, ONE + 1][..])];
    (prop::array::uniform3(int()), alpha).prop_map(|(color, alpha)| Rgba { color, alpha })
}

fn exponent() -> impl Strategy<Value = i32> + Clone {
    prop_oneof![4 => -40..40i32, 1 => any::<i32>(), 1 => prop::sample::select(&[i32::MIN, i32::MAX][..])]
}

/// Numbers of words `T`, as many as 16.
fn blocks<T: Word>(word: impl Strategy<Value = T> + Clone + 'static) -> impl Strategy<Value = Vec<(T, i32)>> {
    prop::collection::vec((word, exponent()), 16)
}

fn well_formed<T: Word, const N: usize>(block: Block<T, N>) {
    let largest = block
        .mantissas()
        .map(|m| m.to_i64().unsigned_abs())
        .into_iter()
        .max()
        .unwrap();
    let top = 1u64 << T::BITS;
    assert!(
        largest == 0 || (top / 2..=top).contains(&largest),
        "{block:?} is not normalised"
    );
}

fn arithmetic<T: Word>(n: &[(T, i32)]) {
    let scalar = |i: usize| Scaled::new([n[i].0], n[i].1);
    let vector = |i: usize| Block::new([n[i].0, n[i + 1].0, n[i + 2].0], n[i].1);
    let (a, b, c) = (vector(0), vector(3), scalar(6));
    for block in [
        a,
        b,
        a.plus(b),
        a.minus(b),
        a.times(c),
        a.over(c).unwrap_or(a),
        a.cross(b),
        a.negated(),
    ] {
        well_formed(block);
        well_formed(block.scaled(n[7].1));
    }
    well_formed(a.dot(b));
    well_formed(Block::<T, 3>::gather([0, 1, 2].map(scalar)));
    let one = T::ONE << T::BITS;
    for m in a.unit().into_iter().flatten() {
        assert!((-one..=one).contains(&m));
    }
    for bits in [0, 15, 30, 63, 64, n[8].1 as u32, u32::MAX] {
        c.to_fixed(bits);
    }
}

fn matrices<T: Word>(n: &[(T, i32)], angle: u64) {
    let scalar = |i: usize| Scaled::new([n[i].0], n[i].1);
    let vector = |i: usize| Block::new([n[i].0, n[i + 1].0, n[i + 2].0], n[i].1);
    let angle = Angle::from_turns(angle);
    let scattered = Matrix::from_scaled(std::array::from_fn(scalar));
    let mut all = vec![scattered, Matrix::translation(vector(0)), Matrix::scaling(vector(3))];
    all.extend(Matrix::rotation::<SineTable>(angle, vector(0)));
    #[cfg(feature = "micromath")]
    all.extend(Matrix::rotation::<fixel::num::Micromath>(angle, vector(0)));
    all.extend(Matrix::camera::<SineTable>(vector(6), vector(3), angle));
    all.extend(Matrix::camera::<SineTable>(vector(6), Block::ZERO, Angle::default()));
    all.extend(Matrix::look_at(vector(0), vector(3), vector(6)));
    all.extend(Matrix::frustum(std::array::from_fn(scalar)));
    all.extend(Matrix::ortho(std::array::from_fn(scalar)));
    let mut directions = Directions::identity();
    let _ = directions.look_at(vector(9), vector(3), vector(6));
    for matrix in all {
        well_formed(matrix.entries());
        well_formed(matrix.product(&scattered).entries());
        well_formed(matrix.transform(Block::new([n[0].0, n[3].0, n[5].0, n[9].0], n[3].1)));
        directions.load_product(&matrix);
        directions.scale(vector(10));
        let _ = directions.rotate::<SineTable>(angle, vector(4));
        well_formed(directions.turn(vector(7)));
        let mut loaded = Directions::identity();
        loaded.load(&matrix);
        well_formed(loaded.turn(vector(7)));
    }
}

fn clipped<T: Word>(n: &[(T, i32)]) {
    let point = |i: usize| Block::new([n[i].0, n[i + 1].0, n[i + 2].0, n[i + 3].0], n[i].1);
    let mut planes = Planes::<T, 5>::default();
    for i in [3, 4, 5, 6, 12] {
        planes.push(point(i)).unwrap();
    }
    assert!(planes.push(point(0)).is_err());
    if let Some(polygon) = planes.clip([point(0), point(1), point(2)]) {
        assert!((1..=3 + 5).contains(&polygon.len()) && polygon.get(polygon.len()).is_none());
        polygon.iter().for_each(|corner| well_formed(corner.position));
    }
}

fn viewports<W: Word, T: Word>([left, top]: [i32; 2], size: [u16; 2], n: &[(T, i32)]) {
    let Ok(viewport) = Viewport::<W>::new(left, top, size[0], size[1]) else {
        return;
    };
    let limit = W::GUARD * 256;
    for viewport in [viewport, viewport.y_up(), viewport.samples_at_centers().y_up()] {
        for range in [DepthRange::ZeroToOne, DepthRange::MinusOneToOne, DepthRange::Unlimited] {
            if let Some((x, y, depth)) = viewport.place(Block::new([n[0].0, n[1].0, n[2].0, n[3].0], n[0].1), range) {
                assert!(x.abs() <= limit && y.abs() <= limit && (0..=65535 << 15).contains(&depth));
            }
        }
    }
}

/// Positions of a mesh, of any size.
fn mesh_points<T: Word>(n: [i32; 3]) {
    well_formed(n.point::<T>());
    well_formed(n.map(|c| c as i16).point::<T>());
}

/// The whole guard band of each word, in any window.
fn spans<W: Word>(corners: [(i32, i32); 3], window: Window) {
    const { assert!(<i32 as Word>::GUARD * 256 == 1 << 20 && <i64 as Word>::GUARD * 256 == 1 << 23) };
    let corners = corners.map(|(x, y)| {
        let limit = W::GUARD * 256;
        (x.clamp(-limit, limit), y.clamp(-limit, limit))
    });
    for ccw in [false, true] {
        scan::<W>(&corners, ccw, window, |span| {
            assert!(window.left <= span.left && span.left < span.right && span.right <= window.right);
        });
    }
    let [a, b, _] = corners;
    let row = (a.1 + 255) >> 8;
    if a.1 < b.1 && row * 256 < b.1 {
        Edge::<W>::new(a, b, row).column();
        Edge::<W>::new(a, b, (b.1 - 1) >> 8).column();
    }
}

fn at_precision<P: Precision>(
    word: u32,
    [vector, other]: [[i32; 3]; 2],
    long: [i64; 3],
    (base, exponent): (i32, u32),
) -> Result<(), TestCaseError> {
    prop_assert!((1 << 31..=1 << 32).contains(&P::reciprocal(word)));
    prop_assert!(P::reciprocal_square_root(word) >= 1 << 31);
    prop_assert!((0..=1 << 30).contains(&P::power(base, exponent)));
    for unit in [P::unit(vector), P::unit_wide(long)].into_iter().flatten() {
        prop_assert!(unit.iter().all(|c| c.unsigned_abs() <= (1 << 30) + P::UNIT_ERROR));
        P::dot(unit, other.map(|c| c >> 1));
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn any_narrow_numbers(n in blocks(int()), wide in prop::array::uniform2(wide_int()), e in exponent()) {
        arithmetic(&n);
        clipped(&n);
        well_formed(Block::<i32, 2>::from_wide(wide, e));
    }

    #[test]
    fn any_wide_numbers(n in blocks(long()), wide in prop::array::uniform2(wide_long()), e in exponent()) {
        arithmetic(&n);
        clipped(&n);
        well_formed(Block::<i64, 2>::from_wide(wide, e));
    }

    #[test]
    fn any_matrices(narrow in blocks(int()), wide in blocks(long()), angle in any::<u64>()) {
        matrices(&narrow, angle);
        matrices(&wide, angle);
    }

    #[test]
    fn any_viewport(
        corner in prop::array::uniform2(prop_oneof![-40000..40000i32, int()]), size in prop::array::uniform2(any::<u16>()),
        narrow in blocks(int()), wide in blocks(long()),
    ) {
        viewports::<i32, i32>(corner, size, &narrow);
        viewports::<i32, i64>(corner, size, &wide);
        viewports::<i64, i32>(corner, size, &narrow);
        viewports::<i64, i64>(corner, size, &wide);
    }

    #[test]
    fn any_spans(
        corners in prop::array::uniform3((int(), int())), left in int(), right in int(), top in int(), bottom in int(),
    ) {
        mesh_points::<i32>([left, top, right]);
        mesh_points::<i64>([left, top, right]);
        let window = Window::new(left, top, right, bottom);
        spans::<i32>(corners, window);
        spans::<i64>(corners, window);
        let _ = (window.is_empty(), window.width(), window.height(), window.intersect(Window::new(top, left, 0, 0)));
    }

    #[test]
    fn any_angle_and_divisor(degrees in int(), turns in any::<u64>(), divisor in any::<u32>()) {
        let _ = (Angle::from_degrees(degrees), Angle::from_radians(turns as i64), reciprocal(divisor));
        let (_, _) = (SineTable::sin_cos::<i32>(Angle::from_turns(turns)), SineTable::sin_cos::<i64>(Angle::from_turns(turns)));
        let (_, _) = (ShortSine::sin_cos::<i32>(Angle::from_turns(turns)), ShortSine::sin_cos::<i64>(Angle::from_turns(turns)));
    }

    #[test]
    fn any_number_at_any_precision(
        word in any::<u32>(), vector in prop::array::uniform3(int()), other in prop::array::uniform3(int()),
        long in prop::array::uniform3(long()), base in int(), exponent in prop_oneof![any::<u32>(), 0..1u32 << 20],
    ) {
        at_precision::<Table>(word, [vector, other], long, (base, exponent))?;
        at_precision::<OneStep>(word, [vector, other], long, (base, exponent))?;
        at_precision::<TwoSteps>(word, [vector, other], long, (base, exponent))?;
    }

    #[test]
    fn any_blending(top in rgba(), below in rgba(), part in int(), texel in any::<[u8; 4]>(), bits in any::<u32>()) {
        let whole = 0..=ONE;
        let word = bits as u16;
        let _ = (over565(top, word), over888(top, [word as u8; 3]));
        for shift in [0, 4, 30, bits % 64, bits] {
            let texel = Rgba::from_texel(Texel(texel), shift);
            for result in [top.over(below), below.over(top), texel.over(top), top.over(texel), top.faded(part)] {
                assert!(whole.contains(&result.alpha));
            }
        }
        let _ = decode(word as u8);
        for v in top.color {
            let linear = decode_wide(v);
            assert!(encode(v) <= 255 << 16 && (-(1i64 << 36)..1 << 46).contains(&linear));
        }
    }

    #[test]
    fn any_place_on_any_texture(
        st in prop::array::uniform2(int()), bits in prop_oneof![0..40u32, any::<u32>()], width in 1..=70u16, height in 1..=70u16,
        texels in prop::collection::vec(any::<u16>(), 70 * 70),
    ) {
        let sampler = Bilinear565::new(Texture::new(Rgb565, &texels, width, height).unwrap(), bits);
        let clamped = sampler.wrapped(ClampToEdge, MirroredRepeat);
        let _ = (sampler.stored(st), sampler.levels(st), clamped.stored(st), clamped.levels(st));
        let rows = [[texels[0], texels[1]], [texels[2], texels[3]]];
        let tiled = TiledBilinear565::<Perspective32<2>, 2, 2>::new(&rows);
        let _ = (tiled.levels(st), tiled.shade(st, 0));
    }

    #[test]
    fn any_samples(
        n in 1..=16u32, samples in prop::collection::vec(rgba(), 0..600),
        stride in prop_oneof![0..40usize, any::<usize>()], words in prop::collection::vec(any::<u16>(), 0..600),
    ) {
        let level = Level::new(n).unwrap();
        level.resolve(&samples, stride, |x, pixel| {
            assert!((x + 1) * n as usize <= stride && (0..=ONE).contains(&pixel.alpha));
        });
        level.resolve565(&words, stride, |x, _| assert!((x + 1) * n as usize <= stride));
    }
}
