//! Matrices and directions against exact arithmetic, both words, at any scale. `blocks.rs` does the numbers they are made of.

mod exact;

use exact::{
    Exact, Number, block, check_near, cross, dot, exacts, floats, gathered, largest, number, scaled, units, word,
};
use fixel::error::Error;
use fixel::matrix::{Directions, Matrix};
use fixel::num::{Angle, Block, Scaled, SineTable, Trigonometry, Word};
use proptest::prelude::*;

/// All errors are in units of 2^-BITS of the largest number of the result, unless it says otherwise.
///
/// One rounding to nearest is at most half a place of a mantissa of BITS − 1 bits: a unit.
const ROUNDED: i64 = 1;
/// Entries of a projection: both operands of a quotient are rounded, and the quotient is.
const PROJECTION: i64 = 4;
/// R·Rᵀ − 1, R·axis − axis of a rotation, per entry, to first order: a unit vector is up to 2 units too long or too short, which
/// counts 8 times where it turns half way round; sine and cosine are off by 4 units each (8 those of wide words), 2·√2 times; and
/// the three entries of a row by 1.5 units of rounding, 2·√3 times. 16 + 23 + 5; 33 for narrow words, of which 24 were seen.
const ROTATION: i64 = 44;
/// D·Mᵀ − 1 of an inverse transpose, in units times the largest entries of D and M in the sum: the cofactors, the
/// determinant and the quotient are rounded, and the determinant's error counts as often as the sum cancels.
const INVERSE: i64 = 16;

fn check_product<T: Word>(a: [Number; 16], b: [Number; 16], v: [Number; 4]) -> Result<(), TestCaseError> {
    let (a, b) = (
        Matrix::from_scaled(a.map(word::<T>)),
        Matrix::from_scaled(b.map(word::<T>)),
    );
    let (xa, xb, point) = (exacts(a.entries()), exacts(b.entries()), gathered::<T, 4>(v));
    let row = |i: usize| &xa[4 * i..4 * i + 4];
    let column = |j: usize| [0, 1, 2, 3].map(|i| xb[4 * i + j].clone());
    let product: [Exact; 16] = std::array::from_fn(|k| dot(row(k / 4), &column(k % 4)));
    check_near(a.product(&b).entries(), &product, ROUNDED, &Exact::zero())?;
    let x = exacts(point);
    check_near(
        a.transform(point),
        &[0, 1, 2, 3].map(|i| dot(row(i), &x)),
        ROUNDED,
        &Exact::zero(),
    )
}

/// The upper left 3×3 of a matrix.
fn linear<T: Word>(matrix: &Matrix<T>) -> [[Exact; 3]; 3] {
    let m = exacts(matrix.entries());
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| m[4 * i + j].clone()))
}

/// Rows of length 1 at right angles, and a right-handed frame.
fn check_turn<T: Word>(rows: &[[Exact; 3]; 3], steps: i64) -> Result<(), TestCaseError> {
    let bound = units::<T>(ROTATION * steps);
    for i in 0..3 {
        for j in 0..3 {
            let off = (&dot(&rows[i], &rows[j]) - &Exact::new((i == j) as i64, 0)).abs();
            prop_assert!(off <= bound, "rows {} and {} are off by {}", i, j, off.to_f64());
        }
    }
    prop_assert!(dot(&cross(&rows[0], &rows[1]), &rows[2]) > Exact::new(1, -1));
    Ok(())
}

