//! Triangles all over the screen, each of which inverts what it covers: whose corners are rounded to 1/256 px, or coarser.

use core::hint::black_box;
use core::marker::PhantomData;

use fixel::depth::NoDepth;
use fixel::draw::triangle;
use fixel::error::Error;
use fixel::fragment::Fragment;
use fixel::screen::{Position, SubPx};

use super::canvas::Canvas;
use super::color::{BLACK, Output};
use super::geometry::{Models, PIECES};

struct Invert<P>(PhantomData<P>);

impl<P: Output> Fragment for Invert<P> {
    type Varying = ();
    type Pixel = P;

    #[inline(always)]
    fn shade(&self, (): (), below: P) -> Option<P> {
        Some(below.inverted())
    }
}

/// Corners rounded to 2^-`BITS` px, at most 8.
pub fn draw<const BITS: u32, P: Output>(canvas: &mut Canvas<P>, _: &Models) -> Result<(), Error> {
    canvas.colors_mut().fill(P::of(BLACK));
    let (mut color, _) = canvas.buffers()?;
    let rounded = |v: i32| SubPx::from_bits((v + (1 << (15 - BITS))) >> (16 - BITS) << (8 - BITS));
    for corners in black_box(&PIECES) {
        let corners = corners.map(|[x, y]| Position::nearest(rounded(x), rounded(y)).flat());
        triangle(&mut color, &mut NoDepth, corners, &Invert(PhantomData));
    }
    Ok(())
}
