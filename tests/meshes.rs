//! Indexed meshes: what is drawn does not depend on the cache, closed surfaces cover every pixel once, and a mesh in a
//! sensible order is transformed about once.

mod exact;
mod strict;

use std::collections::BTreeMap;

use exact::{block, scaled};
use fixel::clip::{Behind, DepthRange, Planes};
use fixel::depth::{DepthBuffer, FAR, Less, NoDepth};
use fixel::draw;
use fixel::error::Error;
use fixel::fragment::Fragment;
use fixel::matrix::Matrix;
use fixel::mesh::{Cache, Mesh, Normalized};
use fixel::num::{Angle, Block, SineTable, Word};
use fixel::target::Buffer;
use fixel::varying::Linear;
use fixel::view::{Cull, Vertex, View};
use fixel::viewport::Viewport;
use fixel::window::Window;
use strict::{Mark, StrictTarget};

const SIZE: usize = 256;
const END: u16 = u16::MAX;

/// A grid that closes on itself: faces in stripes of `STRIPE` columns, vertices numbered in the order of their first use.
struct Model {
    positions: Vec<[i16; 3]>,
    indices: Vec<u16>,
    /// Triangles of all fans.
    triangles: usize,
}

const STRIPE: usize = 20;

impl Model {
    /// `place(column, row)` for rows 0…rows; columns and, where `ring`, rows close. What has the same place is one vertex.
    fn new(columns: usize, rows: usize, ring: bool, place: impl Fn(f64, f64) -> [f64; 3]) -> Self {
        let (mut positions, mut numbers) = (Vec::new(), BTreeMap::new());
        let (mut indices, mut triangles) = (Vec::new(), 0);
        let mut number = |column: usize, row: usize| {
            let row = if ring { row % rows } else { row };
            let at = place((column % columns) as f64 / columns as f64, row as f64 / rows as f64);
            let position = at.map(|c| (c * 32767.0).round() as i16);
            *numbers.entry(position).or_insert_with(|| {
                positions.push(position);
                positions.len() as u16 - 1
            })
        };
        for stripe in (0..columns).step_by(STRIPE) {
            for row in 0..rows {
                for column in stripe..(stripe + STRIPE).min(columns) {
                    let corners = [(0, 0), (0, 1), (1, 1), (1, 0)];
                    let mut face: Vec<u16> = corners.iter().map(|(i, j)| number(column + i, row + j)).collect();
                    face.dedup();
                    if face.first() == face.last() {
                        face.pop();
                    }
                    triangles += face.len() - 2;
                    indices.extend(face);
                    indices.push(END);
                }
            }
        }
        Model {
            positions,
            indices,
            triangles,
        }
    }

    /// Counter-clockwise from outside.
    fn sphere() -> Self {
        Self::new(160, 161, false, |u, v| {
            let ((sin, cos), (radius, z)) = (
                (u * std::f64::consts::TAU).sin_cos(),
                (v * std::f64::consts::PI).sin_cos(),
            );
            let radius = if v == 0.0 || v == 1.0 { 0.0 } else { radius };
            [radius * cos, radius * sin, z]
        })
    }

    fn torus() -> Self {
        Self::new(240, 120, true, |u, v| {
            let ((sin, cos), (height, out)) = (
                (u * std::f64::consts::TAU).sin_cos(),
                (-v * std::f64::consts::TAU).sin_cos(),
            );
            let radius = 0.7 + 0.3 * out;
            [radius * cos, radius * sin, 0.3 * height]
        })
    }

    fn mesh(&self) -> Mesh<'_, u16, 1> {
        Mesh::new([&self.indices], [self.positions.len()]).unwrap()
    }

    /// Model/view for a radius, turned, seen from 4 radii away.
    fn matrix<T: Word>(radius: f64, angle: i32) -> Matrix<T> {
        let (size, distance) = (block([radius; 3]), block([0.0, 0.0, 4.0 * radius]));
        let turn = Matrix::rotation::<SineTable>(Angle::from_degrees(angle), Block::from_integers([3, 1, 2])).unwrap();
        let camera = Matrix::camera::<SineTable>(distance, Block::ZERO, Angle::default()).unwrap();
        camera.product(&turn.product(&Matrix::scaling(size)))
    }
}