fn check_rotation<T: Word>(turns: u64, axis: [f64; 3]) -> Result<(), TestCaseError> {
    let angle = Angle::from_turns(turns);
    let axis = block::<T, 3>(axis);
    let matrix = Matrix::rotation::<SineTable>(angle, axis).unwrap();
    let rows = linear(&matrix);
    check_turn::<T>(&rows, 1)?;
    // The axis stays, the trace is 1 + 2·cos, and what is not symmetric is the axis times 2·sin.
    let (x, bound) = (exacts(axis), units::<T>(ROTATION));
    for i in 0..3 {
        prop_assert!((&dot(&rows[i], &x) - &x[i]).abs() <= &bound * &largest(&x));
    }
    let (sin, cos) = SineTable::sin_cos::<T>(angle);
    let trace = &(&rows[0][0] + &rows[1][1]) + &rows[2][2];
    let word = |m: T| Exact::new(m.to_i64(), 1 - T::BITS as i32);
    prop_assert!((&(&trace - &Exact::new(1, 0)) - &word(cos)).abs() <= bound);
    let unit = axis.unit().unwrap().map(|m| Exact::new(m.to_i64(), -(T::BITS as i32)));
    for (k, (i, j)) in [(2, 1), (0, 2), (1, 0)].into_iter().enumerate() {
        prop_assert!((&(&rows[i][j] - &rows[j][i]) - &(&unit[k] * &word(sin))).abs() <= bound);
    }
    Ok(())
}

/// Eye, centre and up far from parallel; all entries of the turn to `ROTATION` units, and the eye goes to the origin.
fn check_look_at<T: Word>(eye: [f64; 3], to: [f64; 3], up: [f64; 3]) -> Result<(), TestCaseError> {
    let center = [0, 1, 2].map(|i| eye[i] + to[i]);
    let (eye, center, up) = (block::<T, 3>(eye), block::<T, 3>(center), block::<T, 3>(up));
    let matrix = Matrix::look_at(eye, center, up).unwrap();
    let mut directions = Directions::identity();
    directions.look_at(eye, center, up).unwrap();
    let rows = [0, 1, 2].map(|j| {
        let axis = [0, 1, 2].map(|k| (k == j) as i32);
        exacts(directions.turn(Block::from_integers(axis)))
    });
    // `turn` gives columns: transposed, they are the rows.
    let rows = [0, 1, 2].map(|i| [0, 1, 2].map(|j| rows[j][i].clone()));
    check_turn::<T>(&rows, 1)?;
    let seen = |p: Block<T, 3>| {
        let [x, y, z] = p.split();
        floats(matrix.transform(Block::gather([x, y, z, Scaled::from_integer(1)])))
    };
    let (distance, size) = (
        to.iter().map(|v| v * v).sum::<f64>().sqrt(),
        2f64.powi(5 - T::BITS.min(48) as i32) * 40.0,
    );
    let near = |found: [f64; 4], x: f64, y: f64, z: f64| {
        [found[0] - x, found[1] - y, found[2] - z]
            .iter()
            .all(|d| d.abs() <= size)
    };
    prop_assert!(
        near(seen(eye), 0.0, 0.0, 0.0) && near(seen(center), 0.0, 0.0, -distance),
        "{:?} {:?}",
        seen(eye),
        seen(center)
    );
    // Up is upwards: in the plane of y and z, y > 0.
    let up = directions.turn(up);
    let [x, y, _] = floats(up);
    prop_assert!(x.abs() <= size * 3.0 && y > 0.0);
    Ok(())
}

/// Every entry is a quotient n/d: entry·d = n within units of the entry and of the largest.
fn check_entries<T: Word>(
    matrix: Matrix<T>,
    wanted: [(usize, Exact, Exact); 6],
    one: (usize, i64),
) -> Result<(), TestCaseError> {
    let entries = exacts(matrix.entries());
    let top = &units::<T>(PROJECTION) * &largest(&entries);
    for (i, entry) in entries.iter().enumerate() {
        let (n, d) = match wanted.iter().find(|(at, ..)| *at == i) {
            Some((_, n, d)) => (n.clone(), d.clone()),
            None => (Exact::new(if i == one.0 { one.1 } else { 0 }, 0), Exact::new(1, 0)),
        };
        let off = (&(entry * &d) - &n).abs();
        prop_assert!(off <= &top * &d.clone().abs(), "entry {}: {}", i, entry.to_f64());
    }
    Ok(())
}

