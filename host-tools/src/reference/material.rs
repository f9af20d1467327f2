//! The colour of a fragment: surface, texture, lights (formats/hw2.md sections 6 and 7).

use std::sync::Arc;

use super::attributes::Attributes;
use super::matrix::{dot, unit_or_zero};
use crate::picture::Picture;

/// Where the surface colour comes from.
#[derive(Debug, Clone, PartialEq)]
pub enum Fill {
    /// One colour.
    Flat([f64; 3]),
    /// The vertices' colours, interpolated.
    Gouraud,
    /// A texture.
    Textured(Arc<Picture>),
}

/// Where a light's rays come from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Source {
    /// From a direction: unit length, in eye space; zero for a sun of direction 0 0 0, which lights nothing.
    Sun([f64; 3]),
    /// From a point in eye space.
    Bulb([f64; 3]),
}

/// A light as it was when its command was read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Light {
    /// Its direction or position.
    pub source: Source,
    /// Red, green, blue; not clamped, may be negative.
    pub color: [f64; 3],
    /// Bound of the length of the difference between the core's direction or position and this one.
    pub error: f64,
}

impl Light {
    /// The unit vector from a point towards the light.
    pub fn direction(&self, from: [f64; 3]) -> [f64; 3] {
        match self.source {
            Source::Sun(direction) => direction,
            Source::Bulb(at) => unit_or_zero([0, 1, 2].map(|i| at[i] - from[i])),
        }
    }

    /// What it adds to a fragment of surface colour o, unit normal n and eye position p:
    /// c · light · o + light · max(0, n·h)^a with c = n·l and h = unit(l + unit(−p)); nothing if c ≤ 0.
    fn add(&self, sum: &mut [f64; 3], o: [f64; 3], n: [f64; 3], p: [f64; 3], shininess: f64) {
        let l = self.direction(p);
        let c = dot(n, l);
        // What is not a number lights nothing either.
        if c.is_nan() || c <= 0.0 {
            return;
        }
        let highlight = if shininess > 0.0 {
            let to_eye = unit_or_zero(p.map(|x| -x));
            let h = unit_or_zero([0, 1, 2].map(|i| l[i] + to_eye[i]));
            dot(n, h).max(0.0).powf(shininess)
        } else {
            0.0
        };
        for i in 0..3 {
            sum[i] += c * self.color[i] * o[i] + self.color[i] * highlight;
        }
    }
}

/// Everything that the fragments of a primitive have in common.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// The surface colour.
    pub fill: Fill,
    /// Whether a texture is blended over the vertices' colours.
    pub decals: bool,
    /// The lights of the moment; without any, the surface colour is the fragment's.
    pub lights: Arc<Vec<Light>>,
    /// The specular exponent; off at 0 and below.
    pub shininess: f64,
    /// The unit normal of the whole triangle, in eye space, instead of the interpolated one.
    pub flat_normal: Option<[f64; 3]>,
    /// Bound of the length of the difference between the core's flat normal and this one.
    pub flat_normal_error: f64,
}

impl Material {
    /// Whether lights decide the colour.
    pub fn is_lit(&self) -> bool {
        !self.lights.is_empty()
    }

    /// The texture, if this is a textured surface.
    pub fn texture(&self) -> Option<&Picture> {
        match &self.fill {
            Fill::Textured(texture) => Some(texture),
            Fill::Flat(_) | Fill::Gouraud => None,
        }
    }

    /// The fragment's colour, unclamped.
    pub fn color(&self, at: &Attributes) -> [f64; 3] {
        self.with_texel(at, self.texel(at.texcoord))
    }

    /// The column and row of the texel that a coordinate picks: floor(s·w + ½) mod w (section 6). (0, 0) without a texture
    /// and for what is not a number.
    pub fn texel(&self, [s, t]: [f64; 2]) -> (i64, i64) {
        let Some(texture) = self.texture() else {
            return (0, 0);
        };
        let pick = |coordinate: f64, size: u32| {
            let size = f64::from(size);
            (coordinate * size + 0.5).floor().rem_euclid(size) as i64
        };
        (pick(s, texture.width), pick(t, texture.height))
    }