fn view<T: Word>(radius: f64, cull: Cull) -> View<T, i32, 0> {
    View {
        projection: Matrix::frustum([-1.0, 1.0, -1.0, 1.0, 3.0, 6.0].map(|v| scaled(v * radius))).unwrap(),
        planes: Planes::default(),
        viewport: Viewport::new(0, 0, SIZE as u16, SIZE as u16)
            .unwrap()
            .y_up()
            .samples_at_centers(),
        depth_range: DepthRange::MinusOneToOne,
        behind: Behind::Cut,
        cull,
    }
}

/// The colours and depths of a picture.
type Picture = (Vec<u32>, Vec<u16>);

/// Marks each pixel with what the corners carry, and counts how often it is written.
struct Carry;

impl Fragment for Carry {
    type Varying = Linear<1>;
    type Pixel = u32;
    fn shade(&self, [value]: [i32; 1], _: u32) -> Option<u32> {
        Some(value as u32)
    }
}

/// Draws what `triangles` hands out, with depth.
fn picture<T: Word>(radius: f64, triangles: impl FnOnce(&mut dyn FnMut([Vertex<T, [i32; 1]>; 3]))) -> Picture {
    let (mut colors, mut depths) = (vec![0; SIZE * SIZE], vec![FAR; SIZE * SIZE]);
    let mut target = Buffer::new(&mut colors, SIZE as u16, SIZE as u16).unwrap();
    let mut depth = DepthBuffer::<_, Less>::new(Buffer::new(&mut depths, SIZE as u16, SIZE as u16).unwrap());
    let view = view(radius, Cull::Clockwise);
    triangles(&mut |corners| draw::primitive(&view, &mut target, &mut depth, &corners, &Carry));
    (colors, depths)
}

/// What a vertex is made of, by its number.
fn vertex<T: Word>(model: &Model, matrix: &Matrix<T>, number: usize) -> Vertex<T, [i32; 1]> {
    let position = matrix.transform(model.positions[number].point());
    let carried = [1 + number as i32 * 7919 % 65521];
    Vertex { position, carried }
}

/// The picture by a cache of N, and how many vertices were transformed.
fn cached<T: Word, const N: usize>(model: &Model, radius: f64, angle: i32) -> (Picture, usize) {
    let matrix = Model::matrix::<T>(radius, angle);
    let mut cache = Cache::<_, 1, N>::default();
    let picture = picture(radius, |draw| {
        model
            .mesh()
            .triangles(&mut cache, |[number]| vertex(model, &matrix, number), draw);
    });
    (picture, cache.transforms())
}

/// The picture by single triangles, without any of `fixel::mesh`.
fn one_by_one<T: Word>(model: &Model, radius: f64, angle: i32) -> Picture {
    let matrix = Model::matrix::<T>(radius, angle);
    picture(radius, |draw| {
        for face in model.indices.split(|&i| i == END).filter(|face| !face.is_empty()) {
            for i in 2..face.len() {
                draw([face[0], face[i - 1], face[i]].map(|number| vertex(model, &matrix, number as usize)));
            }
        }
    })
}

