//! What a tree knows of the vertices that it has reached. Most trees reach a small part of a large mesh, so the memory is
//! in pages that are allocated when first needed.

use super::triangulate::NONE;

/// Vertices in a page.
const PAGE: usize = 64;

/// The shortest known path from a vertex.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reached {
    /// Its length; infinite if none is known.
    pub length: f64,
    /// The next vertex on it; [`NONE`] for the target.
    pub next: u32,
}

impl Reached {
    const NOT: Self = Self { length: f64::INFINITY, next: NONE };
}

/// The shortest known path from each vertex of a mesh.
#[derive(Clone, Debug)]
pub(super) struct ReachedVertices {
    pages: Vec<Option<Box<[Reached; PAGE]>>>,
    /// The number of pages in memory.
    allocated: usize,
}

impl ReachedVertices {
    /// Creates the paths of this number of vertices, none of them known yet.
    pub fn new(vertices: usize) -> Self {
        Self { pages: vec![None; vertices.div_ceil(PAGE)], allocated: 0 }
    }

    /// Returns the size of the memory, bytes.
    pub fn bytes(&self) -> usize {
        self.pages.len() * size_of::<Option<Box<Reached>>>() + self.allocated * size_of::<[Reached; PAGE]>()
    }

    /// Returns the shortest known path from a vertex.
    pub fn of(&self, vertex: u32) -> Reached {
        let (page, at) = (vertex as usize / PAGE, vertex as usize % PAGE);
        self.pages[page].as_ref().map_or(Reached::NOT, |page| page[at])
    }

    /// Returns the shortest known path from a vertex, to be changed.
    pub fn of_mut(&mut self, vertex: u32) -> &mut Reached {
        let (page, at) = (vertex as usize / PAGE, vertex as usize % PAGE);
        let page = self.pages[page].get_or_insert_with(|| {
            self.allocated += 1;
            Box::new([Reached::NOT; PAGE])
        });
        &mut page[at]
    }
}