    /// The colour that the fragment would have with a certain texel, wrapped around.
    pub fn with_texel(&self, at: &Attributes, texel: (i64, i64)) -> [f64; 3] {
        let surface = match &self.fill {
            Fill::Flat(color) => *color,
            Fill::Gouraud => at.color,
            Fill::Textured(texture) => self.textured(texture, texel, at.color),
        };
        if self.is_lit() { self.lit(surface, at) } else { surface }
    }

    /// The texel's colour; with `decals` over the vertices' colour.
    fn textured(&self, texture: &Picture, (column, row): (i64, i64), below: [f64; 3]) -> [f64; 3] {
        let column = column.rem_euclid(i64::from(texture.width)) as usize;
        let row = row.rem_euclid(i64::from(texture.height)) as usize;
        let texel = texture.pixels[row * texture.width as usize + column];
        let [r, g, b, alpha] = texel.map(|level| f64::from(level) / 255.0);
        if self.decals {
            let over = |own: f64, below: f64| own * alpha + below * (1.0 - alpha);
            [over(r, below[0]), over(g, below[1]), over(b, below[2])]
        } else {
            [r, g, b]
        }
    }

    /// The sum over all lights: no ambient light, and normals are one-sided.
    fn lit(&self, surface: [f64; 3], at: &Attributes) -> [f64; 3] {
        let normal = self.flat_normal.unwrap_or_else(|| unit_or_zero(at.normal));
        let mut sum = [0.0; 3];
        for light in self.lights.iter() {
            light.add(&mut sum, surface, normal, at.eye, self.shininess);
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WHITE: [f64; 3] = [1.0; 3];
    const TOWARDS: [f64; 3] = [0.0, 0.0, -1.0];

    fn sun(direction: [f64; 3], color: [f64; 3]) -> Light {
        Light {
            source: Source::Sun(direction),
            color,
            error: 0.0,
        }
    }

    fn bulb(at: [f64; 3]) -> Light {
        Light {
            source: Source::Bulb(at),
            color: WHITE,
            error: 0.0,
        }
    }

    fn material(fill: Fill, lights: Vec<Light>, shininess: f64) -> Material {
        Material {
            fill,
            decals: false,
            lights: Arc::new(lights),
            shininess,
            flat_normal: None,
            flat_normal_error: 0.0,
        }
    }

    /// A white surface at (0, 0, 2), lit.
    fn lit(normal: [f64; 3], lights: Vec<Light>, shininess: f64) -> [f64; 3] {
        let at = Attributes {
            normal,
            eye: [0.0, 0.0, 2.0],
            ..Attributes::default()
        };
        material(Fill::Flat(WHITE), lights, shininess).color(&at)
    }

    fn near(a: [f64; 3], b: [f64; 3]) -> bool {
        a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-15)
    }

    /// Three texels wide, two high; level i + 10 j, the second row half transparent.
    fn texture() -> Arc<Picture> {
        let texel = |k: u8| [k % 3 + 10 * (k / 3), 0, 255, if k < 3 { 255 } else { 51 }];
        Arc::new(Picture::new(3, 2, (0..6).map(texel).collect()))
    }

    #[test]
    fn diffuse_light_goes_with_the_cosine_and_the_surface() {
        let slanted = [0.6, 0.0, -0.8];
        assert!(near(
            lit(slanted, vec![sun(TOWARDS, [1.0, 2.0, -0.5])], 0.0),
            [0.8, 1.6, -0.4]
        ));
        let at = Attributes {
            color: [0.5, 0.25, -1.0],
            normal: slanted.map(|c| 0.3 * c),
            ..Attributes::default()
        };
        let gouraud = material(
            Fill::Gouraud,
            vec![sun(TOWARDS, [2.0; 3]), sun(TOWARDS, [-1.0; 3])],
            0.0,
        );
        assert!(
            near(gouraud.color(&at), [0.4, 0.2, -0.8]),
            "normalised again, and summed"
        );
        let flat = Material {
            flat_normal: Some(TOWARDS),
            ..gouraud
        };
        assert!(near(flat.color(&at), at.color));
    }

    #[test]
    fn without_lights_colours_stay_and_without_light_all_is_dark() {
        let at = Attributes {
            color: [3.0, -2.0, 0.1],
            ..Attributes::default()
        };
        assert_eq!(material(Fill::Gouraud, vec![], 5.0).color(&at), at.color);
        // From behind, along the surface, from nowhere, and with a normal of 0: not even a highlight.
        for (normal, direction) in [
            ([0.0, 0.0, 1.0], TOWARDS),
            ([1.0, 0.0, 0.0], TOWARDS),
            (TOWARDS, [0.0; 3]),
            ([0.0; 3], TOWARDS),
        ] {
            assert_eq!(lit(normal, vec![sun(direction, WHITE)], 1.0), [0.0; 3]);
        }
    }

    #[test]
    fn a_bulb_shines_from_its_place() {
        // From (3, 0, -2) to (0, 0, 2): l = (3, 0, -4)/5.
        assert!(near(lit(TOWARDS, vec![bulb([3.0, 0.0, -2.0])], 0.0), [0.8; 3]));
        assert_eq!(
            lit(TOWARDS, vec![bulb([0.0, 0.0, 2.0])], 1.0),
            [0.0; 3],
            "in the surface"
        );
    }

    #[test]
    fn a_highlight_stands_halfway_to_the_eye() {
        // l = (0.96, 0, -0.28), to the eye (0, 0, -1): their sum has the length 1.6 and n·h is 0.8.
        let light = || vec![sun([0.96, 0.0, -0.28], [1.0, 0.5, -1.0])];
        let [c, k] = [0.28, 0.8_f64.powi(3)];
        assert!(near(lit(TOWARDS, light(), 3.0), [c + k, (c + k) / 2.0, -c - k]));
        assert!(near(lit(TOWARDS, light(), -3.0), [c, c / 2.0, -c]), "off");
        // The surface's colour dims the light but not the highlight.
        let black = material(Fill::Flat([0.0; 3]), light(), 3.0);
        let at = Attributes {
            normal: TOWARDS,
            eye: [0.0, 0.0, 2.0],
            ..Attributes::default()
        };
        assert!(near(black.color(&at), [k, k / 2.0, -k]));
    }

    #[test]
    fn texels_are_the_nearest_and_wrap() {
        let m = material(Fill::Textured(texture()), vec![], 0.0);
        // Texel i is centred on s = i/3: from (i − ½)/3, included, to (i + ½)/3.
        for (s, t, texel) in [
            (0.0, 0.0, (0, 0)),
            (0.16, 0.24, (0, 0)),
            (0.17, 0.25, (1, 1)),
            (0.84, 0.76, (0, 0)),
            (-0.16, -0.25, (0, 0)),
            (-0.17, -0.26, (2, 1)),
            (-1.3, 1e3, (2, 0)),
            (f64::NAN, f64::INFINITY, (0, 0)),
        ] {
            assert_eq!(m.texel([s, t]), texel, "{s} {t}");
        }
        // -1.3, -0.3, 0.7 and 1.7 name one texel (section 6).
        let same = [-1.3, -0.3, 0.7, 1.7].map(|s| m.texel([s, 0.0]).0);
        assert_eq!(same, [2; 4]);
        assert_eq!(material(Fill::Gouraud, vec![], 0.0).texel([0.7, 0.7]), (0, 0));
    }

    #[test]
    fn decals_let_the_colour_below_through() {
        let at = Attributes {
            color: [0.0, 1.0, 0.5],
            texcoord: [0.34, 0.5],
            ..Attributes::default()
        };
        let plain = material(Fill::Textured(texture()), vec![], 0.0);
        assert_eq!(plain.color(&at), [11.0 / 255.0, 0.0, 1.0]);
        assert_eq!(plain.with_texel(&at, (-1, 4)), [2.0 / 255.0, 0.0, 1.0]);
        let decals = Material { decals: true, ..plain };
        // α = 51/255 = 0.2.
        assert!(near(decals.color(&at), [0.2 * 11.0 / 255.0, 0.8, 0.6]));
    }

    #[test]
    fn every_level_of_a_texture_comes_out_as_it_went_in() {
        assert!((0..=255_u8).all(|level| crate::reference::byte(f64::from(level) / 255.0) == level));
    }
}
