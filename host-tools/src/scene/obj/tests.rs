use super::*;
use crate::scene::Place;
use crate::scene::iv::Corner;

const TRIANGLE: &str = "v 0 0 0\nv 2 0 0\nv 0 2 0\n";

fn size(text: &str) -> Size {
    text.parse().expect("a size")
}

fn model(text: impl AsRef<[u8]>) -> Model {
    parse(text, Size::DEFAULT).unwrap_or_else(|fault| panic!("{fault}"))
}

/// The corners of all faces, as points and as the normals themselves.
fn faces(text: &str) -> Vec<Vec<(usize, [f64; 3])>> {
    let object = model(text).objects.remove(0);
    let corner = |corner: &Corner| (corner.point, object.normals[corner.normal]);
    let faces = object
        .faces
        .iter()
        .map(|face| face.corners.iter().map(corner).collect());
    faces.collect()
}

/// The single face that a line makes of the triangle's points and two normals.
fn face(line: &str) -> Vec<(usize, [f64; 3])> {
    faces(&format!("{TRIANGLE}vn 1 0 0\nvn 0 1 0\n{line}\n")).remove(0)
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[test]
fn every_form_of_an_index() {
    let (a, b) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let own = vec![(0, a), (1, b), (2, a)];
    assert_eq!(face("f 1//1 2//2 3//1"), own);
    assert_eq!(face("f 1/7/1 2/8/2 3/9/1"), own);
    assert_eq!(face("f -3//-2 -2//-1 -1//-2"), own);
    let points = |line: &str| -> Vec<usize> { face(line).into_iter().map(|(point, _)| point).collect() };
    assert_eq!(points("f 1 2 3"), [0, 1, 2]);
    assert_eq!(points("f 3/4 2/5 1/6"), [2, 1, 0]);
    assert_eq!(points("f 1/ 2// -1"), [0, 1, 2]);
    assert_eq!(points("f 1 2 3 2 1"), [0, 1, 2, 1, 0]);
}

/// Its own, or its face's, and never that of a corner before it.
#[test]
fn every_corner_has_its_normal() {
    let own = [1.0, 0.0, 0.0];
    let found = face("f 1//1 2 3//1");
    assert_eq!((found[0].1, found[2].1), (own, own));
    let [x, y, z] = found[1].1;
    assert!(x == 0.0 && y == 0.0 && z > 0.0, "{found:?}");
    let both = faces(&format!("{TRIANGLE}vn 1 0 0\nf 1//1 2//1 3//1\nf 3 2 1\n"));
    assert!(both[0].iter().all(|&(_, normal)| normal == own));
    assert!(both[1].iter().all(|&(_, [x, y, z])| x == 0.0 && y == 0.0 && z < 0.0));
    // Folded onto itself, the two halves cancel, but for what float64 rounds of them.
    let folded = faces("v .1 .2 .3\nv 1.1 .3 .17\nv .3 1.3 .7\nf 1 2 3 2\n");
    assert!(folded[0].iter().all(|&(_, normal)| normal == [0.0; 3]), "{folded:?}");
    let none = faces("v 0 0 0\nv 1 1 1\nf 1 2 1\n");
    assert!(none[0].iter().all(|&(_, normal)| normal == [0.0; 3]));
}

#[test]
fn the_rest_is_passed_over() {
    let text = "\u{feff}# a # b\nmtllib ../../x.mtl\no é\ng\nvt 0 0\nvt a b\nv 0 0 0 1 # origin\r\nv\t2 0\\ \t\n 0 .5 .5 .5\n\n\
        v 0 \\ \r\n2 \\\r\n0\ns off\nusemtl m\nl 1 9\np 1\nf 1 2 3 # c:\\\nf 3 2 1\r";
    let found = faces(text);
    let points = |face: &Vec<(usize, [f64; 3])>| -> Vec<usize> { face.iter().map(|corner| corner.0).collect() };
    assert_eq!(found.iter().map(points).collect::<Vec<_>>(), [[0, 1, 2], [2, 1, 0]]);
    let latin = [b"o caf\xE9\n".as_slice(), text.as_bytes()].concat();
    assert_eq!(model(latin).objects[0].faces.len(), 2);
}

#[test]
fn faults_have_their_place() {
    for (text, line, column, message) in [
        ("v 1 2\n", 1, 1, "v takes 3 numbers, found 2"),
        ("\nvn", 2, 1, "vn takes 3 numbers, found 0"),
        ("v 1 x 3\n", 1, 5, "expected a number, found `x`"),
        ("v 1 2 nan\n", 1, 7, "expected a number, found `nan`"),
        ("v 1 2 1.#QNAN\n", 1, 7, "expected a number, found `1.#QNAN`"),
        ("vn 1 1e999 3\n", 1, 6, "too large a number, found `1e999`"),
        ("v 1 \\\n  2 y\n", 2, 5, "expected a number, found `y`"),
        ("v 0 0 0\nf 1 1\n", 2, 1, "a face needs 3 vertices or more, found 2"),
        ("v 0 0 0\nf 1 1 2\n", 2, 7, "no such vertex: 1 made so far, found `2`"),
        ("v 0 0 0\nf 1 1 -2\n", 2, 7, "no such vertex: 1 made so far, found `-2`"),
        (
            "v 0 0 0\nf 1 1 9223372036854775808\n",
            2,
            7,
            "no such vertex: 1 made so far, found `9223372036854775808`",
        ),
        (
            "v 0 0 0\nf 1 1 -99999999999999999999\n",
            2,
            7,
            "no such vertex: 1 made so far, found `-99999999999999999999`",
        ),
        ("v 0 0 0\nf 1 0 1\n", 2, 5, "indices start at 1 (or -1), found `0`"),
        (
            "v 0 0 0\nf 1//1 1 1\n",
            2,
            3,
            "no such normal: 0 made so far, found `1//1`",
        ),
        (
            "v 0 0 0\nf 1 1 /1\n",
            2,
            7,
            "expected a vertex as v, v/vt, v//vn or v/vt/vn, found `/1`",
        ),
        (
            "f 1/x 1 1",
            1,
            3,
            "expected a vertex as v, v/vt, v//vn or v/vt/vn, found `1/x`",
        ),
        (
            "f 1/1/1/1 1 1",
            1,
            3,
            "expected a vertex as v, v/vt, v//vn or v/vt/vn, found `1/1/1/1`",
        ),
        (
            "f 1.0 1 1",
            1,
            3,
            "expected a vertex as v, v/vt, v//vn or v/vt/vn, found `1.0`",
        ),
    ] {
        let expected = Fault::new(Place { line, column }, message);
        assert_eq!(parse(text, Size::DEFAULT), Err(expected), "{text}");
    }
}

#[test]
fn a_mesh_without_extent_is_a_fault() {
    for (text, message) in [
        ("", "no faces"),
        (TRIANGLE, "no faces"),
        ("v 1 2 3\nv 4 5 6\nf 1 1 1\n", "all faces are one point"),
        ("v 1 2 3\nv 1 2 3\nv 1 2 3\nf 1 2 3\n", "all faces are one point"),
    ] {
        assert_eq!(parse(text, Size::DEFAULT), Err(Fault::of_whole(message)), "{text}");
    }
}

/// Whatever its size and place, a mesh fits into the sphere of radius 1 and reaches it.
#[test]
fn a_mesh_is_framed() {
    for (scale, offset) in [
        (1.0, 0.0),
        (1e-3, 7.0),
        (1e6, 1e6),
        (1e300, 0.0),
        (1.79e308, 0.0),
        (1e-300, 0.0),
        (4e-320, 0.0),
    ] {
        let at = |x: f64, y: f64, z: f64| {
            let [x, y, z] = [x, y, z].map(|c| c * scale + offset);
            format!("v {x:e} {y:e} {z:e}\n")
        };
        let text = [at(-1.0, -1.0, 0.0), at(1.0, -1.0, 0.5), at(0.0, 1.0, 1.0)].concat();
        let object = model(format!("{text}v 1e308 1e308 -1e308\nf 1 2 3\n"))
            .objects
            .remove(0);
        let lengths = object.points[..3].iter().map(|&point| dot(point, point).sqrt());
        let largest = lengths.fold(0.0, f64::max);
        assert!((largest - 1.0).abs() < 1e-15, "{scale:e} {offset}: {largest}");
        assert!(object.points.as_flattened().iter().all(|x| x.abs() <= 1.0));
        let [x, y, z] = object.normals[0];
        assert!(
            x.is_finite() && y.is_finite() && z > 0.0,
            "{scale:e} {offset}: {:?}",
            object.normals
        );
    }
}

/// The sphere lies inside the window, whatever its shape, and between the planes; pixels are square.
#[test]
fn the_camera_sees_the_sphere() {
    for text in ["500x500", "640x480", "480x640", "16384x1", "1x16384"] {
        let size = size(text);
        let camera = camera(size);
        let distance = dot(camera.position, camera.position).sqrt();
        assert!((distance - DISTANCE).abs() < 1e-12);
        assert!(camera.near > 0.0 && camera.near < distance - 1.0 && camera.far > distance + 1.0);
        let cone = camera.near * (1.0 / distance).asin().tan();
        assert!(camera.right > cone && camera.top > cone && camera.right.min(camera.top) < 1.1 * cone);
        assert_eq!((camera.left, camera.bottom), (-camera.right, -camera.top));
        let pixel = [
            camera.right / f64::from(size.width()),
            camera.top / f64::from(size.height()),
        ];
        assert!((pixel[0] / pixel[1] - 1.0).abs() < 1e-12, "{text}: {pixel:?}");
    }
}

/// Turned by its orientation the camera looks at the origin and stands upright.
#[test]
fn the_orientation_is_the_turn() {
    let Rotation { axis, angle } = orientation();
    let length = dot(axis, axis).sqrt();
    let [x, y, z] = axis.map(|c| c / length);
    let about = |v: [f64; 3]| {
        let cross = [y * v[2] - z * v[1], z * v[0] - x * v[2], x * v[1] - y * v[0]];
        let along = dot([x, y, z], v) * (1.0 - angle.cos());
        [0, 1, 2].map(|i| v[i] * angle.cos() + cross[i] * angle.sin() + [x, y, z][i] * along)
    };
    for v in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] {
        let (a, b) = (about(v), turned(v));
        assert!(
            a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12),
            "{v:?}: {a:?}, {b:?}"
        );
    }
    assert!(turned([1.0, 0.0, 0.0])[1] == 0.0 && turned([0.0, 1.0, 0.0])[1] > 0.0);
    let position = turned([0.0, 0.0, 1.0]);
    assert!(
        position[0] < 0.0 && position[1] > 0.0 && position[2] > 0.5,
        "{position:?}"
    );
}