fn check_projections<T: Word>(sides: [Number; 6]) -> Result<(), TestCaseError> {
    let sides = sides.map(word::<T>);
    let [l, r, b, t, n, f] = sides.map(Exact::of);
    let flat = l == r || b == t || n == f;
    prop_assert_eq!(Matrix::frustum(sides).err(), flat.then_some(Error::FlatView));
    prop_assert_eq!(Matrix::ortho(sides).err(), flat.then_some(Error::FlatView));
    if flat {
        return Ok(());
    }
    let (width, height, depth) = (&r - &l, &t - &b, &f - &n);
    let (twice, two) = (&n + &n, Exact::new(2, 0));
    let frustum = [
        (0, twice.clone(), width.clone()),
        (2, &r + &l, width.clone()),
        (5, twice.clone(), height.clone()),
        (6, &t + &b, height.clone()),
        (10, -&(&f + &n), depth.clone()),
        (11, -&(&f * &twice), depth.clone()),
    ];
    check_entries(Matrix::frustum(sides).unwrap(), frustum, (14, -1))?;
    let ortho = [
        (0, two.clone(), width.clone()),
        (3, -&(&r + &l), width),
        (5, two.clone(), height.clone()),
        (7, -&(&t + &b), height),
        (10, -&two, depth.clone()),
        (11, -&(&f + &n), depth),
    ];
    check_entries(Matrix::ortho(sides).unwrap(), ortho, (15, 1))
}

/// D·Mᵀ = 1 for the directions of a matrix.
fn check_inverse<T: Word>(entries: [f64; 9]) -> Result<(), TestCaseError> {
    let [a, b, c, d, e, f, g, h, i] = entries.map(scaled::<T>);
    let o = Scaled::ZERO;
    let matrix = Matrix::from_scaled([a, b, c, o, d, e, f, o, g, h, i, o, o, o, o, Scaled::from_integer(1)]);
    let mut directions = Directions::identity();
    directions.load(&matrix);
    let m = linear(&matrix);
    // D's columns, one axis at a time.
    let d = [0, 1, 2].map(|k| exacts(directions.turn(Block::from_integers([0, 1, 2].map(|j| (j == k) as i32)))));
    let bound = &(&units::<T>(INVERSE) * &largest(d.iter().flatten())) * &largest(m.iter().flatten());
    // The determinant's relative error is as many units as its terms are larger than it: bounded by the same product.
    let bound = &bound * &(&largest(d.iter().flatten()) * &largest(m.iter().flatten())).max(Exact::new(1, 0));
    let rows = [0, 1, 2].map(|i| [0, 1, 2].map(|k| d[k][i].clone()));
    for (i, row) in rows.iter().enumerate() {
        for (j, other) in m.iter().enumerate() {
            let off = (&dot(row, other) - &Exact::new((i == j) as i64, 0)).abs();
            prop_assert!(
                off <= bound,
                "({}, {}) is off by {}, not {}",
                i,
                j,
                off.to_f64(),
                bound.to_f64()
            );
        }
    }
    Ok(())
}

