//! Workloads files: geometry as JSON, to be drawn by the core.

use std::path::{Path, PathBuf};
use std::{env, fs};

use fixel_workloads::bytes::{NAME_BYTES, Vertex};
use fixel_workloads::frame::{HEIGHT, WIDTH};
use serde_json::Value;

use crate::failure::Failure;

/// The variable that names the default file.
const VARIABLE: &str = "FIXEL_BENCH";

/// The keys that images draw.
const DRAWN: [&str; 2] = ["W1", "W2"];

/// The values of a vertex, in this order.
const FIELDS: [&str; 9] = ["x", "y", "z", "w", "r", "g", "b", "u", "v"];

/// A triangle on the core's grid.
pub type Triangle = [Vertex; 3];

/// A workloads file, read.
pub struct Workloads {
    path: PathBuf,
    root: Value,
}

impl Workloads {
    /// The file `given`, else the one that the environment names, if either.
    pub fn find(given: Option<PathBuf>) -> Result<Option<Self>, Failure> {
        let named = || env::var_os(VARIABLE).filter(|v| !v.is_empty()).map(PathBuf::from);
        given.or_else(named).map(|path| Self::read(&path)).transpose()
    }

    /// As [`find`](Self::find), for commands that can do nothing without.
    pub fn require(given: Option<PathBuf>) -> Result<Self, Failure> {
        Self::find(given)?.ok_or_else(|| {
            Failure::Usage(format!(
                "no workloads: name a workloads.json as the argument or in {VARIABLE}"
            ))
        })
    }

    fn read(path: &Path) -> Result<Self, Failure> {
        let text = fs::read_to_string(path).map_err(|e| Failure::trouble(path.display(), e))?;
        let root: Value = serde_json::from_str(&text).map_err(|e| Failure::trouble(path.display(), e))?;
        let workloads = Workloads {
            path: path.to_owned(),
            root,
        };
        let expected = [("width", Value::from(WIDTH)), ("height", Value::from(HEIGHT))];
        for (key, value) in expected.into_iter().chain([("vertex", Value::from(FIELDS.to_vec()))]) {
            if workloads.root.get(key) != Some(&value) {
                return Err(workloads.fault(key, &format!("must be {value}")));
            }
        }
        Ok(workloads)
    }

    /// The triangles of `key`.
    pub fn triangles(&self, key: &str) -> Result<Vec<Triangle>, Failure> {
        let list = self.root.get(key).and_then(Value::as_array);
        let list = list.ok_or_else(|| self.fault(key, "is not a list of vertices"))?;
        let vertices = list.iter().map(vertex).collect::<Option<Vec<_>>>();
        let vertices = vertices.ok_or_else(|| {
            self.fault(
                key,
                "has a vertex that is not nine numbers within ±4096 px, 0…1 and 0…255",
            )
        })?;
        let (triangles, rest) = vertices.as_chunks::<3>();
        if rest.is_empty() {
            Ok(triangles.to_vec())
        } else {
            Err(self.fault(key, "has vertices left over: every three are a triangle"))
        }
    }

    /// What the images draw, in the form that they read.
    pub fn to_bytes(&self) -> Result<Vec<u8>, Failure> {
        let mut bytes = Vec::new();
        for key in DRAWN {
            let triangles = self.triangles(key)?;
            let mut name = [0; NAME_BYTES];
            for (byte, letter) in name.iter_mut().zip(key.bytes()) {
                *byte = letter;
            }
            bytes.extend(name);
            bytes.extend((triangles.len() as u32 * 3).to_le_bytes());
            bytes.extend(triangles.iter().flatten().flat_map(|vertex| vertex.to_bytes()));
        }
        Ok(bytes)
    }

    fn fault(&self, key: &str, what: &str) -> Failure {
        Failure::Trouble(format!("{}: {key} {what}", self.path.display()))
    }
}

/// A vertex snapped to the core's grid. Its pixel centres lie at +½, the core's samples at whole pixels.
fn vertex(value: &Value) -> Option<Vertex> {
    let numbers: Vec<f64> = value.as_array()?.iter().map(Value::as_f64).collect::<Option<_>>()?;
    let &[x, y, z, _, red, green, blue, _, _] = numbers.as_slice() else {
        return None;
    };
    let subpixels = |v: f64| (v.abs() <= 4096.0).then(|| ((v - 0.5) * 256.0).round() as i32);
    let channel = |v: f64| (0.0..=255.0).contains(&v).then(|| v.round() as u8);
    Some(Vertex {
        x: subpixels(x)?,
        y: subpixels(y)?,
        depth: (0.0..=1.0)
            .contains(&z)
            .then(|| (z * 65535.0 * 32768.0).round() as u32)?,
        color: [channel(red)?, channel(green)?, channel(blue)?],
    })
}
