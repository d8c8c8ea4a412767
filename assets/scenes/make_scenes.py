#!/usr/bin/env python3
"""Writes the scenes of this folder but those that are published: NAME/NAME.obj, .mtl and .json, and their images.

    make_scenes.py            write all of them
    make_scenes.py --check    compare with the files on disk; exit code 1 if anything differs

Shapes are built from `room` (a box seen from inside), `box` (seen from outside), `slab` (a polygon in the ground plane
with a height) and `quad`. Unit: meter unless a scene sets another; +y is up. Bodies on a surface have no bottom face, as
in `cornell`; lamps are 2 mm in front of walls, so that no two surfaces coincide. Curved
shapes are in scene_shapes.py, the three scenes made of them in picture_scenes.py.
"""
import math
import sys
from pathlib import Path

from picture_scenes import bar, living_room, still_life
from scene_files import BLACK, CLEAR, Scene, hdr, png, turned_y

FOLDER = Path(__file__).resolve().parent


def shelter():
    s = Scene("shelter", "Shelter",
              "three lamps behind boards and pillars in a large sealed room",
              "A sealed 4 x 4 x 6 room with a roof on four pillars. Three lamps on the walls, a board in front of each.",
              ([-1, -0.2, 0.9], [-1, 0.35, -4], [0, 1, 0], 60),
              {"white": (0.75, None), "blue": ((0.15, 0.15, 0.75), None), "red": ((0.75, 0.15, 0.15), None),
               "lamp": (BLACK, 8)})
    s.room((-3, -0.95, -5), (1, 3.05, 1), "white")
    s.group("lamps")
    left, right, back = -3 + CLEAR, 1 - CLEAR, -5 + CLEAR
    s.quad([(left, 0, -3), (left, 0, -4), (left, 1, -4), (left, 1, -3)], "lamp")
    s.quad([(right, 0, -4), (right, 0, -3), (right, 1, -3), (right, 1, -4)], "lamp")
    s.quad([(-1.5, 0, back), (-0.5, 0, back), (-0.5, 1, back), (-1.5, 1, back)], "lamp")
    s.group("roof")
    s.box((-2, 0.9, -4.2), (0, 1.1, -2.2), "white")
    s.group("pillars", "from the floor to 1 cm into the roof")
    for x in (-2, -0.2):
        for z in (-4.2, -2.4):
            s.box((x + 0.005, -0.95, z + 0.005), (x + 0.195, 0.91, z + 0.195), "white", ("bottom", "top"))
    s.group("cubes")
    s.transform = turned_y(25, (-1, -3.2))
    s.box((-1.4, -0.95, -3.6), (-0.6, -0.15, -2.8), "blue", ("bottom",))
    s.transform = turned_y(-20, (-1.3, -2.7))
    s.box((-1.475, 1.1, -2.875), (-1.125, 1.45, -2.525), "red", ("bottom",))
    s.transform = lambda p: p
    gap = 0.3
    s.group("left-board")
    s.box((-3 + gap, -0.1, -4.1), (-3 + gap + 0.05, 1.1, -2.9), "white")
    s.group("right-board")
    s.box((1 - gap - 0.05, -0.1, -4.1), (1 - gap, 1.1, -2.9), "white")
    s.group("back-board")
    s.box((-1.6, -0.1, -5 + gap), (-0.4, 1.1, -5 + gap + 0.05), "white")
    s.knob("blockers", gap, [0.05, 0.7], "distance between each lamp's wall and the board in front of it, in meters",
           moves=[{"groups": ["left-board"], "by": [1, 0, 0]}, {"groups": ["right-board"], "by": [-1, 0, 0]},
                  {"groups": ["back-board"], "by": [0, 0, 1]}])
    return s


def pillars():
    s = Scene("pillars", "Pillars",
              "two glowing pillars between dark walls: absorbing paths, high contrast",
              "A sealed 4 x 4 x 6 room with dark long walls. Pillars and blocks stand out of its end wall; two pillars glow.",
              ([-1, 1, 0.4], [-1, 1, -5], [0, 1, 0], 53.1301),
              {"dark": (0.1, None), "light": (0.9, None), "red": ((0.9, 0.15, 0.15), None), "lamp": (BLACK, 12)},
              settings={"exposure": -1})
    s.room((-3, -0.95, -5), (1, 3.05, 1), {"": "dark", "front": "light", "back": "light"})
    s.group("pillars", "two columns of five, one in the middle; they have no face on the end wall")
    for column, x in enumerate((-2.76, 0.35)):
        for row in range(5):
            y = -0.75 + 0.8 * row
            glows = (column, row) in ((0, 4), (1, 0))
            s.box((x, y, -5), (x + 0.4, y + 0.4, -3.86), "lamp" if glows else "light", ("back",))
    s.box((-1.2, 0.85, -5), (-0.8, 1.25, -3.86), "light", ("back",))
    s.group("blocks")
    s.box((-2.15, -0.6, -5), (-0.95, 0.6, -3.86), "red", ("back",))
    s.box((-1.05, 1.5, -5), (0.15, 2.7, -3.86), "light", ("back",))
    s.knob("albedo", 0.1, [0, 0.9], "reflectance of the four long walls", albedo=["dark"])
    return s


