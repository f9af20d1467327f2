//! Comparison with an existing picture, as opposed to that of the two back ends with each other.

use std::path::Path;

use crate::args::Args;
use crate::exit::Failure;
use crate::files;
use crate::load::Loaded;
use crate::picture::Picture;

/// The largest difference of a channel, of 255, that is not over 2 %.
const TWO_PERCENT: u8 = 5;

/// An existing picture, and which of its pixels are excused.
#[derive(Debug)]
pub struct Against {
    picture: Picture,
    ties: Option<Picture>,
}

/// How a picture compares with the existing one.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Agreement {
    /// Pixels of which some channel differs by more than 2 %.
    pub over_2_percent: u64,
    /// Those of them that the mask does not excuse.
    pub over_2_percent_outside_ties: u64,
    /// The largest difference of any channel of any pixel.
    pub max_channel_error: u8,
    /// The same bytes everywhere.
    pub identical: bool,
}

impl Against {
    /// Reads what `--against` and `--ties` name; both must have the scene's size.
    pub fn read(args: &Args, loaded: &Loaded) -> Result<Option<Self>, Failure> {
        let Some(file) = &args.against else {
            return Ok(None);
        };
        let read = |file: &Path| {
            let picture = files::read_picture(file)?;
            let (width, height) = loaded.scene.size();
            if picture.size() == (width, height) {
                return Ok(picture);
            }
            Err(Failure::bad(format!(
                "{}: is {}x{}, but {} draws {width}x{height}",
                file.display(),
                picture.width,
                picture.height,
                loaded.file.display(),
            )))
        };
        Ok(Some(Self {
            picture: read(file)?,
            ties: args.ties.as_deref().map(read).transpose()?,
        }))
    }

    /// Compares a picture of the same size.
    pub fn agreement(&self, picture: &Picture) -> Agreement {
        let mut agreement = Agreement {
            identical: *picture == self.picture,
            ..Agreement::default()
        };
        for (index, (&ours, &theirs)) in picture.pixels.iter().zip(&self.picture.pixels).enumerate() {
            let error = error(ours, theirs);
            agreement.max_channel_error = agreement.max_channel_error.max(error);
            if error > TWO_PERCENT {
                agreement.over_2_percent += 1;
                agreement.over_2_percent_outside_ties += u64::from(!self.excused(index));
            }
        }
        agreement
    }

    fn excused(&self, index: usize) -> bool {
        let mask = self.ties.as_ref().and_then(|mask| mask.pixels.get(index));
        mask.is_some_and(|&[r, g, b, _]| [r, g, b] == [255; 3])
    }
}

/// The largest difference of a channel; none between pixels that are both invisible.
fn error(a: [u8; 4], b: [u8; 4]) -> u8 {
    if a[3] == 0 && b[3] == 0 {
        return 0;
    }
    let differences = a.iter().zip(b).map(|(a, b)| a.abs_diff(b));
    differences.max().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(pixels: &[[u8; 4]]) -> Picture {
        Picture::new(pixels.len() as u32, 1, pixels.to_vec())
    }

    #[test]
    fn over_two_percent_is_more_than_five() {
        let theirs = row(&[[100, 100, 100, 255]; 4]);
        let ours = row(&[
            [100, 100, 100, 255],
            [105, 95, 100, 255],
            [100, 100, 106, 255],
            [100, 100, 100, 249],
        ]);
        let ties = Some(row(&[[0; 4], [0; 4], [255; 4], [254, 255, 255, 255]]));
        let against = Against { picture: theirs, ties };
        let expected = Agreement {
            over_2_percent: 2,
            over_2_percent_outside_ties: 1,
            max_channel_error: 6,
            identical: false,
        };
        assert_eq!(against.agreement(&ours), expected);
        let same = against.picture.clone();
        assert!(against.agreement(&same).identical);
    }

    #[test]
    fn invisible_pixels_are_equal_but_not_identical() {
        let against = Against {
            picture: row(&[[9, 9, 9, 0]]),
            ties: None,
        };
        let agreement = against.agreement(&row(&[[0; 4]]));
        assert_eq!(agreement, Agreement::default());
        let one_visible = against.agreement(&row(&[[9, 9, 9, 255]]));
        assert_eq!(one_visible.over_2_percent_outside_ties, 1);
        assert_eq!(one_visible.max_channel_error, 255);
    }
}
