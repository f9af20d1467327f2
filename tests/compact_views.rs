//! By less code, what a view leaves of triangles: the same pixels, and values within their bounds, whatever cuts them.

use std::marker::PhantomData;

use fixel::clip::{Behind, DepthRange, Planes};
use fixel::depth::NoDepth;
use fixel::draw;
use fixel::fragment::{Compact, Fragment, Gouraud565};
use fixel::matrix::Matrix;
use fixel::num::{Block, Scaled, Word};
use fixel::screen::Shape;
use fixel::span::Corners;
use fixel::target::Buffer;
use fixel::varying::{Color565, Linear, Linear32, Perspective, Varying};
use fixel::view::{Carried, Cull, Vertex, View};
use fixel::viewport::Viewport;
use proptest::prelude::*;

const WIDTH: u16 = 48;
const HEIGHT: u16 = 32;

/// A view, and a triangle before it, behind it or through it.
#[derive(Debug, Clone)]
struct Scene {
    points: [[i32; 4]; 3],
    planes: Vec<[i32; 4]>,
    depth_range: DepthRange,
    behind: Behind,
    cull: Cull,
    is_frustum: bool,
}

fn scene() -> impl Strategy<Value = Scene> {
    let near = (-20..=20i32, -20..=20i32, -80..=10i32).prop_map(|(x, y, z)| [x, y, z, 1]);
    let far = (-4000..=4000i32, -4000..=4000i32, -9000..=9000i32).prop_map(|(x, y, z)| [x, y, z, 1]);
    let projective = (-20..=20i32, -20..=20i32, -40..=10i32, -3..=9i32).prop_map(<[i32; 4]>::from);
    let point = prop_oneof![4 => near, 1 => far, 1 => projective];
    let plane = (-4..=4i32, -4..=4i32, -2..=2i32, 0..=40i32).prop_map(<[i32; 4]>::from);
    let ranges = prop::sample::select(&[DepthRange::ZeroToOne, DepthRange::MinusOneToOne, DepthRange::Unlimited][..]);
    let behind = prop::sample::select(&[Behind::Cut, Behind::Cut, Behind::Divide][..]);
    let cull = prop::sample::select(&[Cull::Nothing, Cull::Clockwise, Cull::CounterClockwise][..]);
    let planes = prop_oneof![2 => Just(Vec::new()), 1 => prop::collection::vec(plane, 1..=2)];
    (
        prop::array::uniform3(point),
        planes,
        ranges,
        behind,
        cull,
        any::<bool>(),
    )
        .prop_map(|(points, planes, depth_range, behind, cull, is_frustum)| Scene {
            points,
            planes,
            depth_range,
            behind,
            cull,
            is_frustum,
        })
}

impl Scene {
    fn view<T: Word, W: Word, const N: usize>(&self) -> View<T, W, N> {
        let mut planes = Planes::default();
        for plane in self.planes.iter().take(N) {
            planes.push(Block::from_integers(*plane)).unwrap();
        }
        let frustum = Matrix::frustum([-1, 1, -1, 1, 1, 64].map(Scaled::from_integer));
        let ortho = Matrix::ortho([-20, 20, -20, 20, 1, 64].map(Scaled::from_integer));
        View {
            projection: if self.is_frustum { frustum } else { ortho }.unwrap(),
            planes,
            viewport: Viewport::new(0, 0, WIDTH, HEIGHT).unwrap().y_up(),
            depth_range: self.depth_range,
            behind: self.behind,
            cull: self.cull,
        }
    }

    fn draw<T: Word, W: Word, F, P: Copy, const N: usize>(
        &self,
        carried: [<F::Varying as Carried>::Vertex; 3],
        fragment: &F,
        nothing: P,
    ) -> Vec<P>
    where
        F: Fragment<Varying: Carried, Pixel = P>,
    {
        let mut pixels = vec![nothing; usize::from(WIDTH) * usize::from(HEIGHT)];
        let vertices = [0, 1, 2].map(|i| Vertex {
            position: Block::from_integers(self.points[i]),
            carried: carried[i],
        });
        let mut target = Buffer::new(&mut pixels, WIDTH, HEIGHT).unwrap();
        draw::primitive(&self.view::<T, W, N>(), &mut target, &mut NoDepth, &vertices, fragment);
        pixels
    }