CORNELL = {"white": ((0.725, 0.71, 0.68), None), "red": ((0.63, 0.065, 0.05), None),
           "green": ((0.14, 0.45, 0.091), None), "light": (BLACK, (17, 12, 4))}
CORNELL_CAMERA = ([278, 273, -800], [278, 273, 0], [0, 1, 0], 39.3077)
SHORT_BLOCK = (165, ((130, 65), (82, 225), (240, 272), (290, 114)))
TALL_BLOCK = (330, ((423, 247), (265, 296), (314, 456), (472, 406)))


def cornell_walls(s):
    s.group("box", "right and left as seen by the camera, which looks along +z")
    s.mesh([(552.8, 0, 0), (0, 0, 0), (0, 0, 559.2), (549.6, 0, 559.2), (556, 548.8, 0), (556, 548.8, 559.2),
            (0, 548.8, 559.2), (0, 548.8, 0)],
           [("white", (0, 1, 2, 3)), ("white", (4, 5, 6, 7)), ("white", (3, 2, 6, 5)), ("green", (2, 1, 7, 6)),
            ("red", (0, 3, 5)), ("red", (0, 5, 4))])


def cornell_light(s):
    s.group("light")
    s.quad([(343, 548.3, 227), (343, 548.3, 332), (213, 548.3, 332), (213, 548.3, 227)], "light")


def cornell_block(s, block, material):
    top, ground = block
    s.mesh([(x, y, z) for y in (top, 0) for x, z in ground],
           [(material, (0, 1, 2, 3))] + [(material, (i, i + 4, (i + 1) % 4 + 4, (i + 1) % 4)) for i in range(4)])


def indirect():
    s = Scene("indirect", "Cornell box, lit by its ceiling",
              "the Cornell box, its light in a tray under the ceiling, facing up",
              "The measured Cornell box (see ../cornell) with its light in a tray under the ceiling, facing upwards.",
              CORNELL_CAMERA, CORNELL, unit="millimeter",
              settings={"exposure": 1.5})
    cornell_walls(s)
    for name, block in (("short_block", SHORT_BLOCK), ("tall_block", TALL_BLOCK)):
        s.group(name)
        cornell_block(s, block, "white")
    s.group("shade", "an open tray, 40 high, with walls of 5; the light lies on its ground")
    rim = 548.8 - 60
    tray(s, (193, rim - 40, 207), (363, rim, 352), 5, "white")
    s.group("light")
    y = rim - 40 + 5 + 0.5
    s.quad([(213, y, 227), (213, y, 332), (343, y, 332), (343, y, 227)], "light")
    s.knob("gap", 60, [5, 150], "space between the shade's rim and the ceiling, in millimeters",
           moves=[{"groups": ["shade", "light"], "by": [0, -1, 0]}])
    return s


def tray(s, low, high, wall, material):
    """A box without a lid: outside, inside and the rim, in one closed body."""
    inner_low = [low[k] + wall for k in range(3)]
    inner_high = [high[0] - wall, high[1], high[2] - wall]
    points = [tuple((b if i >> k & 1 else a)[k] for k in range(3))
              for a, b in ((low, high), (inner_low, inner_high)) for i in range(8)]
    outer = [(material, c) for side, c in Scene.SIDES.items() if side != "top"]
    inner = [(material, tuple(i + 8 for i in c[::-1])) for side, c in Scene.SIDES.items() if side != "top"]
    ring = Scene.SIDES["top"]
    rim = [(material, (ring[i], ring[(i + 1) % 4], ring[(i + 1) % 4] + 8, ring[i] + 8)) for i in range(4)]
    s.mesh(points, outer + inner + rim)


