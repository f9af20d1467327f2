//! The camera and the Transforms of `.iv` scenes: matrices against float64, and the handout's worked example.

mod exact;

use exact::{block, float, floats, scaled};
use fixel::error::Error;
use fixel::matrix::{Directions, Matrix};
use fixel::num::{Angle, Block, SineTable, Word};
use proptest::prelude::*;

/// Radians as a fraction of a turn.
fn radians(angle: f64) -> Angle {
    Angle::from_turns(((angle / std::f64::consts::TAU).rem_euclid(1.0) * 2f64.powi(64)) as u64)
}

fn point<T: Word>([x, y, z]: [f64; 3]) -> Block<T, 4> {
    block([x, y, z, 1.0])
}

/// The camera undoes its own placement: where it would put p, p is seen.
fn check_camera<T: Word>(position: [f64; 3], axis: [f64; 3], angle: f64, p: [f64; 3]) -> Result<(), TestCaseError> {
    let (at, axis, turn) = (block::<T, 3>(position), block::<T, 3>(axis), radians(angle));
    let camera = Matrix::camera::<SineTable>(at, axis, turn).unwrap();
    let placed = Matrix::translation(at).product(&Matrix::rotation::<SineTable>(turn, axis).unwrap());
    let seen = floats(camera.transform(placed.transform(point(p))));
    // Each of the four roundings and the rotation's 24 units (`matrices.rs`) counts by the largest number on the way.
    let size = position.iter().chain(&p).fold(1.0f64, |most, v| most.max(v.abs()));
    let bound = 3.0 * (24.0 + 4.0) * size * size * 2f64.powi(-(T::BITS.min(48) as i32));
    for i in 0..3 {
        prop_assert!(
            (seen[i] / seen[3] - p[i]).abs() <= bound,
            "{:?} is not {:?} within {}",
            seen,
            p,
            bound
        );
    }
    Ok(())
}