    /// As [`draw`](Self::draw), of vertices that are projected first.
    fn draw_indexed<F, P: Copy>(
        &self,
        carried: [<F::Varying as Carried>::Vertex; 3],
        fragment: &F,
        nothing: P,
    ) -> Vec<P>
    where
        F: Fragment<Varying: Carried, Pixel = P>,
    {
        let view = self.view::<i32, i32, 0>();
        let mut pixels = vec![nothing; usize::from(WIDTH) * usize::from(HEIGHT)];
        let vertices = [0, 1, 2].map(|i| view.vertex(Block::from_integers(self.points[i]), carried[i]));
        let mut target = Buffer::new(&mut pixels, WIDTH, HEIGHT).unwrap();
        draw::indexed(&view, &mut target, &mut NoDepth, &vertices, [[0u16, 1, 2]], fragment);
        pixels
    }

    /// How many times the largest 1/w of the polygon's corners its unit is, with all code: up to four.
    fn scale(&self) -> f64 {
        let vertices = self.points.map(|point| Vertex {
            position: Block::from_integers(point),
            carried: [0],
        });
        let mut largest = 1 << 30;
        self.view::<i32, i32, 2>()
            .project::<Perspective<1>>(&vertices, |polygon| {
                let inverses = (0..polygon.count()).map(|i| polygon.varying(i).inverse);
                largest = inverses.max().unwrap_or(largest);
            });
        f64::from(1 << 30) / f64::from(largest)
    }

    /// Whether the polygon on the screen has a corner around which all triangles run one way. Rounding takes that from one whose
    /// edges come within a subpixel of each other, as those of a triangle seen edge-on do: they cross, and no triangles tile it.
    fn has_fan<T: Word, W: Word>(&self) -> bool {
        let vertices = self.points.map(|point| Vertex {
            position: Block::from_integers(point),
            carried: (),
        });
        let mut has_fan = true;
        self.view::<T, W, 2>().project::<()>(&vertices, |polygon| {
            let count = polygon.count();
            let runs = |i: usize, j: usize, k: usize| {
                let [a, b, c] = [i, j, k].map(|i| polygon.position(i % count));
                let [(x, y), (p, q)] = [(b.0 - a.0, b.1 - a.1), (c.0 - a.0, c.1 - a.1)];
                (i64::from(x) * i64::from(q) - i64::from(y) * i64::from(p)).signum()
            };
            let is_fan = |apex: usize| {
                let ways = (2..count).map(|i| runs(apex, apex + i - 1, apex + i));
                let (least, most) = (ways.clone().min(), ways.max());
                least >= Some(0) || most <= Some(0)
            };
            has_fan &= (0..count).any(is_fan);
        });
        has_fan
    }

    /// The part of what user planes leave that is before the camera is all that is drawn of it.
    fn is_cut_through_infinity(&self) -> bool {
        self.behind == Behind::Divide && !self.planes.is_empty() && !self.is_on_one_side()
    }

    /// Whether all of it is before the camera, so that what is linear over the screen is so everywhere.
    fn is_before_camera(&self) -> bool {
        self.w().iter().all(|&w| w > 0)
    }

    fn is_on_one_side(&self) -> bool {
        self.is_before_camera() || self.w().iter().all(|&w| w < 0)
    }

    /// In clip space.
    fn w(&self) -> [i32; 3] {
        self.points.map(|[_, _, z, w]| if self.is_frustum { -z } else { w })
    }
}

/// Counts how often a pixel is drawn.
struct Count<V>(PhantomData<V>);

impl<V: Varying> Fragment for Count<V> {
    type Varying = V;
    type Pixel = u8;
    fn shade(&self, _: V::Values, below: u8) -> Option<u8> {
        Some(below + 1)
    }
}

/// How often a compact program draws each pixel.
fn hits<T: Word, W: Word, V: Carried, const N: usize>(scene: &Scene, carried: [V::Vertex; 3]) -> Vec<u8> {
    scene.draw::<T, W, _, _, N>(carried, &Compact(Count::<V>(PhantomData)), 0)
}

/// Keeps two values.
struct Values<V>(PhantomData<V>);

impl<V: Varying<Values = [i32; 2]>> Fragment for Values<V> {
    type Varying = V;
    type Pixel = Option<[i32; 2]>;
    fn shade(&self, values: [i32; 2], _: Option<[i32; 2]>) -> Option<Option<[i32; 2]>> {
        Some(Some(values))
    }
}

