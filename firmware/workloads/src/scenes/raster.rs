//! Through the raster door: corners that are on the screen already.

use core::hint::black_box;

use fixel::blend::{ONE, Rgba, over565};
use fixel::depth::{
    Always, Comparison, Equal, Greater, GreaterOrEqual, Keep, Less, LessOrEqual, LessOrFar, NoDepth, NotEqual,
};
use fixel::disc::Disc;
use fixel::draw;
use fixel::error::Error;
use fixel::fragment::{Antialiased, Compact, Flat, Fragment, Gouraud565};
use fixel::quality::Quality;
use fixel::screen::{Center, Corner, FineDepth, Position, SubPx};
use fixel::square::Square;
use fixel::texture::{Floor, Nearest, Rgb565, Texture};
use fixel::varying::Linear;

use super::part::Part;

/// Corners in units of 2^-8 px, and their depths in steps.
type Triangle = [(i32, i32, u32); 3];

/// On the picture, across its borders, crossing one another in depth, sharing an edge.
const TRIANGLES: [Triangle; 4] = [
    [(300, 200, 10_000), (23_000, 1_111, 60_000), (9_001, 15_777, 30_000)],
    [
        (-4_000, 9_000, 50_000),
        (15_000, -3_000, 20_000),
        (20_001, 20_003, 1_000),
    ],
    [(5_000, 2_000, 40_000), (17_000, 8_000, 40_000), (6_000, 14_000, 5_000)],
    [
        (17_000, 8_000, 40_000),
        (6_000, 14_000, 5_000),
        (24_000, 16_500, 65_535),
    ],
];

const COLORS: [u16; 4] = [0xf9a3, 0x2e8b, 0x8c7f, 0xffe0];

fn corner<V>((x, y, depth): (i32, i32, u32), varying: V) -> Corner<V> {
    Corner {
        position: Position::nearest(SubPx::from_bits(x), SubPx::from_bits(y)),
        depth: FineDepth::from_num(depth),
        varying,
    }
}

fn triangles() -> impl Iterator<Item = (Triangle, u16)> {
    black_box(TRIANGLES).into_iter().zip(COLORS)
}

pub fn flat(part: &mut Part<'_>) -> Result<(), Error> {
    let mut color = part.color()?;
    for (corners, pixel) in triangles() {
        draw::triangle(&mut color, &mut NoDepth, corners.map(|c| corner(c, ())), &Flat(pixel));
    }
    Ok(())
}

pub fn flat_depth(part: &mut Part<'_>) -> Result<(), Error> {
    compared::<LessOrEqual>(part, triangles())
}

fn compared<C: Comparison>(part: &mut Part<'_>, triangles: impl Iterator<Item = (Triangle, u16)>) -> Result<(), Error> {
    let (mut color, mut depth) = part.compared::<C>()?;
    for (corners, pixel) in triangles {
        draw::triangle(&mut color, &mut depth, corners.map(|c| corner(c, ())), &Flat(pixel));
    }
    Ok(())
}

fn shaded<Q: Quality>(corners: Triangle) -> [Corner<Q::Color>; 3] {
    let [a, b, c] = corners;
    [(a, [255, 20, 90]), (b, [0, 200, 255]), (c, [240, 255, 3])]
        .map(|(c, [red, green, blue])| corner(c, Gouraud565::corner(red, green, blue).into()))
}

pub fn gouraud<Q: Quality>(part: &mut Part<'_>) -> Result<(), Error> {
    let mut color = part.color()?;
    for (corners, _) in triangles() {
        draw::triangle(&mut color, &mut NoDepth, shaded::<Q>(corners), &Q::GOURAUD);
    }
    Ok(())
}

pub fn gouraud_depth<Q: Quality>(part: &mut Part<'_>) -> Result<(), Error> {
    let (mut color, mut depth) = part.compared::<Less>()?;
    for (corners, _) in triangles() {
        draw::triangle(&mut color, &mut depth, shaded::<Q>(corners), &Q::GOURAUD);
    }
    Ok(())
}

/// By less code, small triangles too: what has a way of its own otherwise.
pub fn gouraud_compact<Q: Quality>(part: &mut Part<'_>) -> Result<(), Error> {
    let (mut color, mut depth) = part.compared::<Less>()?;
    let an_eighth = |v: SubPx| SubPx::from_bits(v.to_bits() >> 3);
    for (corners, _) in triangles() {
        let corners = shaded::<Q>(corners);
        let small = corners.map(|corner| Corner {
            position: Position::nearest(an_eighth(corner.position.x()), an_eighth(corner.position.y())),
            depth: FineDepth::ZERO,
            ..corner
        });
        draw::triangle(&mut color, &mut depth, corners, &Compact(Q::GOURAUD));
        draw::triangle(&mut color, &mut depth, small, &Compact(Q::GOURAUD));
    }
    Ok(())
}