def labyrinth():
    s = Scene("labyrinth", "Labyrinth",
              "a folded corridor with four bends, a small lamp at its end: light that is many bounces away",
              "A sealed corridor, 1 wide and folded twice, so four bends; a small lamp at its far end.",
              ([-1.1, 0.85, -0.12], [0.45, 0.7, -0.75], [0, 1, 0], 75),
              {"white": (0.9, None), "red": ((0.9, 0.55, 0.45), None), "blue": ((0.5, 0.65, 0.9), None),
               "floor": (0.7, None), "lamp": (BLACK, 50)}, settings={"exposure": 1})
    s.room((-1.3, 0, -3), (1.3, 1.5, 0), {"": "white", "left": "blue", "right": "red", "bottom": "floor"})
    s.group("lamp")
    x = 1.3 - CLEAR
    s.quad([(x, 0.45, -2.8), (x, 0.45, -2.2), (x, 1.05, -2.2), (x, 1.05, -2.8)], "lamp")
    gap, scales = 0.9, []
    for i, z in enumerate((-1, -2)):
        name, from_left = f"baffle-{i + 1}", i % 2 == 0
        s.group(name, "from wall to passage, floor to ceiling: faces where it borders air only")
        low, high = (-1.3, 1.3 - gap) if from_left else (-1.3 + gap, 1.3)
        s.box((low, 0, z - 0.05), (high, 1.5, z + 0.05), "white", ("top", "bottom", "left" if from_left else "right"))
        scales.append({"groups": [name], "about": [-1.3 if from_left else 1.3, 0, z],
                       "by": [round(-1 / (2.6 - gap), 9), 0, 0]})
    s.knob("gap", gap, [0.1, 2], "width of the passages from one lane to the next, in meters", scales=scales)
    return s


def thin_wall():
    s = Scene("thin-wall", "Thin wall",
              "a thin wall between a bright and a dark half: volumes of one side must not serve the other",
              "A sealed room whose halves are parted by a thin wall, open at the camera's end. The lamp is in the right half.",
              ([-0.6, 1.3, -0.12], [-0.3, 1.05, -4], [0, 1, 0], 82),
              {"white": (0.75, None), "orange": ((0.8, 0.45, 0.2), None), "blue": ((0.35, 0.5, 0.8), None),
               "lamp": (BLACK, 20)})
    s.room((-2, 0, -4), (2, 2.5, 0), {"": "white", "left": "blue"})
    s.group("lamp")
    y = 2.5 - CLEAR
    s.quad([(0.6, y, -3.2), (1.4, y, -3.2), (1.4, y, -2.4), (0.6, y, -2.4)], "lamp")
    thickness = 0.02
    s.group("wall", "floor to ceiling, from the end wall to 1.1 before the camera's wall")
    s.box((-thickness / 2, 0, -4), (thickness / 2, 2.5, -1.1), "white", ("top", "bottom", "back"))
    s.group("cube")
    s.transform = turned_y(30, (-1, -2.6))
    s.box((-1.3, 0, -2.9), (-0.7, 0.6, -2.3), "orange", ("bottom",))
    s.transform = lambda p: p
    s.knob("thickness", thickness, [0.001, 0.5], "of the wall, in meters",
           scales=[{"groups": ["wall"], "about": [0, 0, 0], "by": [1 / thickness, 0, 0]}])
    return s


def two_lights():
    s = Scene("two-lights", "Two lights",
              "a table between two equal lamps: two directions matter alike",
              "A sealed dark room; two small lamps of equal power face each other across a table.",
              ([0, 1.5, 2.8], [0, 0.75, -1], [0, 1, 0], 55),
              {"gray": (0.4, None), "white": (0.8, None), "housing": (0.2, None), "lamp": (BLACK, 60)})
    s.room((-3.2, 0, -2), (3.2, 2.5, 3), "gray")
    s.group("table", "without the face on the floor")
    s.box((-0.4, 0, -0.8), (0.4, 0.7, 0), "white", ("bottom",))
    s.group("ball", "an octahedron that stands clear of the table")
    top, low, middle = 1.32, 0.72, 1.02
    s.mesh([(0, top, -0.4), (0.3, middle, -0.4), (0, middle, -0.1), (-0.3, middle, -0.4), (0, middle, -0.7),
            (0, low, -0.4)],
           [("white", (0, b, a)) for a, b in ((1, 2), (2, 3), (3, 4), (4, 1))] +
           [("white", (5, a, b)) for a, b in ((1, 2), (2, 3), (3, 4), (4, 1))])
    separation = 3
    for name, side in (("left", -1), ("right", 1)):
        s.group(name + "-lamp", "it glows on the side that looks at the table")
        x = side * separation / 2
        low, high = sorted((x, x + side * 0.05))
        s.box((low, 1.1, -0.525), (high, 1.35, -0.275), {"": "housing", "right" if side < 0 else "left": "lamp"})
    s.knob("separation", separation, [1, 6], "distance between the two lamps, in meters",
           moves=[{"groups": ["left-lamp"], "by": [-0.5, 0, 0]}, {"groups": ["right-lamp"], "by": [0.5, 0, 0]}])
    return s


