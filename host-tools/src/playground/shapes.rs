//! The two shapes (PG.4, PG.5) in whole numbers, three corners to a triangle.

/// A corner of a triangle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Corner {
    /// Each coordinate −1, 0 or 1.
    pub position: [i8; 3],
    /// Of length 1.
    pub normal: [i8; 3],
    /// Texture coordinates, 0 or 1.
    pub uv: [i8; 2],
}

/// A square in y = 0, seen from above. The last uv is (1,0), where (0,1) would be regular: the course's picture has it so.
pub const PLANE: [Corner; 6] = {
    const UP: [i8; 3] = [0, 1, 0];
    [
        corner([-1, 0, -1], UP, [1, 0]),
        corner([-1, 0, 1], UP, [0, 0]),
        corner([1, 0, -1], UP, [1, 1]),
        corner([1, 0, -1], UP, [1, 1]),
        corner([-1, 0, 1], UP, [0, 0]),
        corner([1, 0, 1], UP, [1, 0]),
    ]
};

/// A cube, each face seen from outside: front, right, back, left, top, bottom.
///
/// The normal of the back and one uv of the front are not regular: the course's picture is made with them.
pub const BOX: [Corner; 36] = {
    let front = face(
        [0, 0, 1],
        [[-1, -1, 1], [1, 1, 1], [-1, 1, 1], [1, 1, 1], [-1, -1, 1], [1, -1, 1]],
    );
    let right = face(
        [1, 0, 0],
        [[1, -1, 1], [1, -1, -1], [1, 1, 1], [1, 1, 1], [1, -1, -1], [1, 1, -1]],
    );
    let back = face(
        [-1, 0, 0],
        [
            [1, -1, -1],
            [-1, -1, -1],
            [1, 1, -1],
            [1, 1, -1],
            [-1, -1, -1],
            [-1, 1, -1],
        ],
    );
    let left = face(
        [-1, 0, 0],
        [
            [-1, -1, -1],
            [-1, -1, 1],
            [-1, 1, -1],
            [-1, 1, -1],
            [-1, -1, 1],
            [-1, 1, 1],
        ],
    );
    let top = face(
        [0, 1, 0],
        [[-1, 1, 1], [1, 1, 1], [-1, 1, -1], [-1, 1, -1], [1, 1, 1], [1, 1, -1]],
    );
    let bottom = face(
        [0, -1, 0],
        [
            [-1, -1, -1],
            [1, -1, -1],
            [-1, -1, 1],
            [-1, -1, 1],
            [1, -1, -1],
            [1, -1, 1],
        ],
    );
    let mut corners = [corner([0; 3], [0; 3], [0; 2]); 36];
    let faces = [front, right, back, left, top, bottom];
    let mut i = 0;
    while i < 36 {
        corners[i] = faces[i / 6][i % 6];
        i += 1;
    }
    let front_uvs = [[0, 0], [1, 1], [0, 1], [1, 1], [0, 0], [0, 1]];
    let mut i = 0;
    while i < 6 {
        corners[i].uv = front_uvs[i];
        i += 1;
    }
    corners
};

const fn corner(position: [i8; 3], normal: [i8; 3], uv: [i8; 2]) -> Corner {
    Corner { position, normal, uv }
}

/// A face with the texture coordinates that all faces but the front one have.
const fn face(normal: [i8; 3], p: [[i8; 3]; 6]) -> [Corner; 6] {
    [
        corner(p[0], normal, [0, 0]),
        corner(p[1], normal, [1, 0]),
        corner(p[2], normal, [0, 1]),
        corner(p[3], normal, [0, 1]),
        corner(p[4], normal, [1, 0]),
        corner(p[5], normal, [1, 1]),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Twice the area's vector, counter-clockwise.
    fn area([a, b, c]: &[Corner; 3]) -> [i8; 3] {
        let [e, f] = [b, c].map(|p| [0, 1, 2].map(|i| p.position[i] - a.position[i]));
        [
            e[1] * f[2] - e[2] * f[1],
            e[2] * f[0] - e[0] * f[2],
            e[0] * f[1] - e[1] * f[0],
        ]
    }

    #[test]
    fn pg_4_the_plane_is_seen_from_above() {
        for triangle in PLANE.as_chunks().0 {
            assert_eq!(area(triangle), [0, 4, 0]);
        }
    }

    #[test]
    fn pg_5_the_box_is_closed_and_seen_from_outside() {
        let mut total = [0; 3];
        for (i, triangle) in BOX.as_chunks().0.iter().enumerate() {
            let outwards = area(triangle);
            // The back face is the one whose normal is not its own.
            let own = if i / 2 == 2 { [0, 0, -1] } else { triangle[0].normal };
            assert_eq!(outwards, own.map(|c| 4 * c), "triangle {i}");
            let plane = |corner: &Corner| (0..3).map(|k| corner.position[k] * own[k]).sum::<i8>();
            assert!(triangle.iter().all(|corner| plane(corner) == 1), "triangle {i}");
            total = [0, 1, 2].map(|k| total[k] + outwards[k]);
        }
        assert_eq!(total, [0; 3]);
    }
}
