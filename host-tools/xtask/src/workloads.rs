//! Workloads files: geometry as JSON, to be drawn by the core and by others.

use std::path::{Path, PathBuf};
use std::{env, fs};

use fixel_workloads::bytes::{CORNER_BYTES, NAME_BYTES, Vertex};
use fixel_workloads::frame::{HEIGHT, WIDTH};
use serde_json::Value;

use crate::failure::Failure;
use crate::mesh;

/// The variable that names the default file.
const VARIABLE: &str = "FIXEL_BENCH";

/// The keys of triangles that images draw.
const DRAWN: [&str; 4] = ["W1", "W2", "W3", "W4"];

/// The keys of triangles that other crates are given.
const GIVEN: [&str; 8] = [
    "W1",
    "W2",
    "W3",
    "W4",
    "coverage_16",
    "coverage_ties",
    "coverage_256",
    "mesh_grid",
];

/// Texels along a side of the texture.
pub const TEXELS: f64 = 64.0;

/// The values of a vertex, in this order.
const FIELDS: [&str; 9] = ["x", "y", "z", "w", "r", "g", "b", "u", "v"];

/// A corner as the file has it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corner {
    /// Pixels to the right and downwards; pixel centres lie at +½.
    pub position: [f64; 2],
    /// 0, the nearest, to 1.
    pub z: f64,
    /// Distance, for what is in perspective.
    pub w: f64,
    /// Red, green and blue, 0 to 255.
    pub color: [f64; 3],
    /// Place in the texture, 0 to 1.
    pub uv: [f64; 2],
}

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

    /// The triangles of `key`, as the file has them.
    pub fn corners(&self, key: &str) -> Result<Vec<[Corner; 3]>, Failure> {
        let list = self.root.get(key).and_then(Value::as_array);
        let list = list.ok_or_else(|| self.fault(key, "is not a list of vertices"))?;
        let corners = list.iter().map(corner).collect::<Option<Vec<_>>>();
        let corners = corners.ok_or_else(|| {
            self.fault(
                key,
                "has a vertex that is not nine numbers: x and y within ±4096, z, u and v 0…1, w above 0, colour 0…255",
            )
        })?;
        let (triangles, rest) = corners.as_chunks::<3>();
        if rest.is_empty() {
            Ok(triangles.to_vec())
        } else {
            Err(self.fault(key, "has vertices left over: every three are a triangle"))
        }
    }

    /// The triangles of `key`, on the core's grid.
    pub fn triangles(&self, key: &str) -> Result<Vec<Triangle>, Failure> {
        Ok(self.corners(key)?.iter().map(on_grid).collect())
    }

    /// What the images draw, in the form that they read.
    pub fn to_bytes(&self) -> Result<Vec<u8>, Failure> {
        let mut bytes = Vec::new();
        for key in DRAWN {
            let triangles = self.triangles(key)?;
            bytes.extend(title(key));
            bytes.extend((triangles.len() as u32 * 3).to_le_bytes());
            bytes.extend(triangles.iter().flatten().flat_map(|vertex| vertex.to_bytes()));
        }
        if let Some(value) = self.root.get("W5") {
            let mesh = mesh::to_bytes(value).ok_or_else(|| self.fault("W5", "is not a mesh"))?;
            let corners = mesh.len().div_ceil(CORNER_BYTES);
            bytes.extend(title("W5"));
            bytes.extend((corners as u32).to_le_bytes());
            bytes.extend(&mesh);
            bytes.resize(bytes.len() + corners * CORNER_BYTES - mesh.len(), 0);
        }
        Ok(bytes)
    }

    /// What other crates draw, in the form that `benches/rivals` reads.
    pub fn to_floats(&self) -> Result<Vec<u8>, Failure> {
        let mut bytes = Vec::new();
        for key in GIVEN {
            let corners = self.corners(key)?;
            bytes.extend(title(key));
            bytes.extend((corners.len() as u32 * 3 * FIELDS.len() as u32).to_le_bytes());
            let numbers = corners.iter().flatten().flat_map(Corner::numbers);
            bytes.extend(numbers.flat_map(|number| (number as f32).to_le_bytes()));
        }
        Ok(bytes)
    }

    fn fault(&self, key: &str, what: &str) -> Failure {
        Failure::Trouble(format!("{}: {key} {what}", self.path.display()))
    }
}

impl Corner {
    /// In the order of [`FIELDS`].
    pub fn numbers(&self) -> [f64; 9] {
        let ([x, y], [red, green, blue], [u, v]) = (self.position, self.color, self.uv);
        [x, y, self.z, self.w, red, green, blue, u, v]
    }
}

/// The name of a section.
fn title(key: &str) -> [u8; NAME_BYTES] {
    let mut name = [0; NAME_BYTES];
    for (byte, letter) in name.iter_mut().zip(key.bytes()) {
        *byte = letter;
    }
    name
}

fn corner(value: &Value) -> Option<Corner> {
    let numbers: Vec<f64> = value.as_array()?.iter().map(Value::as_f64).collect::<Option<_>>()?;
    let &[x, y, z, w, red, green, blue, u, v] = numbers.as_slice() else {
        return None;
    };
    let within = |values: &[f64], least: f64, most: f64| values.iter().all(|v| (least..=most).contains(v));
    let is_one = within(&[x, y], -4096.0, 4096.0)
        && within(&[z, u, v], 0.0, 1.0)
        && w > 0.0
        && within(&[red, green, blue], 0.0, 255.0);
    is_one.then_some(Corner {
        position: [x, y],
        z,
        w,
        color: [red, green, blue],
        uv: [u, v],
    })
}

/// Snapped. The file's pixel centres lie at +½, the core's samples at whole pixels.
fn on_grid(corners: &[Corner; 3]) -> Triangle {
    let nearest = corners.iter().map(|corner| corner.w).fold(f64::INFINITY, f64::min);
    corners.map(|corner| {
        let [x, y] = corner.position.map(|v| ((v - 0.5) * 256.0).round() as i32);
        Vertex {
            x,
            y,
            depth: (corner.z * 65535.0 * 32768.0).round() as u32,
            color: corner.color.map(|v| v.round() as u8),
            inverse_w: (nearest / corner.w * f64::from(1 << 30)).round() as i32,
            texel: corner.uv.map(|v| (v * TEXELS * 65536.0).round() as i32),
        }
    })
}