fn check_caches<T: Word>(model: &Model, radius: f64, angle: i32) {
    let wanted = one_by_one::<T>(model, radius, angle);
    assert!(wanted.0.iter().filter(|&&c| c != 0).count() > SIZE * SIZE / 10);
    let corners = model.indices.iter().filter(|&&i| i != END).count();
    let runs = [
        cached::<T, 0>(model, radius, angle),
        cached::<T, 1>(model, radius, angle),
        cached::<T, 8>(model, radius, angle),
        cached::<T, 64>(model, radius, angle),
        cached::<T, 100>(model, radius, angle),
    ];
    let transforms = runs.each_ref().map(|(_, transforms)| *transforms);
    println!(
        "{} vertices, {} faces: {transforms:?} transforms",
        model.positions.len(),
        model.triangles
    );
    for (picture, _) in runs {
        assert!(picture == wanted, "the picture depends on the cache");
    }
    let [none, one, eight, many, odd] = transforms;
    assert!(none == corners && one <= none && eight < corners * 3 / 4);
    // The columns where stripes meet are made twice.
    let again = 1.15 * model.positions.len() as f64;
    assert!(many as f64 <= again && odd as f64 <= again);
}

#[test]
fn the_cache_does_not_change_a_bit() {
    for model in [Model::sphere(), Model::torus()] {
        assert!(model.triangles >= 50_000, "{}", model.triangles);
        check_caches::<i32>(&model, 1.0, 35);
        check_caches::<i64>(&model, 1.0, 35);
    }
}

/// Every pixel of the sphere's disc exactly once, at any scale; the strict target fails on the second time.
fn check_sphere<T: Word>(radius: f64, angle: i32) {
    let model = Model::sphere();
    for (cull, front) in [(Cull::Clockwise, true), (Cull::CounterClockwise, false)] {
        let (matrix, view) = (Model::matrix::<T>(radius, angle), view(radius, cull));
        let mut target = StrictTarget::new(Window::new(0, 0, SIZE as i32, SIZE as i32), false);
        let transform = |[number]: [usize; 1]| Vertex {
            position: vertex(&model, &matrix, number).position,
            carried: (),
        };
        model
            .mesh()
            .triangles(&mut Cache::<_, 1, 64>::default(), transform, |corners| {
                draw::primitive(&view, &mut target, &mut NoDepth, &corners, &Mark(b'#'));
            });
        // The disc's radius is tan(asin(1/4)) of the distance, seen at 3 near: 0.775 of half the picture. The facets lie
        // up to 1/5000 of the radius inside, and positions are snapped to 1/512 px.
        let outside = SIZE as f64 / 2.0 * 3.0 / 15f64.sqrt();
        for (y, row) in target.picture().iter().enumerate() {
            for (x, pixel) in row.bytes().enumerate() {
                let middle = |v: usize| v as f64 + 0.5 - SIZE as f64 / 2.0;
                let from_center = middle(x).hypot(middle(y));
                if (from_center - outside).abs() > 0.05 {
                    assert_eq!(pixel == b'#', from_center < outside, "({x}, {y}), {front}");
                }
            }
        }
    }
}

#[test]
fn a_sphere_covers_every_pixel_once() {
    for angle in [0, 35, 200] {
        for radius in [1.7e-3, 1.0, 2.3e6] {
            check_sphere::<i32>(radius, angle);
            check_sphere::<i64>(radius, angle);
        }
    }
}

/// A torus covers itself; with depth its picture is that of its nearest triangles, whatever the order of the faces.
#[test]
fn depth_settles_what_is_seen() {
    let model = Model::torus();
    let mut faces: Vec<&[u16]> = model.indices.split_inclusive(|&i| i == END).collect();
    faces.reverse();
    let turned = Model {
        positions: model.positions.clone(),
        indices: faces.concat(),
        triangles: model.triangles,
    };
    let (forward, _) = cached::<i32, 64>(&model, 1.0, 75);
    let (backward, _) = cached::<i32, 64>(&turned, 1.0, 75);
    assert!(forward.1 == backward.1, "the depths depend on the order");
}

