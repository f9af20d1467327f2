//! The mesh of a workloads file as the images read it.

use serde_json::Value;

/// The bytes of a mesh, as `fixel_workloads::mesh` describes them; `None` where `value` is none, or one of more than 65536
/// vertices.
pub fn to_bytes(value: &Value) -> Option<Vec<u8>> {
    let points = rows::<3>(value.get("positions")?)?;
    let normals = rows::<3>(value.get("normals")?)?;
    let triangles = rows::<3>(value.get("triangles")?)?;
    let is_index = |&v: &f64| v >= 0.0 && v < points.len() as f64 && v <= 65535.0 && v.fract() == 0.0;
    if normals.len() != points.len() || !triangles.iter().flatten().all(is_index) {
        return None;
    }
    // The largest coordinate becomes the largest number.
    let largest = points.iter().flatten().fold(0.0, |most: f64, v| most.max(v.abs()));
    let size = largest * 32768.0 / 32767.0;
    let mut bytes = Vec::new();
    bytes.extend((points.len() as u32).to_le_bytes());
    bytes.extend((triangles.len() as u32).to_le_bytes());
    let stored = |v: f64| ((v * 32768.0).round().clamp(-32768.0, 32767.0) as i16).to_le_bytes();
    bytes.extend(points.iter().flatten().flat_map(|v| stored(v / size)));
    bytes.extend(normals.iter().flatten().flat_map(|&v| stored(v)));
    bytes.extend(triangles.iter().flatten().flat_map(|&v| (v as u16).to_le_bytes()));
    bytes.extend(matrix(&[
        [size, 0.0, 0.0, 0.0],
        [0.0, size, 0.0, 0.0],
        [0.0, 0.0, size, 0.0],
        [0.0, 0.0, 0.0, 1.0],
    ]));
    bytes.extend(matrix(&rows::<4>(value.get("model_view")?)?));
    bytes.extend(matrix(&rows::<4>(value.get("projection")?)?));
    let light = numbers::<3>(value.get("light_eye")?)?;
    bytes.extend(
        light
            .iter()
            .flat_map(|v| ((v * f64::from(1 << 30)).round() as i32).to_le_bytes()),
    );
    Some(bytes)
}

fn rows<const N: usize>(value: &Value) -> Option<Vec<[f64; N]>> {
    value.as_array()?.iter().map(numbers).collect()
}

fn numbers<const N: usize>(value: &Value) -> Option<[f64; N]> {
    let numbers: Vec<f64> = value.as_array()?.iter().map(Value::as_f64).collect::<Option<_>>()?;
    numbers.try_into().ok()
}

/// Sixteen integers of 30 bits and their exponent.
fn matrix(rows: &[[f64; 4]]) -> Vec<u8> {
    let largest = rows
        .iter()
        .flatten()
        .fold(f64::MIN_POSITIVE, |most, v| most.max(v.abs()));
    let exponent = largest.log2().ceil() as i32 - 30;
    let entries = rows
        .iter()
        .flatten()
        .map(|v| (v / f64::from(exponent).exp2()).round() as i32);
    entries.chain([exponent]).flat_map(i32::to_le_bytes).collect()
}
