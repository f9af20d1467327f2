//! The reference's state as the commands change it (formats/hw2.md sections 2 and 4).

use std::sync::Arc;

use super::Reference;
use super::patch::Grid;
use super::vertex::{Given, divided_within, unit_within};
use crate::backend::{BackEnd, Patch, Surface, Vertex};
use crate::compare::stated::FIXED_PRODUCT;
use crate::picture::Picture;
use crate::reference::bound::{Tracked, cancellation, size};
use crate::reference::clip::Plane;
use crate::reference::material::{Fill, Light, Material, Source};
use crate::reference::matrix::{Matrix, Vector, length};

impl Reference {
    fn add(&mut self, step: &Tracked) {
        self.model_view = self.model_view.times(step);
    }

    /// Directions' matrix times `step`.
    fn turn(&mut self, step: &Tracked) {
        self.directions = self.directions.times(step);
    }

    /// What is drawn before keeps the lights that it had.
    fn light(&mut self, source: Source, color: [f64; 3], error: f64) {
        Arc::make_mut(&mut self.lights).push(Light { source, color, error });
    }

    /// What is drawn now is made of this.
    pub(super) fn material(&self, surface: Surface) -> Result<Arc<Material>, String> {
        let fill = match surface {
            Surface::Flat(color) => Fill::Flat(color),
            Surface::Gouraud => Fill::Gouraud,
            Surface::Textured => Fill::Textured(Arc::clone(self.texture.as_ref().ok_or("there is no texture yet")?)),
        };
        Ok(Arc::new(Material {
            fill,
            decals: self.decals,
            lights: Arc::clone(&self.lights),
            shininess: self.shininess,
            flat_normal: None,
            flat_normal_error: 0.0,
        }))
    }
}

impl BackEnd for Reference {
    fn load_mv(&mut self, m: &[[f64; 4]; 4]) -> Result<(), String> {
        self.model_view = Tracked::given(Matrix(*m));
        self.directions = self.model_view.for_directions();
        Ok(())
    }

    fn mult_mv(&mut self, m: &[[f64; 4]; 4]) -> Result<(), String> {
        let step = Tracked::given(Matrix(*m));
        self.add(&step);
        self.turn(&step.for_directions());
        Ok(())
    }

    fn load_p(&mut self, m: &[[f64; 4]; 4]) -> Result<(), String> {
        self.projection = Tracked::given(Matrix(*m));
        Ok(())
    }

    fn translate(&mut self, by: [f64; 3]) -> Result<(), String> {
        self.add(&Tracked::given(Matrix::translation(by)));
        Ok(())
    }

    fn rotate(&mut self, degrees: f64, axis: [f64; 3]) -> Result<(), String> {
        let step = Tracked::rotation(degrees, axis);
        self.add(&step);
        self.turn(&step);
        Ok(())
    }

    fn scale(&mut self, by: [f64; 3]) -> Result<(), String> {
        let step = Tracked::given(Matrix::scaling(by));
        self.add(&step);
        self.turn(&step.for_directions());
        Ok(())
    }

    fn look_at(&mut self, eye: [f64; 4], center: [f64; 4], up: [f64; 3]) -> Result<(), String> {
        let [eye, center] = [eye, center].map(|[x, y, z, w]| [x / w, y / w, z / w]);
        let turn = Tracked::looking(eye, center, up);
        self.model_view = turn.times(&Tracked::given(Matrix::translation(eye.map(|c| -c))));
        self.directions = Tracked::new(turn.matrix.linear_part(), turn.error);
        Ok(())
    }

    fn frustum(&mut self, planes: [f64; 6]) -> Result<(), String> {
        self.projection = Tracked::computed(Matrix::frustum(planes), cancellation(&planes));
        Ok(())
    }

    fn ortho(&mut self, planes: [f64; 6]) -> Result<(), String> {
        self.projection = Tracked::computed(Matrix::ortho(planes), cancellation(&planes));
        Ok(())
    }

    fn clip_plane(&mut self, plane: Vector) -> Result<(), String> {
        self.planes.push(Plane::new(plane, &self.directions));
        Ok(())
    }

    fn cull(&mut self) {
        self.cull = true;
    }

    fn decals(&mut self) {
        self.decals = true;
    }

    fn flat_normals(&mut self) {
        self.flat_normals = true;
    }

    fn texture(&mut self, texture: &Arc<Picture>) -> Result<(), String> {
        self.texture = Some(Arc::clone(texture));
        Ok(())
    }

    fn sun(&mut self, [x, y, z]: [f64; 3], color: [f64; 3]) -> Result<(), String> {
        let given = FIXED_PRODUCT * length([x, y, z]);
        let ([x, y, z, _], error) = self.directions.apply(&[x, y, z, 0.0], given);
        let (direction, error) = unit_within([x, y, z], error);
        self.light(Source::Sun(direction), color, error);
        Ok(())
    }

    fn bulb(&mut self, position: Vector, color: [f64; 3]) -> Result<(), String> {
        let given = FIXED_PRODUCT * size(&position);
        let (eye, error) = self.model_view.apply(&position, given);
        let (at, error) = divided_within(&eye, error);
        self.light(Source::Bulb(at), color, error);
        Ok(())
    }

    fn shininess(&mut self, exponent: f64) -> Result<(), String> {
        self.shininess = exponent;
        Ok(())
    }

    fn triangle(&mut self, primitive: u32, corners: [Vertex; 3], surface: Surface) -> Result<(), String> {
        let material = self.material(surface)?;
        let placed = corners.map(|vertex| self.placed(&Given::of(&vertex), &material));
        self.primitive(primitive, placed, &material);
        Ok(())
    }

    fn patch(&mut self, first: u32, level: u32, patch: Patch<'_>, surface: Surface) -> Result<(), String> {
        let material = self.material(surface)?;
        let mut triangles = Vec::with_capacity(patch.triangles(level) as usize);
        Grid::new(&patch, level).triangles(
            |sample| self.placed(&Given::of_patch(sample), &material),
            |triangle| triangles.push(triangle),
        );
        for (number, triangle) in (first..).zip(triangles) {
            self.primitive(number, triangle, &material);
        }
        Ok(())
    }
}