/// A corner in clip space and its values; an oracle in float64 of what is drawn by less code.
#[derive(Debug, Clone, Copy)]
struct Corner {
    clip: [f64; 4],
    values: [f64; 2],
}

/// Where the plane is crossed: values run linearly in clip space, or over the screen where both ends are before the camera.
fn cut(a: Corner, b: Corner, distances: [f64; 2], on_screen: bool) -> Corner {
    let t = distances[0] / (distances[0] - distances[1]);
    let clip = [0, 1, 2, 3].map(|i| a.clip[i] + t * (b.clip[i] - a.clip[i]));
    let s = if on_screen && a.clip[3] > 0.0 && b.clip[3] > 0.0 {
        t * b.clip[3] / clip[3]
    } else {
        t
    };
    Corner {
        clip,
        values: [0, 1].map(|i| a.values[i] + s * (b.values[i] - a.values[i])),
    }
}

/// Sutherland-Hodgman.
fn clipped(polygon: &[Corner], distance: impl Fn(&Corner) -> f64, on_screen: bool) -> Vec<Corner> {
    let mut kept = Vec::new();
    for (i, &corner) in polygon.iter().enumerate() {
        let next = polygon[(i + 1) % polygon.len()];
        let distances = [distance(&corner), distance(&next)];
        if distances[0] >= 0.0 {
            kept.push(corner);
        }
        if (distances[0] >= 0.0) != (distances[1] >= 0.0) {
            kept.push(cut(corner, next, distances, on_screen));
        }
    }
    kept
}

impl Scene {
    /// The triangles that are drawn, by a frustum of 1…64 with a near and a far plane and no user planes. None where the guard
    /// band cuts them, and where one is so thin that snapping may turn it, which another fan has to be drawn for.
    fn parts(&self, values: [[i32; 2]; 3], on_screen: bool) -> Vec<[Corner; 3]> {
        let polygon = [0, 1, 2].map(|i| {
            let [x, y, z, w] = self.points[i].map(f64::from);
            Corner {
                clip: [x, y, -65.0 / 63.0 * z - 128.0 / 63.0 * w, -z],
                values: values[i].map(f64::from),
            }
        });
        let polygon = clipped(&polygon, |c| c.clip[2] + c.clip[3], on_screen);
        let polygon = clipped(&polygon, |c| c.clip[3] - c.clip[2], on_screen);
        let parts: Vec<_> = (2..polygon.len())
            .map(|i| [polygon[0], polygon[i - 1], polygon[i]])
            .collect();
        let is_far = polygon.iter().flat_map(place).any(|v| v.abs() > 4000.0);
        if is_far || parts.iter().any(|part| height(part) < 0.02) {
            return Vec::new();
        }
        parts
    }
}

/// On the screen.
fn place(corner: &Corner) -> [f64; 2] {
    let [x, y, _, w] = corner.clip;
    [
        (x / w + 1.0) * f64::from(WIDTH) / 2.0,
        (1.0 - y / w) * f64::from(HEIGHT) / 2.0,
    ]
}

fn side(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
}

/// The least, in pixels.
fn height(part: &[Corner; 3]) -> f64 {
    let [a, b, c] = part.each_ref().map(place);
    let longest = [(a, b), (b, c), (c, a)].map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]));
    side(a, b, c).abs() / longest.into_iter().fold(1e-9, f64::max)
}

/// The first value of a part at a place, where that lies in it and it is thicker than 2 px; and by how much it changes within
/// 1/100 px.
fn value_at(part: &[Corner; 3], p: [f64; 2], on_screen: bool) -> Option<(f64, f64)> {
    if height(part) < 2.0 {
        return None;
    }
    let [a, b, c] = part.each_ref().map(place);
    let area = side(a, b, c);
    let at = |p| {
        let weights = [side(b, c, p), side(c, a, p), side(a, b, p)].map(|side| side / area);
        let w = part.map(|corner| if on_screen { 1.0 } else { corner.clip[3] });
        let sum = |value: [f64; 3]| (0..3).map(|i| weights[i] * value[i] / w[i]).sum::<f64>();
        let is_inside = weights.iter().all(|&weight| weight >= 0.0);
        is_inside.then(|| sum(part.map(|corner| corner.values[0])) / sum([1.0; 3]))
    };
    let here = at(p)?;
    let near = [[0.01, 0.0], [0.0, 0.01], [-0.01, 0.0], [0.0, -0.01]].map(|[dx, dy]| at([p[0] + dx, p[1] + dy]));
    let most = near.into_iter().map(|value| Some((value? - here).abs()));
    Some((here, most.collect::<Option<Vec<_>>>()?.into_iter().fold(0.0, f64::max)))
}