def boxed_lights():
    s = Scene("boxed-lights", "Boxed lights",
              "twenty small boxes, a lamp in each, three of them face the viewer: many lights, mostly hidden",
              "A sealed room with twenty small boxes, a lamp at the bottom of each and a lid ajar. Three face the viewer.",
              ([0.15, 2.1, 1.9], [0, 0.1, -0.8], [0, 1, 0], 58),
              {"white": (0.7, None), "wood": ((0.6, 0.42, 0.25), None), "lid": ((0.3, 0.4, 0.65), None),
               "lamp": (BLACK, 60)})
    s.room((-2.2, 0, -2.6), (2.2, 2.4, 2), "white")
    # Direction of the opening: + up, b back, f to the viewer, l and r to the sides.
    facing = ["b+lrb", "lbfb+", "brb+l", "f+blf"]
    lid, turns = 50, []
    for row, line in enumerate(facing):
        for column, way in enumerate(line):
            name = f"lid-{row + 1}{column + 1}"
            center = (-1.6 + 0.8 * column, -2.0 + 0.8 * row)
            turns.append(boxed_light(s, name, center, way, lid))
    s.knob("lid", lid, [2, 120], "angle by which the lids are open, in degrees", turns=turns)
    return s


def boxed_light(s, name, center, way, lid):
    """One box, its lamp and its lid; returns the turn that opens the lid further."""
    half, wall = 0.15, 0.02

    def place(p):
        """Maps points of a box that opens upwards, with its hinge at -z, on the floor."""
        x, y, z = p
        if way != "+":  # tilt: up becomes +z, the hinge comes to the top
            x, y, z = x, half - z, y - half
            c, q = {"f": (1, 0), "b": (-1, 0), "r": (0, 1), "l": (0, -1)}[way]
            x, z = c * x + q * z, -q * x + c * z
        return (center[0] + x, 0.001 + y, center[1] + z)

    s.group(name.replace("lid", "box"))
    s.transform = place
    tray(s, (-half, 0, -half), (half, 2 * half, half), wall, "wood")
    s.quad([(-0.08, wall + CLEAR, 0.08), (0.08, wall + CLEAR, 0.08), (0.08, wall + CLEAR, -0.08),
            (-0.08, wall + CLEAR, -0.08)], "lamp")
    s.group(name)
    hinge = (0, 2 * half + 0.001, -half)
    c, q = math.cos(math.radians(lid)), math.sin(math.radians(lid))

    def opened(p):
        y, z = p[1] - hinge[1], p[2] - hinge[2]
        return place((p[0], hinge[1] + c * y + q * z, hinge[2] - q * y + c * z))

    s.transform = opened
    s.box((-half, hinge[1], -half), (half, hinge[1] + 0.015, half), "lid")
    s.transform = lambda p: p
    origin = place((0, 0, 0))
    along = place((-1, 0, 0))
    return {"groups": [name], "about": [round(x, 6) for x in place(hinge)],
            "axis": [round(along[k] - origin[k], 6) for k in range(3)], "by_deg": 1}


def staircase():
    s = Scene("staircase", "Staircase",
              "three storeys joined by stairs of many boxes, the lamp under the topmost ceiling",
              "Three sealed storeys of 3 meters, joined by two flights of stairs; the lamp is under the topmost ceiling.",
              ([-1.8, 1.3, 2.2], [1.2, 1.75, -0.9], [0, 1, 0], 80),
              {"white": (0.8, None), "wood": ((0.65, 0.4, 0.2), None), "steel": (0.5, None), "lamp": (BLACK, 60)}, settings={"exposure": 1.5})
    s.room((-2, 0, -2.5), (2, 9, 2.5), "white")
    s.group("lamp")
    y = 9 - CLEAR
    s.quad([(-1.2, y, -0.6), (1.2, y, -0.6), (1.2, y, 0.6), (-1.2, y, 0.6)], "lamp")
    for storey, side in ((1, 1), (2, -1)):
        top = 3 * storey
        s.group(f"slab-{storey}", "the ceiling of a storey, with the opening of its flight; no faces on the walls")
        outline = [(-2, 2.5), (2, 2.5), (2, 1.6), (0.7, 1.6), (0.7, -1.5), (2, -1.5), (2, -2.5), (-2, -2.5)]
        bare = [0, 1, 5, 6, 7]
        if side < 0:  # a mirror image reverses the orientation, from the mirrored edge on
            outline = [(-x, z) for x, z in reversed(outline)]
            bare = sorted((6 - i) % 8 for i in bare)
        s.slab(outline, top - 0.2, top, "white", bare)
        flight(s, storey, side, top - 3)
    return s


