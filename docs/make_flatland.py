#!/usr/bin/env python3
"""Draws docs/images/flatland.svg: a path in a room of two dimensions, with the light that arrives at its vertices.

Usage: make_flatland.py

The colors of the cells are computed: rays through each cell gather the light that one lamp and three bounces bring.
"""
import math
from pathlib import Path

TARGET = Path(__file__).resolve().parent / "images" / "flatland.svg"
ALBEDO = 0.6
RAYS = 16  # per cell of a drawn hemisphere; half as many for each bounce
CELLS = 14
LAMP = ((400, 40), (480, 40))
# Walls of the room, seen from within, and a board that hangs from its ceiling.
WALLS = [((40, 40), (400, 40)), LAMP, ((480, 40), (560, 40)), ((560, 40), (560, 330)), ((560, 330), (40, 330)), ((40, 330), (40, 40)),
         ((300, 40), (300, 210)), ((300, 210), (310, 210)), ((310, 210), (310, 40))]
CAMERA, X, Y, Z = (78, 120), (190, 330), (560, 226), (446, 40)
STATE, ACTION, REWARD, VALUE = "#1f5fa8", "#b4370f", "#b58900", "#16796f"


def meet(origin, direction):
    """Nearest wall along a ray, and where."""
    nearest, wall = math.inf, None
    for (ax, ay), (bx, by) in WALLS:
        ex, ey = bx - ax, by - ay
        cross = direction[0] * ey - direction[1] * ex
        if abs(cross) < 1e-12:
            continue
        ox, oy = ax - origin[0], ay - origin[1]
        t, s = (ox * ey - oy * ex) / cross, (ox * direction[1] - oy * direction[0]) / cross
        if 1e-6 < t < nearest and 0 <= s <= 1:
            nearest, wall = t, ((ax, ay), (bx, by))
    return (origin[0] + nearest * direction[0], origin[1] + nearest * direction[1]), wall


def normal_of(wall, towards):
    """Unit normal of a wall on the side that a direction comes from."""
    (ax, ay), (bx, by) = wall
    nx, ny = ay - by, bx - ax
    length = math.copysign(math.hypot(nx, ny), nx * towards[0] + ny * towards[1])
    return -nx / length, -ny / length


def direction_at(normal, s):
    """Direction whose sine to the normal is s, from -1 to 1: equal steps of s have equal projected angles."""
    c = math.sqrt(1 - s * s)
    return normal[0] * c - normal[1] * s, normal[1] * c + normal[0] * s


def radiance(origin, direction, bounces):
    point, wall = meet(origin, direction)
    if wall == LAMP:
        return 1.0
    if wall is None or bounces == 0:
        return 0.0
    normal, rays = normal_of(wall, direction), RAYS // 2
    arriving = [radiance(point, direction_at(normal, (2 * i + 1) / rays - 1), bounces - 1) for i in range(rays)]
    return ALBEDO * sum(arriving) / rays


def cells(point, normal):
    """Mean radiance that arrives through each cell."""
    def mean(cell):
        inside = [2 * (cell + (i + 0.5) / RAYS) / CELLS - 1 for i in range(RAYS)]
        return sum(radiance(point, direction_at(normal, s), 3) for s in inside) / RAYS
    return [mean(cell) for cell in range(CELLS)]


def color(value, lowest, highest):
    """Logarithmic, from dark blue to yellow."""
    stops = [(44, 24, 84), (0, 80, 120), (20, 150, 140), (150, 210, 120), (252, 236, 120)]
    place = math.log(max(value, lowest) / lowest) / math.log(highest / lowest) * (len(stops) - 1)
    i = min(int(place), len(stops) - 2)
    return "#" + "".join(f"{round(a + (b - a) * (place - i)):02x}" for a, b in zip(stops[i], stops[i + 1]))


def hemisphere(point, normal, radius, chosen=None):
    values, shapes = cells(point, normal), []
    for cell, value in enumerate(values):
        (ax, ay), (bx, by) = (direction_at(normal, 2 * s / CELLS - 1) for s in (cell, cell + 1))
        path = (f"M{point[0]} {point[1]} L{point[0] + radius * ax:.1f} {point[1] + radius * ay:.1f} "
                f"A{radius} {radius} 0 0 1 {point[0] + radius * bx:.1f} {point[1] + radius * by:.1f} Z")
        edge = f'stroke="{ACTION}" stroke-width="2.5"' if cell == chosen else 'stroke="#fff" stroke-width="0.7"'
        shapes.append((cell == chosen, f'<path d="{path}" fill="{color(value, 0.004, 1)}" {edge}/>'))
    return "\n".join(shape for _, shape in sorted(shapes))


def line(a, b, stroke, width, extra=""):
    return f'<line x1="{a[0]}" y1="{a[1]}" x2="{b[0]}" y2="{b[1]}" stroke="{stroke}" stroke-width="{width}" {extra}/>'


def text(x, y, words, fill="#222", extra=""):
    return f'<text x="{x}" y="{y}" fill="{fill}" {extra}>{words}</text>'


def chosen_cell():
    """The cell of X that Y lies in."""
    dx, dy = Y[0] - X[0], Y[1] - X[1]
    return int((dx / math.hypot(dx, dy) + 1) / 2 * CELLS)


def drawing():
    arrow = 'marker-end="url(#arrow)"'
    parts = [
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 820 370" font-family="sans-serif" font-size="15">',
        '<defs><marker id="arrow" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" orient="auto">'
        f'<path d="M0 0 L8 4 L0 8 Z" fill="{ACTION}"/></marker></defs>',
        '<rect width="820" height="370" rx="8" fill="#fff"/>',
        hemisphere(X, (0, -1), 96, chosen_cell()),
        hemisphere(Y, (-1, 0), 62),
        *(line(a, b, "#444", 4, 'stroke-linecap="round"') for a, b in WALLS),
        line(*LAMP, "#f2b600", 9),
        line(CAMERA, X, "#666", 1.5, 'stroke-dasharray="5 4"'),
        line(X, Y, ACTION, 2.5, arrow),
        line(Y, Z, "#666", 1.5, 'stroke-dasharray="5 4"'),
        f'<path d="M{CAMERA[0]} {CAMERA[1]} l-22 -12 v24 z" fill="#444"/>',
        *(f'<circle cx="{x}" cy="{y}" r="5" fill="{STATE}"/>' for x, y in (X, Y)),
        text(52, 92, "camera"),
        text(414, 66, "lamp"),
        text(X[0] - 12, X[1] + 24, "x: state", STATE),
        text(Y[0] + 12, Y[1] + 5, "y: next state", STATE),
        text(378, 300, "&#969;: action, a cell of x", ACTION),
        text(575, 62, "L&#8337;(y): reward, 0 here;", REWARD),
        text(575, 82, "the lamp pays one step later", REWARD),
        text(575, 262, "V(y): value, the mean", VALUE),
        text(575, 282, "of the cells of y", VALUE),
        text(300, X[1] + 24, "Q(x, &#969;): value of each action, the color of its cell", VALUE),
        "</svg>"]
    return "\n".join(parts) + "\n"


if __name__ == "__main__":
    TARGET.write_text(drawing())
