//! The points of a patch as a grid, from the triangles that it is cut into.

use fixel::num::Word;
use fixel::patch::{ControlPoint, PatchVertex, RectangularPatch, TriangularPatch};

use crate::patch_points::level;

pub type Control<T> = ControlPoint<T, 3>;
pub type Point<T> = PatchVertex<T, 3>;
/// `grid[j][i]`.
pub type Grid<T> = Vec<Vec<Point<T>>>;

/// Enters `found` at (i, j); every triangle must bring the same bits.
fn enter<T: Word>(grid: &mut [Vec<Option<Point<T>>>], (i, j): (u32, u32), found: Point<T>) {
    let place = &mut grid[j as usize][i as usize];
    assert!(place.is_none_or(|before| before == found), "({i}, {j})");
    *place = Some(found);
}

/// The grid of a patch from its triangles, whose order is checked with it.
pub fn rectangle_grid<T: Word>(points: [Control<T>; 16], n: u32) -> Grid<T> {
    let pieces = 1 << n;
    let mut grid = vec![vec![None; pieces as usize + 1]; pieces as usize + 1];
    let mut count = 0;
    RectangularPatch::new(points).for_each_triangle::<true>(level(n), &mut |triangle| {
        let (i, j) = (count / 2 % pieces, count / 2 / pieces);
        let places = match count % 2 {
            0 => [(i, j), (i + 1, j), (i, j + 1)],
            _ => [(i + 1, j + 1), (i, j + 1), (i + 1, j)],
        };
        places
            .into_iter()
            .zip(triangle)
            .for_each(|(place, vertex)| enter(&mut grid, place, vertex));
        count += 1;
    });
    assert_eq!(count, 2 * pieces * pieces);
    grid.into_iter()
        .map(|row| row.into_iter().collect::<Option<_>>().unwrap())
        .collect()
}

/// The same of a triangular one.
pub fn triangle_grid<T: Word>(points: [Control<T>; 10], n: u32) -> Grid<T> {
    let pieces = 1 << n;
    let mut grid = vec![vec![None; pieces as usize + 1]; pieces as usize + 1];
    let mut places = Vec::new();
    for j in 0..pieces {
        for i in 0..pieces - j {
            places.push([(i, j), (i + 1, j), (i, j + 1)]);
            if i + 1 < pieces - j {
                places.push([(i + 1, j + 1), (i, j + 1), (i + 1, j)]);
            }
        }
    }
    let mut expected = places.into_iter();
    TriangularPatch::new(points).for_each_triangle::<true>(level(n), &mut |triangle| {
        let places = expected.next().unwrap();
        places
            .into_iter()
            .zip(triangle)
            .for_each(|(place, vertex)| enter(&mut grid, place, vertex));
    });
    assert!(expected.next().is_none());
    grid.into_iter()
        .map(|row| row.into_iter().flatten().collect())
        .collect()
}