def flight(s, storey, side, ground):
    """Sixteen treads up along a wall, towards -z, with two posts each and a rail."""
    s.group(f"flight-{storey}")
    rise, run, start = 3 / 16, 0.2, 1.5
    low, high = sorted((side * 0.8, side * 1.99))
    post_low, post_high = sorted((side * 0.82, side * 0.85))
    for i in range(15):
        y, z = ground + rise * (i + 1), start - run * i
        s.box((low, y - 0.05, z - 0.24), (high, y, z), "wood")
        for back in (0.06, 0.16):
            s.box((post_low, y, z - back - 0.03), (post_high, y + 0.8 + rise * back / run, z - back), "steel",
                  ("bottom", "top"))
    slope = rise / run
    y0, z0, z1 = ground + rise + 0.78, start + 0.02, start - run * 15
    y1 = y0 + slope * (z0 - z1)
    a, b = sorted((side * 0.8, side * 0.87))
    s.mesh([(x, y + up, z) for z, y in ((z1, y1), (z0, y0)) for up in (0, 0.06) for x in (a, b)],
           [("steel", corners) for corners in Scene.SIDES.values()])


def open_box():
    s = Scene("open-box", "Open box",
              "an open box under a large lamp: mostly direct light",
              "A box of 2 x 2 x 2, open towards the camera, with a large lamp in its ceiling: mostly direct light.",
              ([0, 1, 2.9], [0, 1, 0], [0, 1, 0], 50),
              {"white": (0.75, None), "red": ((0.65, 0.1, 0.08), None), "green": ((0.15, 0.5, 0.12), None),
               "lamp": (BLACK, 2.5)})
    s.room((-1, 0, -1), (1, 2, 1), {"": "white", "left": "red", "right": "green"}, ("front",))
    s.group("lamp")
    y = 2 - CLEAR
    s.quad([(-0.8, y, -0.8), (0.8, y, -0.8), (0.8, y, 0.8), (-0.8, y, 0.8)], "lamp")
    s.group("blocks")
    s.transform = turned_y(18, (-0.35, -0.35))
    s.box((-0.65, 0, -0.65), (-0.05, 1.2, -0.05), "white", ("bottom",))
    s.transform = turned_y(-17, (0.4, 0.3))
    s.box((0.12, 0, 0.02), (0.68, 0.56, 0.58), "white", ("bottom",))
    s.transform = lambda p: p
    return s


def sky():
    s = Scene("sky", "Under the sky",
              "blocks under an even sky: most paths find light at once",
              "A ground of 40 x 40 with a few blocks under an even sky.",
              ([3.4, 2.4, 5.8], [0.35, 0.7, 0], [0, 1, 0], 40),
              {"ground": (0.5, None), "white": (0.8, None), "red": ((0.75, 0.2, 0.15), None),
               "blue": ((0.2, 0.3, 0.7), None)}, environment={"radiance": [0.5, 0.65, 0.9]})
    s.group("ground")
    s.quad([(-20, 0, 20), (20, 0, 20), (20, 0, -20), (-20, 0, -20)], "ground")
    s.group("blocks")
    for material, degrees, (x, z), size, height in (("white", 20, (-0.9, -0.6), 0.5, 1.8),
                                                    ("red", -30, (0.8, 0.2), 0.45, 0.9),
                                                    ("blue", 40, (-0.3, 1.5), 0.3, 0.6)):
        s.transform = turned_y(degrees, (x, z))
        s.box((x - size, 0, z - size), (x + size, height, z + size), material, ("bottom",))
    s.transform = lambda p: p
    s.group("arch", "a beam on two posts, which end inside it")
    s.box((1.6, 0, -2.2), (1.9, 1.81, -1.9), "white", ("bottom", "top"))
    s.box((0.1, 0, -2.2), (0.4, 1.81, -1.9), "white", ("bottom", "top"))
    s.box((-0.1, 1.8, -2.3), (2.1, 2.1, -1.8), "white")
    return s


def ceiling():
    s = Scene("ceiling", "Bright ceiling",
              "a furnished room under a ceiling that is mostly lamp",
              "A sealed room with a table and a cupboard under one lamp as large as most of its ceiling.",
              ([-1.6, 1.5, 1.9], [0.5, 0.7, -1.2], [0, 1, 0], 65),
              {"white": (0.7, None), "wood": ((0.6, 0.4, 0.22), None), "green": ((0.25, 0.5, 0.3), None),
               "lamp": (BLACK, 1.2)})
    s.room((-2, 0, -2), (2, 2.5, 2), "white")
    s.group("lamp")
    y = 2.5 - CLEAR
    s.quad([(-1.6, y, -1.6), (1.6, y, -1.6), (1.6, y, 1.6), (-1.6, y, 1.6)], "lamp")
    s.group("table", "the legs end inside its top")
    s.box((-0.5, 0.7, -0.9), (0.9, 0.75, 0.1), "wood")
    for x in (-0.45, 0.79):
        for z in (-0.85, -0.01):
            s.box((x, 0, z), (x + 0.06, 0.71, z + 0.06), "wood", ("bottom", "top"))
    s.group("cupboard")
    s.box((1.3, 0, -1.9), (1.95, 1.6, -0.9), "green", ("bottom",))
    return s