/// T R S of several blocks: M·p, and N·n at right angles to M·t where n and t are.
fn check_transforms<T: Word>(steps: &[([f64; 3], f64, [f64; 3])]) -> Result<(), TestCaseError> {
    let (mut matrix, mut directions) = (Matrix::<T>::identity(), Directions::<T>::identity());
    for &(axis, angle, scale) in steps {
        let (axis, turn, scale) = (block(axis), radians(angle), block(scale));
        let translation = Matrix::translation(block([3.0, -1.0, 2.0]));
        let rotation = Matrix::rotation::<SineTable>(turn, axis).unwrap();
        matrix = matrix
            .product(&translation)
            .product(&rotation)
            .product(&Matrix::scaling(scale));
        directions.rotate::<SineTable>(turn, axis).unwrap();
        directions.scale(scale);
    }
    let mut loaded = Directions::identity();
    loaded.load(&matrix);
    for axis in [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map(Block::from_integers) {
        let (stepwise, whole) = (floats(directions.turn(axis)), floats(loaded.turn(axis)));
        let size = stepwise.iter().fold(0.0f64, |most, v| most.max(v.abs()));
        // Scales of ½ to 2 three times over: a condition of 4³ at most, squared in the cofactors.
        let bound = size * 2f64.powi(16 - T::BITS.min(48) as i32);
        for i in 0..3 {
            prop_assert!((stepwise[i] - whole[i]).abs() <= bound, "{:?} {:?}", stepwise, whole);
        }
    }
    Ok(())
}

fn vector(reach: f64) -> impl Strategy<Value = [f64; 3]> {
    prop::array::uniform3(-reach..reach)
}

fn direction() -> impl Strategy<Value = [f64; 3]> {
    vector(1.0).prop_filter("a direction", |v| v.iter().map(|x| x * x).sum::<f64>() > 1e-3)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn a_camera_undoes_its_placement(at in vector(50.0), axis in direction(), angle in -20.0..20.0f64, p in vector(50.0)) {
        check_camera::<i32>(at, axis, angle, p)?;
        check_camera::<i64>(at, axis, angle, p)?;
    }

    /// What is kept step by step is the inverse transpose of the whole.
    #[test]
    fn normals_through_several_transforms(
        steps in prop::collection::vec((direction(), -9.0..9.0f64, prop::array::uniform3(0.5..2.0f64)), 1..4),
        mirrored: bool,
    ) {
        let mut steps = steps;
        if mirrored {
            steps[0].2[1] *= -1.0;
        }
        check_transforms::<i32>(&steps)?;
        check_transforms::<i64>(&steps)?;
    }

    #[test]
    fn radians_are_turns(r in any::<i64>()) {
        let turns = Angle::from_radians(r).turns();
        // r·2^-32/2π turns; 1/2π in units of 2^-124, the whole turns dropped.
        const INVERSE_TAU: u128 = 0x028b_e60d_b939_1054_a7f0_9d5f_47d4_d377;
        let part = |word: u128| (r as i128 as u128).wrapping_mul(word);
        // 2^64·r·2^-32·INVERSE_TAU·2^-124 = r·INVERSE_TAU·2^-92, by high and low halves.
        let high = part(INVERSE_TAU >> 64) as i128;
        let low = (r as i128 * (INVERSE_TAU as u64 >> 1) as i128) >> 63;
        let wanted = ((high + low) >> 28) as u64;
        let off = turns.wrapping_sub(wanted) as i64;
        prop_assert!(off.unsigned_abs() <= 2 + (r.unsigned_abs() >> 33), "{} off", off);
    }
}

#[test]
fn without_an_axis_there_is_no_turn() {
    let at = Block::<i64, 3>::from_integers([1, -2, 3]);
    let still = Matrix::translation(Block::from_integers([-1, 2, -3]));
    for axis in [[0, 0, 0], [0, 0, 1], [3, -4, 5]].map(Block::from_integers) {
        assert_eq!(Matrix::camera::<SineTable>(at, axis, Angle::default()), Ok(still));
    }
    let turned = Matrix::camera::<SineTable>(at, Block::ZERO, Angle::from_turns(1));
    assert_eq!(turned, Err(Error::ZeroVector));
}

/// cube3: all figures to the six digits given.
fn worked_example<T: Word>() {
    let near = |found: f64, wanted: f64| assert!((found - wanted).abs() < 6e-7, "{found} is not {wanted}");
    let projection = Matrix::<T>::frustum([-0.5, 0.5, -0.5, 0.5, 1.0, 10.0].map(scaled)).unwrap();
    let entries = floats(projection.entries());
    for (i, wanted) in [(0, 2.0), (5, 2.0), (10, -11.0 / 9.0), (11, -20.0 / 9.0), (14, -1.0)] {
        near(entries[i], wanted);
    }
    assert_eq!(entries.iter().filter(|e| **e != 0.0).count(), 5);

    let (axis, turn) = (Block::from_integers([1, 1, 0]), radians(7853.0 / 1e4));
    let model = Matrix::<T>::rotation::<SineTable>(turn, axis).unwrap();
    let rows = [
        0.853588, 0.146412, 0.499951, 0.0, 0.146412, 0.853588, -0.499951, 0.0, -0.499951, 0.499951, 0.707176,
    ];
    for (found, wanted) in floats(model.entries()).into_iter().zip(rows) {
        near(found, wanted);
    }
    let world = model.transform(Block::from_integers([-1, 1, 1, 1]));
    for (found, wanted) in floats(world).into_iter().zip([-0.207225, 0.207225, 1.707078, 1.0]) {
        near(found, wanted);
    }
    let camera = Matrix::camera::<SineTable>(
        Block::from_integers([0, 0, 5]),
        Block::from_integers([0, 0, 1]),
        Angle::default(),
    );
    let clip = projection.transform(camera.unwrap().transform(world));
    for (found, wanted) in floats(clip).into_iter().zip([-0.414451, 0.414451, 1.802460, 3.292922]) {
        near(found, wanted);
    }
    let mut directions = Directions::<T>::identity();
    directions.rotate::<SineTable>(turn, axis).unwrap();
    let normal = directions.turn(Block::from_integers([0, 0, 1])).split().map(float);
    for (found, wanted) in normal.into_iter().zip([0.499951, -0.499951, 0.707176]) {
        near(found, wanted);
    }
}

#[test]
fn the_worked_example() {
    worked_example::<i32>();
    worked_example::<i64>();
}