fn vector() -> impl Strategy<Value = [f64; 3]> {
    prop::array::uniform3(-10.0..10.0f64).prop_filter("a direction", |v| v.iter().map(|x| x * x).sum::<f64>() > 1e-3)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn products(a in prop::array::uniform16(number()), b in prop::array::uniform16(number()), v in prop::array::uniform4(number())) {
        check_product::<i32>(a, b, v)?;
        check_product::<i64>(a, b, v)?;
    }

    #[test]
    fn rotations(turns in any::<u64>(), axis in vector(), scale in -300..300i32) {
        // Only the axis' direction counts, at any scale.
        check_rotation::<i32>(turns, axis.map(|v| v * 10f64.powi(scale)))?;
        check_rotation::<i64>(turns, axis.map(|v| v * 10f64.powi(scale)))?;
    }

    #[test]
    fn views(eye in vector(), to in vector(), up in vector()) {
        let [a, b] = [to, up].map(|v| v.map(|x| x / v.iter().map(|x| x * x).sum::<f64>().sqrt()));
        let cos: f64 = (0..3).map(|i| a[i] * b[i]).sum();
        prop_assume!(cos.abs() < 0.9);
        check_look_at::<i32>(eye, to, up)?;
        check_look_at::<i64>(eye, to, up)?;
    }

    #[test]
    fn projections(sides in prop::array::uniform6(number())) {
        check_projections::<i32>(sides)?;
        check_projections::<i64>(sides)?;
    }

    #[test]
    fn inverses(entries in prop::collection::vec(-4.0..4.0f64, 9)) {
        check_inverse::<i32>(entries.clone().try_into().unwrap())?;
        check_inverse::<i64>(entries.try_into().unwrap())?;
    }

    #[test]
    fn translations_and_scalings_are_exact(v in prop::array::uniform3(-9999..9999i32), p in prop::array::uniform3(-9999..9999i32)) {
        let point = Block::<i32, 4>::from_integers([p[0], p[1], p[2], 1]);
        let moved = Matrix::translation(Block::from_integers(v)).transform(point);
        prop_assert_eq!(moved, Block::from_integers([p[0] + v[0], p[1] + v[1], p[2] + v[2], 1]));
        let grown = Matrix::scaling(Block::from_integers(v)).transform(point);
        prop_assert_eq!(grown, Block::from_integers([p[0] * v[0], p[1] * v[1], p[2] * v[2], 1]));
    }

    /// A thousand turns, one upon the other, drift by a thousand times one turn's error at most, and so do directions.
    #[test]
    fn a_thousand_rotations(turns in any::<u64>(), axes in prop::collection::vec(vector(), 5)) {
        fn check<T: Word>(turns: u64, axes: &[[f64; 3]]) -> Result<(), TestCaseError> {
            let (mut matrix, mut directions) = (Matrix::identity(), Directions::identity());
            for i in 0..1000usize {
                let (angle, axis) = (Angle::from_turns(turns.wrapping_mul(i as u64 + 1)), block(axes[i % axes.len()]));
                matrix = matrix.product(&Matrix::<T>::rotation::<SineTable>(angle, axis).unwrap());
                directions.rotate::<SineTable>(angle, axis).unwrap();
            }
            check_turn::<T>(&linear(&matrix), 1000)?;
            let columns = [0, 1, 2].map(|k| exacts(directions.turn(Block::from_integers([0, 1, 2].map(|j| (j == k) as i32)))));
            check_turn::<T>(&columns, 1000)
        }
        check::<i32>(turns, &axes)?;
        check::<i64>(turns, &axes)?;
    }
}

#[test]
fn what_has_no_direction_is_an_error() {
    let (zero, x, far) = (
        Block::<i32, 3>::ZERO,
        Block::from_integers([5, 0, 0]),
        Block::from_integers([7, 0, 0]),
    );
    let error = Some(Error::ZeroVector);
    assert_eq!(Matrix::rotation::<SineTable>(Angle::from_degrees(7), zero).err(), error);
    assert_eq!(Matrix::look_at(x, x, Block::from_integers([0, 1, 0])).err(), error);
    assert_eq!(Matrix::look_at(x, far, x).err(), error);
    assert_eq!(Matrix::look_at(x, far, zero).err(), error);
    let mut directions = Directions::identity();
    assert_eq!(directions.rotate::<SineTable>(Angle::default(), zero).err(), error);
    assert_eq!(directions.look_at(x, x, far).err(), error);
    assert_eq!(directions, Directions::identity());
}

/// A singular matrix has no inverse: the directions are the identity, or stay as they are.
#[test]
fn singular_matrices() {
    let rows = [3, -5, 7, 0, 2, 4, 6, 0, 5, -1, 13, 0, 0, 0, 0, 1];
    for scale in [0, 900, -900] {
        let flat = Matrix::<i32>::from_rows(Block::from_integers(rows).scaled(scale));
        let mut directions = Directions::identity();
        directions
            .rotate::<SineTable>(Angle::from_degrees(30), Block::from_integers([1, 2, 3]))
            .unwrap();
        let before = directions;
        directions.load_product(&flat);
        assert_eq!(directions, before);
        directions.scale(Block::from_integers([1, 0, 1]));
        assert_eq!(directions, before);
        directions.load(&flat);
        assert_eq!(directions, Directions::identity());
    }
}