def spheres():
    s = Scene("spheres", "Cornell box with spheres",
              "the Cornell box with a mirror and a glass sphere: caustics",
              "The measured Cornell box with a mirror and a glass sphere in the place of its blocks.", CORNELL_CAMERA,
              {**CORNELL, "mirror": (BLACK, None, "Ks 0.95 0.95 0.95", "illum 3"),
               "glass": (BLACK, None, "Tf 1 1 1", "Ni 1.5", "illum 7")}, unit="millimeter")
    cornell_walls(s)
    cornell_light(s)
    s.group("mirror_sphere", "the spheres hang a millimeter above the ground")
    s.sphere((395, 111, 370), 110, "mirror", 18, 36)
    s.group("glass_sphere")
    s.sphere((165, 101, 190), 100, "glass", 18, 36)
    return s


def plates():
    s = Scene("plates", "Roughness ladder",
              "four metal plates from smooth to rough under four lamps of equal power: which strategy finds which light (after E. Veach)",
              "Four lamps of equal power and different size, and four metal plates of different roughness that show them.",
              ([0, 1.4, 6.4], [0, 0.75, 0], [0, 1, 0], 40),
              {"wall": (0.35, None), **{f"plate_{i}": (BLACK, None, "Pm 1", f"Ks {c}", f"Pl_roughness {r}") for i, (r, c) in
                                       enumerate(((0.1, "0.9 0.7 0.4"), (0.22, "0.9 0.9 0.9"), (0.37, "0.9 0.55 0.4"),
                                                  (0.55, "0.6 0.7 0.9")))},
               **{f"lamp_{i}": (BLACK, (0.3 / r ** 2,) * 3) for i, r in enumerate((0.04, 0.1, 0.25, 0.6))}})
    s.group("wall", "ground and back, open to the sides")
    s.quad([(-6, -0.5, 3), (6, -0.5, 3), (6, -0.5, -3), (-6, -0.5, -3)], "wall")
    s.quad([(-6, -0.5, -3), (6, -0.5, -3), (6, 5, -3), (-6, 5, -3)], "wall")
    lamp, eye = (2.6, -1.6), (1.4, 6.4)  # (y, z): mirrored by the centers of the plates
    for i, (y, z) in enumerate(((0.9, -1.3), (0.5, -0.6), (0.12, 0.1), (-0.2, 0.8))):
        s.group(f"plate_{i}", "tilted so that the camera sees the lamps in its middle")
        ways = [tuple(d / math.hypot(*way) for d in way) for way in ((q[0] - y, q[1] - z) for q in (lamp, eye))]
        half = math.hypot(ways[0][0] + ways[1][0], ways[0][1] + ways[1][1])
        up, out = (ways[0][0] + ways[1][0]) / half, (ways[0][1] + ways[1][1]) / half
        dy, dz = 0.3 * out, -0.3 * up
        s.quad([(-2, y - dy, z - dz), (2, y - dy, z - dz), (2, y + dy, z + dz), (-2, y + dy, z + dz)], f"plate_{i}")
    for i, (x, r) in enumerate(((-1.65, 0.04), (-0.75, 0.1), (0.15, 0.25), (1.4, 0.6))):
        s.group(f"lamp_{i}")
        s.sphere((x, lamp[0], lamp[1]), r, f"lamp_{i}", 8, 16)
    return s


def coats():
    s = Scene("coats", "Coats and metals",
              "blocks and spheres of lacquer, satin plastic, brushed copper, frosted glass",
              "The room of the measured Cornell box with blocks of plastic and metal, smooth and rough.", CORNELL_CAMERA,
              {**CORNELL, "lacquer": ((0.1, 0.2, 0.6), None, "Ks 1 1 1", "Pl_surface plastic", "Pl_roughness 0", "Pl_ior 1.5"),
               "satin": ((0.65, 0.5, 0.15), None, "Ks 1 1 1", "Pl_surface plastic", "Pl_roughness 0.4", "Pl_ior 1.5"),
               "copper": (BLACK, None, "Pm 1", "Ks 0.95 0.64 0.54", "Pl_roughness 0.45"),
               "frosted": (BLACK, None, "Tf 0.9 1 0.95", "Ni 1.5", "illum 7", "Pl_roughness 0.35")}, unit="millimeter")
    cornell_walls(s)
    cornell_light(s)
    s.group("tall_block", "the measured one, of brushed copper")
    cornell_block(s, TALL_BLOCK, "copper")
    for name, center, radius in (("lacquer", (110, 71, 150), 70), ("satin", (240, 61, 110), 60),
                                 ("frosted", (410, 66, 120), 65)):
        s.group(name)
        s.sphere(center, radius, name, 14, 28)
    return s


