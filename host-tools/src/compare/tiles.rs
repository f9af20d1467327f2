//! Which shapes may touch which tile of the picture, so that judging a pixel costs what is near it.

/// First and last column, first and last row, both included.
pub type Bounds = [[usize; 2]; 2];

/// Side of a tile in px.
const SIDE: usize = 16;

/// Lists of shapes for the tiles that somebody will ask about.
pub struct Tiles {
    columns: usize,
    lists: Vec<Option<Vec<usize>>>,
}

impl Tiles {
    /// The tiles of a picture, with lists for those that hold one of the pixels (counted row by row). The bounds are those of the
    /// shapes in drawing order, none for one that is off the picture.
    pub fn new(bounds: impl Iterator<Item = Option<Bounds>>, width: u32, height: u32, pixels: &[usize]) -> Self {
        let columns = (width as usize).div_ceil(SIDE);
        let rows = (height as usize).div_ceil(SIDE);
        let lists = vec![None; columns * rows];
        let mut tiles = Self { columns, lists };
        for &pixel in pixels {
            let tile = tiles.tile(pixel % width as usize, pixel / width as usize);
            tiles.lists[tile].get_or_insert_with(Vec::new);
        }
        for (index, bounds) in bounds.enumerate() {
            let Some([x, y]) = bounds else {
                continue;
            };
            for row in y[0] / SIDE..=y[1] / SIDE {
                let from = row * columns;
                let lists = &mut tiles.lists[from + x[0] / SIDE..=from + x[1] / SIDE];
                for list in lists.iter_mut().flatten() {
                    list.push(index);
                }
            }
        }
        tiles
    }

    /// The shapes that may touch a pixel, in drawing order.
    pub fn near(&self, x: usize, y: usize) -> &[usize] {
        self.lists[self.tile(x, y)].as_deref().unwrap_or(&[])
    }

    fn tile(&self, x: usize, y: usize) -> usize {
        y / SIDE * self.columns + x / SIDE
    }
}
