//! What can fail, and only where something is made.

use core::fmt;

/// Why something could not be made. Drawing itself cannot fail.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// A direction of length 0: a rotation's axis, a view without direction, an up along the view.
    ZeroVector,
    /// A projection with left = right, bottom = top or near = far.
    FlatView,
    /// One clip plane more than there is room for.
    TooManyPlanes,
    /// One light more than there is room for.
    TooManyLights,
    /// A buffer is too short for its picture, or its stride shorter than its width.
    BufferTooSmall,
    /// A picture or viewport reaches beyond the guard band of its word size.
    TooLarge,
    /// A texture without width or height.
    EmptyTexture,
    /// A patch's subdivision level outside 1…8.
    SubdivisionLevel,
    /// A supersampling level outside 1…16.
    SupersamplingLevel,
    /// A mesh refers to a vertex that it does not have.
    MeshIndex,
    /// Faces of a mesh with fewer than three corners, without their end, or of another shape than its attributes'.
    MeshShape,
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Error::ZeroVector => "a direction of length 0",
            Error::FlatView => "a projection whose opposite sides coincide",
            Error::TooManyPlanes => "more clip planes than there is room for",
            Error::TooManyLights => "more lights than there is room for",
            Error::BufferTooSmall => "the buffer is too short for the picture",
            Error::TooLarge => "the picture reaches beyond the guard band",
            Error::EmptyTexture => "a texture without width or height",
            Error::SubdivisionLevel => "a subdivision level outside 1 to 8",
            Error::SupersamplingLevel => "a supersampling level outside 1 to 16",
            Error::MeshIndex => "a mesh refers to a vertex that it does not have",
            Error::MeshShape => "faces that are incomplete or differ between attributes",
        })
    }
}

impl core::error::Error for Error {}