/// Of all pixels inside of thick parts, how far the value is beyond what moving by 1/100 px changes, at most.
fn beyond<V>(scene: &Scene, carried: [[i32; 2]; 3], on_screen: bool) -> f64
where
    V: Carried<Vertex = [i32; 2]> + Varying<Values = [i32; 2]>,
{
    let drawn = scene.draw::<i32, i32, _, _, 0>(carried, &Compact(Values::<V>(PhantomData)), None);
    let parts = scene.parts(carried, on_screen);
    let mut most = 0f64;
    for (i, pixel) in drawn.into_iter().enumerate() {
        let (x, y) = (i % usize::from(WIDTH), i / usize::from(WIDTH));
        let expected = parts
            .iter()
            .filter_map(|part| value_at(part, [x as f64, y as f64], on_screen));
        for (value, change) in expected {
            let [found, _] = pixel.unwrap_or_else(|| panic!("({x}, {y}) is not drawn"));
            most = most.max((f64::from(found) - value).abs() - change);
        }
    }
    most
}

/// The plane of the triangle passes through the camera, and the triangle behind it: nothing is left that has a place.
#[test]
fn edge_on_through_the_camera_nothing_is_drawn() {
    let scene = Scene {
        points: [[-5, -11, 0, 1], [-3, 4, 0, -2], [8, 7, -1, 1]],
        planes: Vec::new(),
        depth_range: DepthRange::Unlimited,
        behind: Behind::Cut,
        cull: Cull::Nothing,
        is_frustum: false,
    };
    assert!(hits::<i32, i32, (), 2>(&scene, [(); 3]).iter().all(|&hits| hits == 0));
    assert!(
        hits::<i64, i64, Color565, 2>(&scene, [[0x8000; 3]; 3])
            .iter()
            .all(|&hits| hits == 0)
    );
}