def planks(x, y):
    """Four boards side by side, each of a brown of its own, with seams and a grain."""
    board, grain = x // 16, (x * 7 + (y // 9) * 3 + (x // 16) * 5) % 6
    if x % 16 == 0 or (y + 24 * (board % 2)) % 64 == 0:
        return 60, 38, 22
    base = ((168, 116, 70), (150, 100, 60), (176, 126, 80), (158, 106, 62))[board]
    return tuple(c - 5 * grain for c in base)


def wallpaper(x, y):
    """Diamonds in two greens, a gray so that nothing reflects more than 0.8."""
    inside = abs(x % 16 - 8) + abs(y % 16 - 8) < 5
    return (206, 214, 190) if inside else (182, 198, 172)


def lattice(x, y):
    """White bars along the borders and diagonals of a square; black is a hole."""
    bar = min(x, y, 31 - x, 31 - y) < 3 or abs(x - y) < 3 or abs(x + y - 31) < 3
    return (255, 255, 255) if bar else (0, 0, 0)


def sky_radiance(x, y):
    """Blue above, white towards the horizon, brown below; brighter towards the sun's side (+x), by polynomials alone."""
    up = 1 - (y + 0.5) / 16  # 1 to -1
    side = 1 - abs((x + 0.5) / 64 - 0.75) * 4 if x >= 32 else 0.0
    if up < 0:
        return 0.12, 0.1, 0.08
    haze = (1 - up) ** 4
    return tuple((c * (1 - haze) + 1.4 * haze) * (1 + max(side, 0.0)) for c in (0.35, 0.6, 1.1))


def textured_room():
    s = Scene("textured-room", "Textured room",
              "sky and sun through a window behind a lattice: textures, holes, an environment map",
              "A room of 4 x 2.6 x 5 m with a wooden ground and wallpaper, lit by sky and a hazy sun through a window on its right;\n"
              "before the window a lattice, which is an image with holes.",
              ([-1.3, 1.5, 2.3], [0.35, 1.0, -1.2], [0, 1, 0], 65),
              {"white": (0.7, None), "floor": (0.9, None, "map_Kd planks.png"), "paper": (0.9, None, "map_Kd wallpaper.png"),
               "lattice": (0.6, None, "map_d lattice.png"), "wood": ((0.45, 0.28, 0.15), None)},
              environment={"map": "sky.hdr", "scale": 4, "rotation_deg": 0,
                           "sun": {"direction": [1, 0.75, 0.45], "radiance": [360, 330, 270], "angle_deg": 10}},
              settings={"exposure": 1.5})
    s.json["materials"] = {"lattice": {"opacity_rule": "threshold"}}
    s.images = {"planks.png": png(64, 64, planks), "wallpaper.png": png(64, 64, wallpaper),
                "lattice.png": png(32, 32, lattice), "sky.hdr": hdr(64, 32, sky_radiance)}
    x0, x1, y1, z0, z1 = -2, 2, 2.6, -2.5, 2.5
    s.group("room")
    s.painted_quad([(x0, 0, z1), (x1, 0, z1), (x1, 0, z0), (x0, 0, z0)], "floor", (4, 5))
    s.painted_quad([(x0, 0, z0), (x1, 0, z0), (x1, y1, z0), (x0, y1, z0)], "paper", (4, 2.6))
    s.painted_quad([(x0, 0, z1), (x0, 0, z0), (x0, y1, z0), (x0, y1, z1)], "paper", (5, 2.6))
    s.quad([(x1, 0, z1), (x0, 0, z1), (x0, y1, z1), (x1, y1, z1)], "white")
    s.quad([(x0, y1, z0), (x1, y1, z0), (x1, y1, z1), (x0, y1, z1)], "white")
    s.group("window_wall", "right; the window is 1.6 x 1.2 m")
    low, high, near, far = 0.9, 2.1, 0.4, -1.2
    for z, w, y, h in ((z1, near, 0, y1), (far, z0, 0, y1), (near, far, 0, low), (near, far, high, y1)):
        s.quad([(x1, y, w), (x1, y, z), (x1, h, z), (x1, h, w)], "white")
    s.group("lattice", "2 cm inside of the opening, as large as it")
    s.painted_quad([(x1 - 0.02, low, far), (x1 - 0.02, low, near), (x1 - 0.02, high, near), (x1 - 0.02, high, far)], "lattice",
                   (4, 3))
    s.group("table")
    s.box((0.3, 0.68, -1.6), (1.3, 0.74, -0.4), "wood")
    for x in (0.34, 1.2):
        for z in (-1.56, -0.5):
            s.box((x, 0, z), (x + 0.06, 0.69, z + 0.06), "wood", ("bottom", "top"))
    s.group("box", "on the table, 1 mm above it")
    s.transform = turned_y(30, (0.7, -1.1))
    s.box((0.55, 0.741, -1.25), (0.85, 1.05, -0.95), "white")
    s.transform = lambda p: p
    return s