/// 4×4 texels, no two alike.
pub const TEXELS: [u16; 16] = [
    0xf800, 0x07e0, 0x001f, 0xffe0, 0x07ff, 0xf81f, 0xffff, 0x8410, 0x4208, 0xfc00, 0x83e0, 0x0410, 0x8010, 0xc618,
    0x39e7, 0xfbb7,
];

/// The texels in flash.
pub const TEXTURE: Result<Texture<'static, Rgb565>, Error> = Texture::new(Rgb565, &TEXELS, 4, 4);

struct Textured(Nearest<'static, Rgb565, Floor>);

impl Fragment for Textured {
    type Varying = Linear<2>;
    type Pixel = u16;
    fn shade(&self, st: [i32; 2], _below: u16) -> Option<u16> {
        Some(self.0.stored(st))
    }
}

pub fn texture_nearest(part: &mut Part<'_>) -> Result<(), Error> {
    let textured = Textured(Nearest::new(TEXTURE?, 16));
    let mut color = part.color()?;
    for (corners, _) in triangles() {
        let corners = corners.map(|c| corner(c, Linear([c.0 * 200 - 40_000, c.1 * 150 + c.0 * 20])));
        draw::triangle(&mut color, &mut NoDepth, corners, &textured);
    }
    Ok(())
}

/// From one end of the guard band to the other.
pub fn guard_band<Q: Quality>(part: &mut Part<'_>) -> Result<(), Error> {
    const FAR_OUT: i32 = 4096 << 8;
    const WIDE: [Triangle; 3] = [
        [
            (-FAR_OUT, -FAR_OUT, 0),
            (FAR_OUT, -FAR_OUT + 999, 65_535),
            (10_000, FAR_OUT, 30_000),
        ],
        [(-FAR_OUT, 3_000, 65_535), (FAR_OUT, 8_000, 0), (FAR_OUT, 8_300, 0)],
        [
            (9_000, -FAR_OUT, 20_000),
            (9_001, FAR_OUT, 20_000),
            (12_345, FAR_OUT, 20_000),
        ],
    ];
    let (mut color, mut depth) = part.compared::<LessOrFar>()?;
    for corners in black_box(WIDE) {
        draw::triangle(&mut color, &mut depth, shaded::<Q>(corners), &Q::GOURAUD);
    }
    Ok(())
}

/// A ground, and over it a triangle for each comparison, with depths on both sides of the ground's and on it.
pub fn depth_comparisons(part: &mut Part<'_>) -> Result<(), Error> {
    const GROUND: [Triangle; 2] = [
        [(0, 0, 20_000), (0, 16_384, 20_000), (24_576, 0, 20_000)],
        [(24_576, 0, 40_000), (0, 16_384, 40_000), (24_576, 16_384, 40_000)],
    ];
    compared::<Always>(part, black_box(GROUND).into_iter().zip(COLORS))?;
    // Bands of equal depth at 20000 and 40000, where the picture's halves meet.
    let over = |row: i32| {
        let (top, bottom) = (row << 11, (row + 1) << 11);
        let level = |depth| [(0, top, depth), (0, bottom, depth), (24_000, bottom, depth)];
        let slope = [(24_000, bottom, 45_000), (24_000, top, 45_000), (0, top, 10_000)];
        let color = COLORS[row as usize & 3] ^ 0x5a5a;
        [(level(20_000), color), (slope, !color)].into_iter()
    };
    compared::<Less>(part, over(0))?;
    compared::<LessOrEqual>(part, over(1))?;
    compared::<Greater>(part, over(2))?;
    compared::<GreaterOrEqual>(part, over(3))?;
    compared::<Equal>(part, over(4))?;
    compared::<NotEqual>(part, over(5))?;
    compared::<LessOrFar>(part, over(6))?;
    compared::<Keep<Less>>(part, over(7))
}

/// A colour with alpha over what is there, wholly or in part.
struct Glass(Rgba);

impl Fragment for Glass {
    type Varying = ();
    type Pixel = u16;
    fn shade(&self, (): (), below: u16) -> Option<u16> {
        Some(over565(self.0, below))
    }
}

impl Antialiased for Glass {
    fn shade_part(&self, (): (), part: i32, below: u16) -> Option<u16> {
        Some(over565(self.0.faded(part), below))
    }
}

const GLASS: [Glass; 3] = [
    Glass(Rgba {
        color: [ONE, ONE / 3, 0],
        alpha: ONE / 2,
    }),
    Glass(Rgba {
        color: [ONE / 9, ONE, ONE / 2],
        alpha: ONE / 3,
    }),
    Glass(Rgba {
        color: [ONE, ONE, ONE],
        alpha: ONE / 7 * 5,
    }),
];

pub fn over(part: &mut Part<'_>) -> Result<(), Error> {
    flat(part)?;
    let mut color = part.color()?;
    for ((corners, _), glass) in triangles().zip(&GLASS) {
        let [a, b, c] = corners.map(|(x, y, depth)| corner((24_000 - x, y + 1_000, depth), ()));
        draw::triangle(&mut color, &mut NoDepth, [a, b, c], glass);
    }
    Ok(())
}

/// Ends of lines in all directions, some of them off the picture.
fn star() -> impl Iterator<Item = [(i32, i32, u32); 2]> {
    const TIPS: [(i32, i32); 12] = [
        (24_000, 8_100),
        (23_000, 500),
        (18_000, -9_000),
        (12_001, 3),
        (6_000, 100),
        (1_000, 4_000),
        (-70_000, 8_000),
        (500, 12_000),
        (7_777, 16_000),
        (12_000, 40_000),
        (19_000, 15_900),
        (90_000, 11_000),
    ];
    let tips = black_box(TIPS).into_iter().zip(0..);
    tips.map(|((x, y), i)| {
        [
            (12_000 + 77 * i as i32, 8_000, 20_000 + 999 * i),
            (x, y, 60_000 - 4_000 * i),
        ]
    })
}

pub fn bresenham_lines(part: &mut Part<'_>) -> Result<(), Error> {
    let mut color = part.color()?;
    let pixel = |(x, y, _): (i32, i32, u32)| ((x >> 8) as i16, (y >> 8) as i16);
    for (i, [from, to]) in star().enumerate() {
        draw::line(&mut color, pixel(from), pixel(to), &Flat(COLORS[i & 3]));
    }
    Ok(())
}

pub fn subpixel_lines<Q: Quality>(part: &mut Part<'_>) -> Result<(), Error> {
    let (mut color, mut depth) = part.compared::<Less>()?;
    for ends in star() {
        let [from, to] = ends;
        let ends = [
            corner(from, Q::Color::from(Gouraud565::corner(255, 255, 255))),
            corner(to, Gouraud565::corner(255, 40, 0).into()),
        ];
        draw::segment(&mut color, &mut depth, ends, &Q::GOURAUD);
    }
    Ok(())
}

pub fn wu_lines(part: &mut Part<'_>) -> Result<(), Error> {
    flat(part)?;
    let (mut color, mut depth) = part.compared::<LessOrEqual>()?;
    for (ends, glass) in star().zip(GLASS.iter().cycle()) {
        draw::wu_line(&mut color, &mut depth, ends.map(|end| corner(end, ())), glass);
    }
    Ok(())
}

/// Places on the picture and beside it.
fn places() -> impl Iterator<Item = (Center, i32)> {
    (0..70).map(|i: i32| {
        let center = Center {
            x: SubPx::from_bits(black_box(i * 7_919 % 26_000 - 500)),
            y: SubPx::from_bits(i * 5_003 % 18_000 - 700),
            depth: FineDepth::from_num((i * 9_973 % 65_535) as u32),
        };
        (center, i)
    })
}

pub fn points(part: &mut Part<'_>) -> Result<(), Error> {
    let mut color = part.color()?;
    for (center, i) in places().chain(places().map(|(c, i)| (Center { x: c.y, y: c.x, ..c }, i))) {
        let point = Square::new(center, SubPx::from_bits(256), ());
        draw::square(&mut color, &mut NoDepth, &point, &Flat(COLORS[i as usize & 3]));
    }
    Ok(())
}

pub fn squares<Q: Quality>(part: &mut Part<'_>) -> Result<(), Error> {
    let (mut color, mut depth) = part.compared::<Less>()?;
    for (center, i) in places() {
        let square = Square::new(
            center,
            SubPx::from_bits(300 + 97 * i),
            Q::Color::from(Gouraud565::corner(200, i as u8, 255 - i as u8)),
        );
        draw::square(&mut color, &mut depth, &square, &Q::GOURAUD);
    }
    Ok(())
}

pub fn discs(part: &mut Part<'_>) -> Result<(), Error> {
    let (mut color, mut depth) = part.compared::<LessOrEqual>()?;
    for (center, i) in places() {
        let disc = Disc::new(center, SubPx::from_bits(200 + 83 * i), ());
        draw::disc(&mut color, &mut depth, &disc, &Flat(COLORS[i as usize & 3] ^ i as u16));
    }
    Ok(())
}

pub fn billboards(part: &mut Part<'_>) -> Result<(), Error> {
    let textured = Textured(Nearest::new(TEXTURE?, 16));
    let (mut color, mut depth) = part.compared::<LessOrEqual>()?;
    for (center, i) in places().step_by(3) {
        let to = [4 << 16, (4 << 16) + (i << 12)];
        let billboard = Square::billboard(center, SubPx::from_bits(900 + 61 * i), [0; 2], to);
        draw::square(&mut color, &mut depth, &billboard, &textured);
    }
    Ok(())
}