/// Its polygon is two triangles that meet where two of its edges cross: drawn are samples of its line, each once.
#[test]
fn edge_on_no_more_is_drawn_than_the_line() {
    let scene = Scene {
        points: [[-8, -17, -9, 1], [-13, 13, -8, 1], [-14, 19, -65, 1]],
        planes: Vec::new(),
        depth_range: DepthRange::MinusOneToOne,
        behind: Behind::Cut,
        cull: Cull::Nothing,
        is_frustum: false,
    };
    assert!(!scene.has_fan::<i32, i32>());
    let drawn = hits::<i32, i32, Color565, 2>(&scene, [[0x8000; 3]; 3]);
    for (i, &hits) in drawn.iter().enumerate().filter(|(_, hits)| **hits > 0) {
        assert_eq!(hits, 1);
        // In units of the scene, whose triangle lies where 6·x + y = −65.
        let (column, row) = (i % usize::from(WIDTH), i / usize::from(WIDTH));
        let x = column as f64 / f64::from(WIDTH) * 40.0 - 20.0;
        let y = 20.0 - row as f64 / f64::from(HEIGHT) * 40.0;
        assert!((6.0 * x + y + 65.0).abs() < 0.03, "({column}, {row})");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, max_global_rejects: 40_000, ..ProptestConfig::default() })]

    #[test]
    fn the_same_pixels_once(scene in scene()) {
        prop_assume!(!scene.is_cut_through_infinity());
        prop_assume!(scene.has_fan::<i32, i32>() && scene.has_fan::<i32, i64>() && scene.has_fan::<i64, i64>());
        let drawn = scene.draw::<i32, i32, _, _, 2>([(); 3], &Count::<()>(PhantomData), 0);
        prop_assert!(drawn.iter().all(|&hits| hits <= 1));
        prop_assert_eq!(&hits::<i32, i32, (), 2>(&scene, [(); 3]), &drawn);
        prop_assert_eq!(&hits::<i32, i32, (), 9>(&scene, [(); 3]), &drawn);
        prop_assert_eq!(&hits::<i32, i32, Color565, 2>(&scene, [[0x8000; 3]; 3]), &drawn);
        prop_assert_eq!(&hits::<i32, i32, Linear32<1>, 2>(&scene, [[5]; 3]), &drawn);
        prop_assert_eq!(&hits::<i32, i32, Linear<2>, 2>(&scene, [[5; 2]; 3]), &drawn);
        if scene.behind == Behind::Cut || scene.is_on_one_side() {
            prop_assert_eq!(&hits::<i32, i32, Perspective<1>, 2>(&scene, [[5]; 3]), &drawn);
        }
        let drawn = scene.draw::<i32, i64, _, _, 2>([(); 3], &Count::<()>(PhantomData), 0);
        prop_assert_eq!(&hits::<i32, i64, Linear32<1>, 2>(&scene, [[5]; 3]), &drawn);
        let drawn = scene.draw::<i64, i64, _, _, 2>([(); 3], &Count::<()>(PhantomData), 0);
        prop_assert_eq!(&hits::<i64, i64, Color565, 2>(&scene, [[0x8000; 3]; 3]), &drawn);
        prop_assert_eq!(&hits::<i64, i64, (), 2>(&scene, [(); 3]), &drawn);
    }

    /// Of values up to 2^20, within 1/256 of that.
    #[test]
    fn values_are_those_of_float64(
        scene in scene(),
        carried in prop::array::uniform3(prop::array::uniform2(0..=1 << 20i32)),
    ) {
        let scene = Scene {
            planes: Vec::new(),
            depth_range: DepthRange::MinusOneToOne,
            behind: Behind::Cut,
            cull: Cull::Nothing,
            is_frustum: true,
            ..scene
        };
        // Farther off a cut is not within 1/100 px.
        prop_assume!(scene.points.iter().flatten().all(|v| v.abs() <= 100));
        for beyond in [beyond::<Linear<2>>(&scene, carried, true), beyond::<Perspective<2>>(&scene, carried, false)] {
            prop_assert!(beyond <= 4096.0, "{} beyond", beyond);
        }
    }

    /// Before the camera, where what is linear over the screen is one plane: as with all of the code.
    #[test]
    fn values_in_space_are_those_of_all_code(
        scene in scene(),
        carried in prop::array::uniform3(prop::array::uniform2(0..=1 << 20i32)),
    ) {
        prop_assume!(scene.is_before_camera() && scene.depth_range != DepthRange::Unlimited);
        let full = scene.draw::<i32, i32, _, _, 2>(carried, &Values::<Perspective<2>>(PhantomData), None);
        let compact = Compact(Values::<Perspective<2>>(PhantomData));
        let compact = scene.draw::<i32, i32, _, _, 2>(carried, &compact, None);
        let scale = scene.scale();
        for (full, compact) in full.into_iter().zip(compact) {
            prop_assert_eq!(full.is_some(), compact.is_some());
            let (Some([a, b]), Some([c, d])) = (full, compact) else {
                continue;
            };
            // Either is within ρ·(2^-26·2^20 + 1) + 3 of the plane through corners that are rounded by a unit. 1/w is
            // between 1/64 and 1, in units that are `scale` times the largest with all code, and up to twice that here.
            let most = a.abs_diff(c).max(b.abs_diff(d));
            prop_assert!(f64::from(most) <= 64.0 * (scale + 2.0) + 10.0, "{:?} {:?}", full, compact);
        }
    }

    /// A vertex that was projected before is drawn with the bits of one that is projected for each triangle.
    #[test]
    fn projected_once_it_is_the_same(
        scene in scene(),
        carried in prop::array::uniform3(prop::array::uniform3(0x8000..=31 << 16i32)),
    ) {
        let scene = Scene { planes: Vec::new(), ..scene };
        let colors = Compact(Gouraud565);
        prop_assert_eq!(scene.draw::<i32, i32, _, _, 0>(carried, &colors, 0), scene.draw_indexed(carried, &colors, 0));
        // What is cut off all the same is not what is outside of the picture.
        if scene.behind == Behind::Divide && !scene.is_on_one_side() {
            return Ok(());
        }
        let carried = carried.map(|[a, b, _]| [a, b]);
        let values = Compact(Values::<Perspective<2>>(PhantomData));
        prop_assert_eq!(scene.draw::<i32, i32, _, _, 0>(carried, &values, None), scene.draw_indexed(carried, &values, None));
    }
}
