//! The triangles around each vertex of a mesh.

/// A list of triangles for each vertex.
#[derive(Clone, Debug)]
pub(super) struct Fans {
    /// The start of each vertex's triangles, and the end of the last list.
    starts: Vec<u32>,
    triangles: Vec<u32>,
}

impl Fans {
    /// Creates the lists from the corners of the triangles.
    pub fn new(vertices: usize, corners: &[[u32; 3]]) -> Self {
        let mut starts = vec![0; vertices + 1];
        for &vertex in corners.as_flattened() {
            starts[vertex as usize] += 1;
        }
        let mut end = 0;
        for start in &mut starts {
            end += *start;
            *start = end;
        }
        // from the last to the first, so that each list is in order
        let mut triangles = vec![0; corners.len() * 3];
        for (triangle, corners) in corners.iter().enumerate().rev() {
            for &vertex in corners {
                let start = &mut starts[vertex as usize];
                *start -= 1;
                triangles[*start as usize] = triangle as u32;
            }
        }
        Self { starts, triangles }
    }

    /// Returns the triangles around a vertex, in order.
    pub fn round(&self, vertex: u32) -> &[u32] {
        let vertex = vertex as usize;
        &self.triangles[self.starts[vertex] as usize..self.starts[vertex + 1] as usize]
    }
}