/// Corners that name a position and a normal: a vertex for each pair, whatever other pairs share.
#[test]
fn attributes_with_indices_of_their_own() {
    let positions = [0, 1, 2, 3, END, 3, 2, 1, END, 0, 1, 2, 3, END];
    let normals = [0, 0, 1, 1, END, 1, 1, 0, END, 1, 1, 0, 0, END];
    let mesh = Mesh::new([&positions, &normals], [4, 2]).unwrap();
    fn drawn<const N: usize>(mesh: &Mesh<u16, 2>) -> (Vec<[[usize; 2]; 3]>, usize) {
        let (mut cache, mut triangles) = (Cache::<_, 2, N>::default(), Vec::new());
        mesh.triangles(&mut cache, |corner| corner, |corners| triangles.push(corners));
        (triangles, cache.transforms())
    }
    let wanted = [
        [[0, 0], [1, 0], [2, 1]],
        [[0, 0], [2, 1], [3, 1]],
        [[3, 1], [2, 1], [1, 0]],
        [[0, 1], [1, 1], [2, 0]],
        [[0, 1], [2, 0], [3, 0]],
    ];
    assert_eq!(drawn::<0>(&mesh), (wanted.to_vec(), 11));
    assert_eq!(drawn::<1>(&mesh).0, wanted);
    assert_eq!(drawn::<64>(&mesh), (wanted.to_vec(), 8));
    let counts: Vec<usize> = mesh.faces().map(|face| face.corners().count()).collect();
    assert_eq!(counts, [4, 3, 4]);
}

/// A cache is emptied before each drawing: it never shows a vertex of the last.
#[test]
fn a_cache_can_be_used_again() {
    let mesh = Mesh::new([&[0u32, 1, 2, u32::MAX]], [3]).unwrap();
    let mut cache = Cache::<usize, 1, 8>::default();
    for add in [0, 10, 20] {
        let mut drawn = Vec::new();
        mesh.triangles(&mut cache, |[i]| i + add, |corners| drawn.push(corners));
        assert_eq!(drawn, [[add, add + 1, add + 2]]);
    }
    assert_eq!(cache.transforms(), 9);
}

#[test]
fn incomplete_meshes_are_errors() {
    let check = |indices: &[u16], counts| Mesh::new([indices], [counts]).err();
    assert_eq!(check(&[], 0), None);
    assert_eq!(check(&[0, 1, 2, END], 3), None);
    assert_eq!(check(&[0, 1, 3, END], 3), Some(Error::MeshIndex));
    for indices in [
        &[0, 1, 2][..],
        &[0, 1, END],
        &[END],
        &[0, 1, 2, END, 0],
        &[0, 1, 2, END, END],
    ] {
        assert_eq!(check(indices, 3), Some(Error::MeshShape), "{indices:?}");
    }
    let check = |first: &[u16], second: &[u16]| Mesh::new([first, second], [4, 4]).err();
    assert_eq!(check(&[0, 1, 2, END], &[3, 3, 3, END]), None);
    assert_eq!(check(&[0, 1, 2, END], &[3, 3, 4, END]), Some(Error::MeshIndex));
    assert_eq!(check(&[0, 1, 2, END], &[3, 3, 3]), Some(Error::MeshShape));
    assert_eq!(check(&[0, 1, 2, END], &[3, 3, 3, 3, END]), Some(Error::MeshShape));
    assert_eq!(check(&[0, 1, 2, 3, END], &[3, 3, 3, END, 3]), Some(Error::MeshShape));
}

/// Fractions of the half-size, exactly, with w = 1.
#[test]
fn normalized_positions() {
    for v in [[0; 3], [1, -1, 12345], [i16::MAX, i16::MIN, -7]] {
        let [x, y, z] = v.map(i32::from);
        assert_eq!(v.point::<i32>(), Block::new([x, y, z, 1 << 15], -15));
        assert_eq!(v.point::<i64>(), Block::new([x, y, z, 1 << 15].map(i64::from), -15));
    }
    for v in [[0; 3], [1, -1, 1 << 30], [i32::MAX, i32::MIN, -7]] {
        let [x, y, z] = v.map(i64::from);
        assert_eq!(v.point::<i64>(), Block::new([x, y, z, 1 << 30], -30));
        assert_eq!(v.point::<i32>(), Block::from_wide([x, y, z, 1 << 30], -30));
    }
}
