//! How an emitted mesh is shown where its cost is told: from the front, the left and above, as large as fits, in one sun.

use fixel::clip::{Behind, DepthRange, Planes};
use fixel::error::Error;
use fixel::light::Sunlight;
use fixel::matrix::{Directions, Matrix};
use fixel::num::{Angle, Block, SineTable};
use fixel::view::{Cull, View};
use fixel::viewport::Viewport;

/// From the middle of the mesh to the camera.
const AWAY: i32 = 3;

/// Half of the shorter side of the picture at distance 1, in units of 2^-6: a little more than the sphere of radius 1 takes,
/// 1/√(3² − 1).
const HALF: i32 = 23;

/// From the mesh's own space to the camera's.
fn model() -> Result<Matrix<i32>, Error> {
    let turned =
        |degrees, axis| Matrix::rotation::<SineTable>(Angle::from_degrees(degrees), Block::from_integers(axis));
    let turned = turned(20, [1, 0, 0])?.product(&turned(30, [0, 1, 0])?);
    let position = Block::from_integers([0, 0, -AWAY]);
    Ok(Matrix::model(position, &turned, Block::from_integers([1; 3])))
}

/// The view of a picture of this size.
///
/// # Errors
/// [`Error::TooLarge`] beyond 4096 pixels a side, [`Error::FlatView`] without pixels.
pub fn view(width: u16, height: u16) -> Result<View<i32, i32, 0>, Error> {
    let half = |side: u16| {
        let shorter = width.min(height).into();
        (HALF * i32::from(side)).checked_div(shorter).ok_or(Error::FlatView)
    };
    let (x, y, unit) = (half(width)?, half(height)?, 1 << 6);
    let sides = [-x, x, -y, y, unit, (2 * AWAY) << 6];
    Ok(View {
        projection: Matrix::frustum(sides.map(|side| Block::new([side], -6)))?.product(&model()?),
        planes: Planes::default(),
        viewport: Viewport::new(0, 0, width, height)?.y_up().samples_at_centers(),
        depth_range: DepthRange::MinusOneToOne,
        behind: Behind::Cut,
        cull: Cull::Clockwise,
    })
}

/// White, from behind the camera.
///
/// # Errors
/// None: the sun has a direction.
pub fn sun() -> Result<Sunlight, Error> {
    let mut directions = Directions::<i32>::identity();
    directions.load(&model()?);
    let levels = |eighths: i32| [31, 63, 31].map(|most| (most << 13) * eighths);
    Sunlight::new([1, 2, 3], &directions, levels(1), levels(6))
}
