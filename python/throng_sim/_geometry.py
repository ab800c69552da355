"""Shapes of other libraries as the shapes of scenes.

A shape is anything with `__geo_interface__` (shapely, geopandas), a GeoJSON dict, or WKT text.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

KINDS = ("Polygon", "MultiPolygon", "GeometryCollection", "Feature", "FeatureCollection", "Point", "LineString", "LinearRing")


def is_geometry(given: Any) -> bool:
    """Whether it is a shape of shapely or the like."""
    return hasattr(given, "__geo_interface__")


def mapping(given: Any) -> Mapping[str, Any]:
    """Returns a shape as GeoJSON."""
    if hasattr(given, "__geo_interface__"):
        shape: Mapping[str, Any] = given.__geo_interface__
        return shape
    if isinstance(given, Mapping) and given.get("type") in KINDS:
        return given
    if isinstance(given, str):
        return _wkt(given)
    kinds = "a shape with __geo_interface__ such as shapely's, GeoJSON, or WKT"
    raise TypeError(f"a {type(given).__name__} is not a shape: give {kinds}")


def _wkt(text: str) -> Mapping[str, Any]:
    try:
        import shapely
    except ImportError:
        raise ImportError("WKT text needs shapely: pip install shapely") from None
    try:
        return mapping(shapely.from_wkt(text))
    except shapely.errors.ShapelyError as error:
        raise ValueError(f"this is not WKT: {error}") from None


def polygons(given: Any) -> list[list[list[list[float]]]]:
    """Returns the polygons of a shape: the outline of each, then its holes, without the repeated last corner."""
    shape = mapping(given)
    match shape["type"]:
        case "Polygon":
            return [[_ring(ring) for ring in shape["coordinates"]]]
        case "MultiPolygon":
            return [[_ring(ring) for ring in polygon] for polygon in shape["coordinates"]]
        case "GeometryCollection":
            return [polygon for part in shape["geometries"] for polygon in polygons(part)]
        case "Feature":
            return polygons(shape["geometry"])
        case "FeatureCollection":
            return [polygon for part in shape["features"] for polygon in polygons(part)]
        case kind:
            raise ValueError(f"the shape is a {kind}, but must be an area: a Polygon or MultiPolygon")


def area(given: Any) -> dict[str, Any]:
    """Returns a shape without holes as the region of a scene."""
    found = polygons(given)
    if len(found) != 1 or len(found[0]) != 1:
        parts, holes = len(found), sum(len(polygon) - 1 for polygon in found)
        raise ValueError(f"the shape has {parts} parts and {holes} holes, but must be one polygon without holes here")
    return {"polygon": found[0][0]}


def _ring(ring: Any) -> list[list[float]]:
    corners = [[float(corner[0]), float(corner[1])] for corner in ring]
    return corners[:-1] if len(corners) > 1 and corners[0] == corners[-1] else corners
