"""The meshes of people: shared by build, look and level of detail."""

import bpy
import numpy as np
from throng_sim import figure

COLOR = "Color"
"""The attribute with the colours of vertices."""


def material(name: str, color: tuple[float, float, float] | None = None, roughness: float = 0.85) -> bpy.types.Material:
    """Returns the material of this name; a new one has the colour, or the colours of vertices."""
    known = bpy.data.materials.get(name)
    if known is not None:
        return known
    made = bpy.data.materials.new(name)
    tree = with_nodes(made)
    surface = next(node for node in tree.nodes if node.type == "BSDF_PRINCIPLED")
    surface.inputs["Roughness"].default_value = roughness
    if color is None:
        colors = tree.nodes.new("ShaderNodeVertexColor")
        colors.layer_name = COLOR
        colors.location = surface.location.x - 220, surface.location.y
        tree.links.new(colors.outputs["Color"], surface.inputs["Base Color"])
    else:
        surface.inputs["Base Color"].default_value = made.diffuse_color = (*color, 1)
    return made


def with_nodes(owner: bpy.types.Material | bpy.types.World) -> bpy.types.NodeTree:
    """Returns the nodes of a material or a world, which new ones have from Blender 5.0 on."""
    if bpy.app.version < (5, 0):
        owner.use_nodes = True
    return owner.node_tree


def colors(body: figure.Mesh, look: int) -> np.ndarray:
    """Returns the colours of the vertices with a look: sRGB from 0 to 1, with an alpha."""
    palette = figure.colors(look)[body.regions] / 255
    return np.concatenate([palette, np.ones((len(palette), 1))], axis=1).astype(np.float32)


def paint(mesh: bpy.types.Mesh, colors: np.ndarray) -> None:
    """Gives each vertex a colour."""
    layer = mesh.color_attributes.get(COLOR) or mesh.color_attributes.new(COLOR, "BYTE_COLOR", "POINT")
    layer.data.foreach_set("color_srgb", colors.ravel())


def shape(name: str, positions: np.ndarray, triangles: np.ndarray) -> bpy.types.Mesh:
    """Returns a smooth mesh of triangles."""
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(positions))
    mesh.vertices.foreach_set("co", positions.astype(np.float32).ravel())
    mesh.loops.add(triangles.size)
    mesh.loops.foreach_set("vertex_index", triangles.astype(np.int32).ravel())
    mesh.polygons.add(len(triangles))
    mesh.polygons.foreach_set("loop_start", np.arange(0, triangles.size, 3, dtype=np.int32))
    mesh.update(calc_edges=True)
    mesh.polygons.foreach_set("use_smooth", np.ones(len(triangles), bool))
    mesh.validate()
    return mesh


def rest(build: str) -> np.ndarray:
    """Returns where the joints of a build are at rest, for a height of 1 m: (19, 3)."""
    places = figure.skeleton(build).copy()
    for joint, parent in enumerate(figure.PARENTS):
        if parent >= 0:
            places[joint] += places[parent]
    return places