def lens():
    s = Scene("lens", "Thin lens",
              "a row of balls that leads away from a lens with an aperture",
              "A row of balls and blocks that leads away from the camera, whose lens is sharp at the third ball.",
              ([0.75, 1.1, 4.2], [0.1, 0.35, 0.4], [0, 1, 0], 32),
              {"ground": (0.6, None), "red": ((0.7, 0.12, 0.1), None), "blue": ((0.12, 0.25, 0.65), None),
               "white": (0.75, None), "lamp": (BLACK, 9)}, environment={"radiance": [0.25, 0.3, 0.4]})
    s.json["camera"].update({"aperture_radius": 0.09, "focus_distance": 3.8})
    s.group("ground")
    s.quad([(-8, 0, 6), (8, 0, 6), (8, 0, -10), (-8, 0, -10)], "ground")
    s.group("lamp")
    s.quad([(-1, 3, -1), (1, 3, -1), (1, 3, 1), (-1, 3, 1)], "lamp")
    s.group("row", "balls hang a centimeter above the ground")
    for i, z in enumerate((2.4, 1.4, 0.4, -0.8, -2.4, -4.6)):
        s.sphere((-0.35 - 0.12 * i, 0.31, z), 0.3, ("red", "white", "blue")[i % 3], 10, 20)
    s.group("blocks")
    for i, z in enumerate((1.9, 0.4, -1.6, -4)):
        s.transform = turned_y(20 * i, (0.75 + 0.2 * i, z))
        s.box((0.6 + 0.2 * i, 0, z - 0.15), (0.9 + 0.2 * i, 0.5, z + 0.15), ("white", "blue", "red", "white")[i], ("bottom",))
    s.transform = lambda p: p
    return s


def gallery():
    s = Scene("gallery", "Gallery",
              "a long hall under sixty small lamps, a stronger one at its end: which lamp matters depends on where one stands",
              "A long hall under sixty small lamps, with one at its far end that is stronger than all of them.",
              ([0.6, 1.7, 9.5], [-0.1, 1.15, 0], [0, 1, 0], 50),
              {"plaster": (0.7, None), "floor": ((0.45, 0.33, 0.22), None), "stone": ((0.5, 0.52, 0.55), None),
               "warm": (BLACK, (36, 25, 14)), "cold": (BLACK, (17, 24, 34)), "flood": (BLACK, 190)})
    s.room((-2, 0, -20), (2, 3, 10), {"": "plaster", "bottom": "floor"})
    s.group("lamps", "two rows under the ceiling")
    for i in range(30):
        for side in (-1, 1):
            x, z = side * 1.2, 9.4 - i
            s.quad([(x - 0.06, 2.95, z - 0.06), (x + 0.06, 2.95, z - 0.06), (x + 0.06, 2.95, z + 0.06),
                    (x - 0.06, 2.95, z + 0.06)], "warm" if (i // 3) % 2 == 0 else "cold")
    s.group("flood", "it shines down the hall")
    s.quad([(-0.3, 2, -19.9), (0.3, 2, -19.9), (0.3, 2.6, -19.9), (-0.3, 2.6, -19.9)], "flood")
    s.group("plinths")
    for i, z in enumerate((6.6, 4.2, 1.8, -0.6, -3, -5.4, -7.8, -10.2)):
        x = -0.95 if i % 2 == 0 else 0.95
        s.transform = turned_y(17 * i, (x, z))
        s.box((x - 0.3, 0, z - 0.3), (x + 0.3, 0.9 + 0.1 * (i % 3), z + 0.3), "stone", ("bottom",))
    s.transform = lambda p: p
    return s


SCENES = (shelter, pillars, indirect, labyrinth, thin_wall, two_lights, boxed_lights, staircase, open_box, sky, ceiling,
          spheres, plates, coats, textured_room, lens, gallery,
          living_room, still_life, bar)


def main():
    check = sys.argv[1:] == ["--check"]
    if sys.argv[1:] and not check:
        sys.exit(__doc__)
    different = []
    for make in SCENES:
        scene = make()
        for name, content in scene.files().items():
            path = FOLDER / scene.name / name
            if check:
                if not path.exists() or path.read_bytes() != content:
                    different.append(str(path))
            else:
                path.parent.mkdir(exist_ok=True)
                path.write_bytes(content)
        if not check:
            print(f"{scene.name}: {scene.triangles} triangles")
    if different:
        sys.exit("not what make_scenes.py writes: " + ", ".join(different))


if __name__ == "__main__":
    main()
