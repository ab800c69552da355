"""Draws what tests/all/drawings.rs reads, with ezdxf (https://ezdxf.mozman.at), and prints the areas, m²: python ezdxf.py > areas

ezdxf.dxf, beside this file, is the header's unit and the entities of what is drawn.
"""

import io
import math
from pathlib import Path

import ezdxf
from ezdxf.path import from_hatch, make_path

drawing = ezdxf.new("R2010")
drawing.units = 6  # metres
space = drawing.modelspace()
floor = {"layer": "floor"}

closed = space.add_spline(dxfattribs=floor)
closed.set_closed_rational([(20, 0, 0), (26, 0, 0), (28, 4, 0), (23, 7, 0), (19, 4, 0)], [1, 2, 1, 3, 1])
opened = space.add_open_spline([(40, 0, 0), (44, 6, 0), (48, 8, 0), (50, 0, 0)], dxfattribs=floor)
space.add_line((50, 0), (40, 0), dxfattribs=floor)

paths = space.add_hatch(dxfattribs=floor).paths
paths.add_polyline_path([(60, 0, 0), (68, 0, 0.5), (68, 6, 0), (60, 6, -0.3)], is_closed=True, flags=1)
paths.add_polyline_path([(62, 2), (64, 2), (64, 4), (62, 4)], is_closed=True, flags=16)


def edges():
    return space.add_hatch(dxfattribs=floor).paths.add_edge_path()


path = edges()
path.add_line((80, 0), (90, 0))
path.add_arc((90, 3), 3, 270, 450, ccw=True)
path.add_ellipse((85, 6), (5, 0), 0.4, 0, 180, ccw=True)
path.add_line((80, 6), (80, 0))

path = edges()
path.add_line((100, 0), (110, 0))
path.add_line((110, 0), (110, 6))
path.add_arc((105, 6), 5, 180, 360, ccw=False)
path.add_line((100, 6), (100, 0))

path = edges()
path.add_line((120, 0), (130, 0))
bezier = [(130, 0), (132, 6), (124, 2), (120, 8)]
path.add_spline(control_points=bezier, degree=3, knot_values=[0, 0, 0, 0, 1, 1, 1, 1])
path.add_line((120, 8), (120, 0))

path = edges()
ellipse = ezdxf.math.ConstructionEllipse(center=(150, 5), major_axis=(4, 3), ratio=0.5, start_param=0.4, end_param=2.9)
start, end = (math.degrees(math.atan2(math.sin(t) * 0.5, math.cos(t))) for t in (0.4, 2.9))
path.add_ellipse((150, 5), (4, 3), 0.5, start, end, ccw=True)
path.add_line(ellipse.end_point.vec2, ellipse.start_point.vec2)

below = space.add_ellipse((170, 5), (6, 0), 0.5, 0.3, 2.5, dxfattribs={**floor, "extrusion": (0, 0, -1)})
ends = below.construction_tool()
space.add_line(ends.end_point, ends.start_point, dxfattribs=floor)


def area(points):
    return abs(sum(a.x * b.y - a.y * b.x for a, b in zip(points, points[1:] + points[:1]))) / 2


def of(path):
    return area(list(path.flattening(1e-6)))


curve = closed.construction_tool()  # of which ezdxf flattens more than the parameters from the third knot to the eighth
areas = [area([curve.point(3 + 5 * k / 200_000) for k in range(200_000)]), of(make_path(opened))]
for hatch in space.query("HATCH"):
    outer, *islands = (of(path) for path in from_hatch(hatch))
    areas.append(outer - sum(islands))
print([*areas, of(make_path(below))])

whole = io.StringIO()
drawing.write(whole)
text = whole.getvalue()
begin = text.index("ENTITIES")
entities = text[begin : text.index("ENDSEC", begin)]
head = "  0\nSECTION\n  2\nHEADER\n  9\n$INSUNITS\n 70\n6\n  0\nENDSEC\n  0\nSECTION\n  2\n"
Path(__file__).with_suffix(".dxf").write_text(head + entities + "ENDSEC\n  0\nEOF\n")
