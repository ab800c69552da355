"""Trees of geometry nodes, written as expressions."""

from typing import Any

import bpy

Socket = bpy.types.NodeSocket


class Tree:
    """A tree of geometry nodes under construction."""

    def __init__(self, name: str) -> None:
        self.tree = bpy.data.node_groups.new(name, "GeometryNodeTree")
        interface = self.tree.interface
        interface.new_socket("Geometry", in_out="INPUT", socket_type="NodeSocketGeometry")
        interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
        self.geometry = self.tree.nodes.new("NodeGroupInput").outputs[0]

    def end(self, geometry: Socket) -> bpy.types.NodeTree:
        """Ends the tree with its result."""
        self.tree.links.new(geometry, self.tree.nodes.new("NodeGroupOutput").inputs[0])
        for at, node in enumerate(self.tree.nodes):
            node.location = 200 * (at % 12), -260 * (at // 12)
        return self.tree

    def node(self, kind: str, settings: dict[str, Any] | None = None, **inputs: Any) -> bpy.types.Node:
        """Adds a node. An input is a socket, or a value; its name is that of the socket, with _ for spaces."""
        node = self.tree.nodes.new(kind)
        for key, value in (settings or {}).items():
            setattr(node, key, value)
        for name, value in inputs.items():
            self.put(self.find(node.inputs, name.replace("_", " ")), value)
        return node

    def put(self, socket: Socket, value: Any) -> None:
        """Gives an input another socket, or a value."""
        if isinstance(value, Socket):
            self.tree.links.new(value, socket)
        else:
            socket.default_value = value

    @staticmethod
    def find(sockets: Any, name: str) -> Socket:
        """Returns the socket in use with a name; a node has one of a name for each type of data."""
        return next(socket for socket in sockets if socket.name == name and socket.enabled)

    def out(self, node: bpy.types.Node, name: str) -> Socket:
        """Returns an output of a node."""
        return self.find(node.outputs, name)

    def math(self, operation: str, *given: Any) -> Socket:
        """Returns the result of an operation on numbers."""
        node = self.node("ShaderNodeMath", {"operation": operation})
        for socket, value in zip(node.inputs, given, strict=False):
            self.put(socket, value)
        return node.outputs[0]

    def attribute(self, name: str, kind: str) -> Socket:
        """Returns an attribute of the geometry."""
        node = self.node("GeometryNodeInputNamedAttribute", {"data_type": kind}, Name=name)
        return self.out(node, "Attribute")

    def sample(self, geometry: Socket, kind: str, value: Socket, index: Socket) -> Socket:
        """Returns the value of a field at a point of another geometry."""
        node = self.node("GeometryNodeSampleIndex", {"data_type": kind, "domain": "POINT", "clamp": True})
        self.put(node.inputs["Geometry"], geometry)
        self.put(self.find(node.inputs, "Value"), value)
        self.put(self.find(node.inputs, "Index"), index)
        return self.out(node, "Value")

    def mix(self, kind: str, a: Socket, b: Socket, share: Any) -> Socket:
        """Returns what is a share of the way from a to b: of vectors on a line, of rotations by the shorter turn."""
        node = self.node("ShaderNodeMix", {"data_type": kind})
        for name, value in (("Factor", share), ("A", a), ("B", b)):
            self.put(self.find(node.inputs, name), value)
        return self.out(node, "Result")
