"""Three scenes that look like what people render: a living room by day, a still life, a bar by night."""
import math

from scene_files import BLACK, CLEAR, Scene, hdr, png, turned_y
from scene_shapes import Dice, ball, cord, lathe, ring, rounded_box, sheet, tube

STILL = lambda p: p  # noqa: E731, the transform of a scene at rest


def plastic(roughness, ior=1.5):
    return "Ks 1 1 1", "Pl_surface plastic", f"Pl_roughness {roughness}", f"Pl_ior {ior}"


def metal(color, roughness):
    return "Pm 1", "Ks " + " ".join(map(str, color)), f"Pl_roughness {roughness}"


def glass(tint=(1, 1, 1), ior=1.5):
    return "Tf " + " ".join(map(str, tint)), f"Ni {ior}", "illum 7"


def moved_and_turned(degrees, to):
    """Turns about the vertical axis through the origin, then moves."""
    turn = turned_y(degrees, (0, 0))
    return lambda p: tuple(a + b for a, b in zip(turn(p), to))


def boards(x, y):
    """Oak boards of 16 x 128 texels, each with a brown and a grain of its own."""
    column = x // 16
    board = (column * 7 + (y + 48 * (column % 3)) // 128 * 5) % 6
    seam = x % 16 == 0 or (y + 48 * (column % 3)) % 128 == 0
    grain = ((x * 13 + (y // 7) * 5 + board * 11) % 9) - 4 + ((x % 16 * 3 + y // 31) % 5)
    base = ((176, 132, 86), (164, 120, 76), (186, 142, 96), (154, 112, 70), (170, 124, 82), (180, 138, 88))[board]
    return tuple(max(c // 2, 0) for c in base) if seam else tuple(c + 2 * grain for c in base)


def carpet(x, y):
    """A border and diamonds in muted red, blue and cream."""
    edge = min(x, y, 63 - x, 63 - y)
    if edge < 2 or edge in (5, 6):
        return 196, 182, 150
    if edge < 8:
        return 108, 38, 34
    diamond = abs(x % 16 - 8) + abs(y % 16 - 8)
    return ((196, 182, 150) if diamond == 5 else (46, 60, 92) if diamond < 5 else (126, 46, 40))


def landscape(x, y):
    """A painting: sky, hills and a field."""
    hill = 26 + 7 * math.sin(x * 0.11) + 4 * math.sin(x * 0.23 + 2)
    near = 40 + 4 * math.sin(x * 0.08 + 4)
    if y < hill:
        t = y / 30
        return int(120 + 90 * t), int(150 + 55 * t), int(185 + 5 * t)
    if y < near:
        return 70 + (x * 3 + y) % 9, 96 + (x + 2 * y) % 11, 74
    return 178 + (x * 5 + y * 3) % 13, 156 + (x + y * 7) % 9, 78


def day_radiance(x, y):
    """Sky with haze at the horizon, green ground."""
    up = 1 - (y + 0.5) / 16
    if up < 0:
        return (0.16, 0.19, 0.09) if up < -0.1 else (0.3, 0.36, 0.3)
    haze = (1 - up) ** 5
    return tuple(c * (1 - haze) + 1.5 * haze for c in (0.35, 0.6, 1.15))


LEAF = [(0.0, 0.02), (0.25, 0.75), (0.55, 1.0), (0.8, 0.7), (1.0, 0.02)]


def leaf_width(v):
    for (v0, w0), (v1, w1) in zip(LEAF, LEAF[1:]):
        if v <= v1:
            return w0 + (w1 - w0) * (v - v0) / (v1 - v0)
    return LEAF[-1][1]


def plant(s, at, leaves, length, dice):
    """Leaves that bow outwards from a place."""
    for i in range(leaves):
        angle = 2.4 * i + dice.between(-0.3, 0.3)
        reach, rise = length * dice.between(0.5, 0.9), length * dice.between(0.7, 1.2)
        width = length * 0.13

        def place(u, v, angle=angle, reach=reach, rise=rise, width=width):
            out = reach * v * v
            side = (u - 0.5) * 2 * width * leaf_width(min(max(v, 0), 1))
            fold = abs(u - 0.5) * 0.5 * width
            return (at[0] + out * math.sin(angle) + side * math.cos(angle),
                    at[1] + rise * (v - 0.55 * v * v * v) + fold,
                    at[2] + out * math.cos(angle) - side * math.sin(angle))
        sheet(s, place, 4, 8, "leaf")


def books(s, low, high, dice, colors):
    """A row of books between two places of a shelf; the spines look along -x."""
    z = low[2] + 0.01
    while True:
        thick, tall, deep = dice.between(0.018, 0.05), dice.between(0.62, 0.95), dice.between(0.6, 0.85)
        if z + thick > high[2] - 0.01:
            return
        if dice.between(0, 1) > 0.08:
            s.box((high[0] - deep * (high[0] - low[0]), low[1] + 0.001, z), (high[0], low[1] + tall * (high[1] - low[1]), z + thick),
                  dice.of(colors), ("right", "bottom"))
        z += thick + dice.between(0.001, 0.004)


def living_room():
    s = Scene("living-room", "Living room",
              "a furnished room by day: sky and sun through one large window",
              "A furnished room of 5.2 x 2.7 x 6 m by day: sky and sun through one large window on its left, a blind above it.",
              ([1.7, 1.45, 2.9], [0.02, 0.86, -1.3], [0, 1, 0], 58),
              {"wall": ((0.78, 0.76, 0.72), None), "accent": ((0.34, 0.42, 0.42), None), "ceiling": (0.82, None),
               "floor": (0.9, None, *plastic(0.45), "map_Kd boards.png"), "carpet": (0.85, None, "map_Kd carpet.png"),
               "paint": (0.8, None, *plastic(0.3)), "wood": ((0.42, 0.26, 0.14), None, *plastic(0.4)),
               "dark": ((0.06, 0.05, 0.045), None, *plastic(0.35)), "sofa": ((0.2, 0.27, 0.33), None),
               "cushion": ((0.72, 0.48, 0.16), None), "linen": ((0.74, 0.7, 0.62), None), "blind": ((0.7, 0.67, 0.6), None),
               "brass": (BLACK, None, *metal((0.88, 0.72, 0.4), 0.35)), "shade": ((0.8, 0.74, 0.62), None),
               "bulb": (BLACK, (34, 24, 13)), "porcelain": ((0.8, 0.8, 0.77), None, *plastic(0.08)),
               "orange": ((0.8, 0.34, 0.05), None, *plastic(0.4)), "pot": ((0.5, 0.24, 0.15), None),
               "leaf": ((0.1, 0.26, 0.07), None, *plastic(0.5)), "earth": ((0.08, 0.06, 0.04), None),
               "painting": (0.9, None, "map_Kd landscape.png"), "glass": (BLACK, None, *glass()),
               "red": ((0.5, 0.1, 0.08), None), "blue": ((0.1, 0.17, 0.38), None), "cream": ((0.75, 0.68, 0.52), None),
               "green": ((0.13, 0.26, 0.16), None)},
              environment={"map": "sky.hdr", "scale": 5, "rotation_deg": 0,
                           "sun": {"direction": [-1, 0.8, 0.42], "radiance": [60000, 52000, 40000], "angle_deg": 1.2}},
              settings={"exposure": 0.6, "tonemap": "aces"})
    s.images = {"boards.png": png(96, 256, boards), "carpet.png": png(64, 64, carpet), "landscape.png": png(96, 64, landscape),
                "sky.hdr": hdr(64, 32, day_radiance)}
    living_walls(s)
    living_window(s)
    living_sofa(s)
    living_table(s)
    living_shelf(s)
    living_things(s)
    s.knob("blind", 0, [0, 1.3], "how far the blind is let down, in meters: at 1.3 a slit of 0.35 m is left",
           moves=[{"groups": ["blind"], "by": [0, -1, 0]}])
    return s


X0, X1, Y1, Z0, Z1 = -2.6, 2.6, 2.7, -3, 3
LOW, HIGH, FAR, NEAR, OUTSIDE = 0.45, 2.3, -1.7, 0.9, -2.85  # the window


def living_walls(s):
    s.group("walls")
    s.painted_quad([(X0, 0, Z1), (X1, 0, Z1), (X1, 0, Z0), (X0, 0, Z0)], "floor", (5.2, 2))
    s.quad([(X0, Y1, Z0), (X1, Y1, Z0), (X1, Y1, Z1), (X0, Y1, Z1)], "ceiling")
    s.quad([(X0, 0, Z0), (X1, 0, Z0), (X1, Y1, Z0), (X0, Y1, Z0)], "accent")
    s.quad([(X1, 0, Z1), (X0, 0, Z1), (X0, Y1, Z1), (X1, Y1, Z1)], "wall")
    s.quad([(X1, 0, Z0), (X1, 0, Z1), (X1, Y1, Z1), (X1, Y1, Z0)], "wall")
    for z, w, y, h in ((Z1, NEAR, 0, Y1), (FAR, Z0, 0, Y1), (NEAR, FAR, 0, LOW), (NEAR, FAR, HIGH, Y1)):
        s.quad([(X0, y, z), (X0, y, w), (X0, h, w), (X0, h, z)], "wall")
    reveal = [(LOW, NEAR), (LOW, FAR), (HIGH, FAR), (HIGH, NEAR)]
    for (y, z), (h, w) in zip(reveal, reveal[1:] + reveal[:1]):
        s.quad([(X0, y, z), (OUTSIDE, y, z), (OUTSIDE, h, w), (X0, h, w)], "paint")
    s.group("skirting", "boards along the walls that are seen")
    s.box((X0 + 0.001, 0.001, Z0 + 0.001), (X1 - 0.001, 0.1, Z0 + 0.018), "paint", ("bottom", "back"))
    s.box((X0 + 0.001, 0.001, Z0 + 0.02), (X0 + 0.018, 0.1, Z1 - 0.001), "paint", ("bottom", "left"))


def living_window(s):
    s.group("frame", "of the window, with two bars")
    x, y = OUTSIDE + 0.04, 0.05
    s.box((x, LOW + 0.001, FAR + 0.001), (x + 0.05, LOW + y, NEAR - 0.001), "paint")
    s.box((x, HIGH - y, FAR + 0.001), (x + 0.05, HIGH - 0.001, NEAR - 0.001), "paint")
    for z in (FAR + 0.002, (2 * FAR + NEAR) / 3, (FAR + 2 * NEAR) / 3, NEAR - 0.052):
        s.box((x + 0.002, LOW + y - 0.01, z), (x + 0.048, HIGH - y + 0.01, z + 0.05), "paint", ("top", "bottom"))
    s.group("sill")
    rounded_box(s, (OUTSIDE + 0.1, LOW + 0.002, FAR + 0.01), (X0 + 0.06, LOW + 0.035, NEAR - 0.01), 0.012, "paint")
    s.group("blind", "rolled up; its knob lets it down")
    s.box((X0 - 0.12, HIGH - 0.2, FAR + 0.02), (X0 - 0.115, HIGH + 1.2, NEAR - 0.02), "blind")
    s.group("rail")
    cord(s, (X0 + 0.12, 2.5, FAR - 0.5), (X0 + 0.12, 2.5, NEAR + 0.5), 0.012, "brass", 12)
    for end in (FAR - 0.5, NEAR + 0.5):
        ball(s, (X0 + 0.12, 2.5, end), 0.028, "brass", 8, 14)
    s.group("curtains")
    for z0, z1 in ((FAR - 0.45, FAR + 0.1), (NEAR - 0.1, NEAR + 0.45)):
        def place(u, v, z0=z0, z1=z1):
            wave = 0.045 * math.sin(2 * math.pi * 6 * u + 0.8 * v) * (0.6 + 0.4 * (1 - v))
            return (X0 + 0.12 + wave, 0.03 + 2.455 * v, z1 + (z0 - z1) * u)
        sheet(s, place, 60, 4, "linen")


def living_sofa(s):
    s.group("sofa")
    s.transform = moved_and_turned(0, (0.02, 0, -2.35))
    rounded_box(s, (-1.1, 0.14, -0.42), (1.1, 0.36, 0.44), 0.05, "sofa")
    for side in (-1, 1):
        rounded_box(s, (min(side * 1.1, side * 1.32), 0.14, -0.45), (max(side * 1.1, side * 1.32), 0.62, 0.46), 0.07, "sofa", 3)
        rounded_box(s, (min(side * 0.012, side * 1.085), 0.365, -0.2), (max(side * 0.012, side * 1.085), 0.52, 0.45), 0.06, "sofa", 3)
        rounded_box(s, (min(side * 0.012, side * 1.085), 0.5, -0.42), (max(side * 0.012, side * 1.085), 0.92, -0.18), 0.08, "sofa", 3)
    rounded_box(s, (-1.1, 0.14, -0.52), (1.1, 0.72, -0.43), 0.035, "sofa")
    for x in (-1.2, 1.2):
        for z in (-0.42, 0.38):
            tube(s, (x, 0.001, z), (x, 0.15, z), 0.018, "wood", 10, 0.028)
    for x, lean, turn, paint in ((-0.82, 0.17, 14, "cushion"), (0.78, 0.16, -18, "linen"), (0.45, 0.1, -6, "cushion")):
        tilt = moved_and_turned(turn, (x + 0.02, 0.525, -2.35 - 0.02 + (0.05 if paint == "linen" else 0)))
        s.transform = lambda p, tilt=tilt, lean=lean: tilt((p[0], p[1] * math.cos(lean) + p[2] * math.sin(lean),
                                                            p[2] * math.cos(lean) - p[1] * math.sin(lean)))
        rounded_box(s, (-0.21, 0.0, -0.06), (0.21, 0.4, 0.06), 0.055, paint, 4)
    s.group("armchair")
    s.transform = moved_and_turned(52, (-1.7, 0, -2.05))
    rounded_box(s, (-0.36, 0.3, -0.36), (0.36, 0.46, 0.36), 0.07, "linen", 3)
    rounded_box(s, (-0.36, 0.4, -0.42), (0.36, 0.98, -0.28), 0.065, "linen", 3)
    for side in (-1, 1):
        rounded_box(s, (min(side * 0.37, side * 0.44), 0.54, -0.38), (max(side * 0.37, side * 0.44), 0.59, 0.36), 0.02, "wood")
        for z in (-0.33, 0.31):
            tube(s, (side * 0.405, 0.001, z), (side * 0.405, 0.545, z), 0.018, "wood", 10, 0.024)
        s.box((side * 0.405 - 0.012, 0.33, -0.33), (side * 0.405 + 0.012, 0.37, 0.31), "wood")
    s.transform = STILL


def living_table(s):
    s.group("carpet")
    y = 0.012
    s.painted_quad([(-1.35, y, 0.55), (1.65, y, 0.55), (1.65, y, -1.65), (-1.35, y, -1.65)], "carpet")
    s.box((-1.35, 0.001, -1.65), (1.65, y - 0.001, 0.55), "linen", ("bottom", "top"))
    s.group("table")
    rounded_box(s, (-0.35, 0.37, -1.0), (0.85, 0.41, -0.3), 0.015, "wood")
    for x in (-0.27, 0.77):
        for z in (-0.92, -0.38):
            tube(s, (x, y, z), (0.25 + (x - 0.25) * 0.86, 0.372, -0.65 + (z + 0.65) * 0.86), 0.014, "dark", 10, 0.024)
    s.group("bowl", "of porcelain, with oranges")
    outside = [(0, 0), (0.05, 0), (0.055, 0.008), (0.1, 0.03), (0.135, 0.065), (0.15, 0.1)]
    inside = [(0.145, 0.1), (0.13, 0.067), (0.095, 0.035), (0.05, 0.016), (0, 0.013)]
    lathe(s, outside + inside, "porcelain", (0.52, 0.411, -0.72), 36)
    for x, y1, z in ((0.47, 0.475, -0.75), (0.555, 0.473, -0.7), (0.53, 0.478, -0.79), (0.515, 0.54, -0.735)):
        ball(s, (x, y1, z), 0.041, "orange", 10, 18)
    s.group("books", "on the table")
    for i, (paint, turn) in enumerate((("blue", 12), ("cream", 4), ("red", 21))):
        s.transform = moved_and_turned(turn, (0.0, 0.411 + 0.033 * i, -0.72))
        s.box((-0.13, 0.001, -0.09), (0.13, 0.032, 0.09), paint)
    s.transform = STILL
    s.group("vase", "of glass")
    wall = [(0, 0), (0.035, 0), (0.045, 0.01), (0.05, 0.06), (0.035, 0.13), (0.03, 0.17), (0.04, 0.2)]
    hollow = [(0.036, 0.2), (0.026, 0.17), (0.031, 0.13), (0.046, 0.06), (0.041, 0.015), (0, 0.012)]
    lathe(s, wall + hollow, "glass", (0.2, 0.412, -0.43), 28)


def living_shelf(s):
    s.group("shelf")
    s.transform = moved_and_turned(90, (4.2, 0, -0.4))
    x0, x1, z0, z1 = 2.28, 2.595, -2.73, -1.63
    for z in (z0, (z0 + z1) / 2 - 0.0125, z1 - 0.025):
        s.box((x0, 0.001, z), (x1, 2.0, z + 0.025), "wood", ("bottom",))
    s.box((x1 - 0.004, 0.002, z0 + 0.026), (x1, 1.99, z1 - 0.026), "wood")
    dice = Dice(7)
    paints = ["red", "blue", "cream", "green", "linen", "dark", "cushion", "sofa"]
    for level in range(6):
        y = 0.06 + 0.385 * level
        for a, b in ((z0 + 0.026, (z0 + z1) / 2 - 0.0135), ((z0 + z1) / 2 + 0.0135, z1 - 0.026)):
            s.box((x0 + 0.004, y, a), (x1 - 0.005, y + 0.022, b), "wood")
            if level < 5:
                books(s, (x0 + 0.02, y + 0.022, a), (x1 - 0.02, y + 0.36, b), dice, paints)
    s.transform = STILL


def living_things(s):
    s.group("painting")
    y0, y1, x0, x1, z = 1.25, 1.95, -0.52, 0.63, Z0 + 0.03
    s.painted_quad([(x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z)], "painting")
    for low, high in (((x0 - 0.05, y0 - 0.05), (x1 + 0.05, y0)), ((x0 - 0.05, y1), (x1 + 0.05, y1 + 0.05)),
                      ((x0 - 0.05, y0), (x0, y1)), ((x1, y0), (x1 + 0.05, y1))):
        s.box((*low, Z0 + 0.002), (*high, Z0 + 0.05), "dark", ("back",))
    s.group("lamp", "a stand with a shade of cloth, open above and below")
    lathe(s, [(0, 0), (0.14, 0), (0.14, 0.012), (0.02, 0.03), (0.012, 0.05), (0.012, 1.42), (0, 1.43)], "brass",
          (-1.52, 0.001, -2.66), 28)
    tube(s, (-1.52, 1.32, -2.66), (-1.52, 1.62, -2.66), 0.21, "shade", 36, 0.15)
    ball(s, (-1.52, 1.475, -2.66), 0.04, "bulb", 8, 14)
    s.group("plant")
    lathe(s, [(0, 0), (0.12, 0), (0.16, 0.3), (0.165, 0.3), (0.165, 0.33), (0.145, 0.33), (0.14, 0.29), (0, 0.285)], "pot",
          (2.05, 0.001, -2.05), 28)
    lathe(s, [(0.139, 0.3), (0, 0.301)], "earth", (2.05, 0.001, -2.05), 28)
    plant(s, (2.05, 0.3, -2.05), 26, 0.8, Dice(3))
    s.group("small plant", "on the sill")
    lathe(s, [(0, 0), (0.05, 0), (0.065, 0.1), (0.06, 0.1), (0.055, 0.08), (0, 0.08)], "porcelain", (-2.68, LOW + 0.036, -1.3), 24)
    plant(s, (-2.68, LOW + 0.12, -1.3), 14, 0.2, Dice(5))


def still_life():
    s = Scene("still-life", "Still life",
              "glass, copper, silver and fruit on a table under a soft lamp, by a lens: caustics",
              "Glass, copper, silver and fruit on a table with a cloth, lit by a large soft lamp from the left.",
              ([0.08, 0.5, 1.55], [0.02, 0.135, 0], [0, 1, 0], 23),
              {"wall": ((0.16, 0.14, 0.13), None), "table": (0.75, None, *plastic(0.35), "map_Kd boards.png"),
               "edge": ((0.3, 0.2, 0.12), None), "cloth": ((0.2, 0.26, 0.34), None), "glass": (BLACK, None, *glass()),
               "bottle": (BLACK, None, *glass((0.55, 0.85, 0.6))), "copper": (BLACK, None, *metal((0.955, 0.638, 0.538), 0.3)),
               "silver": (BLACK, None, *metal((0.93, 0.92, 0.89), 0.18)), "mirror": (BLACK, None, *metal((0.95, 0.93, 0.88), 0)),
               "candle": ((0.86, 0.83, 0.74), None, *plastic(0.5)), "apple": ((0.55, 0.06, 0.05), None, *plastic(0.22)),
               "pear": ((0.6, 0.58, 0.14), None, *plastic(0.35)), "lemon": ((0.82, 0.66, 0.07), None, *plastic(0.4)),
               "stem": ((0.14, 0.09, 0.05), None), "porcelain": ((0.82, 0.82, 0.8), None, *plastic(0.06)),
               "lamp": (BLACK, (15, 14, 12.5)), "fill": (BLACK, (0.5, 0.55, 0.7))},
              environment={"radiance": [0.02, 0.022, 0.028]}, settings={"exposure": -0.4, "tonemap": "aces"})
    s.json["camera"].update({"aperture_radius": 0.004, "focus_distance": 1.58})
    s.images = {"boards.png": png(96, 256, boards)}
    s.group("table", "and the wall behind it")
    s.painted_quad([(-1.1, 0, 0.55), (1.1, 0, 0.55), (1.1, 0, -0.6), (-1.1, 0, -0.6)], "table", (2.2, 0.6))
    s.box((-1.1, -0.05, -0.6), (1.1, -0.0005, 0.55), "edge")
    s.quad([(-3, -1, -1.1), (3, -1, -1.1), (3, 3, -1.1), (-3, 3, -1.1)], "wall")
    s.group("lamp")
    s.quad([(-1.5, 0.5, -0.6), (-0.7, 1.75, -0.6), (-0.7, 1.75, 0.9), (-1.5, 0.5, 0.9)], "lamp")
    s.group("fill")
    s.quad([(1.6, 0.2, 1.2), (1.6, 0.2, -0.2), (1.4, 1.4, -0.2), (1.4, 1.4, 1.2)], "fill")
    still_cloth(s)
    still_vessels(s)
    still_fruit(s)
    s.knob("lamp", 0, [-0.2, 1.5], "how far the lamp stands back, in meters",
           moves=[{"groups": ["lamp"], "by": [-0.85, 0.45, 0]}])
    return s


def still_cloth(s):
    s.group("cloth", "in folds, over the front edge of the table")

    def place(u, v):
        x, z = -0.42 + 0.6 * u, 0.25 + 0.02 * math.sin(11 * u) + 0.4 * (1 - v)
        fold = 0.009 * (1 + math.sin(31 * x + 9 * z + 2 * math.sin(14 * z))) * (0.4 + 0.6 * math.sin(13 * z + 5 * x) ** 2)
        x += 0.1 * (1 - v) + 0.01 * math.sin(25 * z)
        if z < 0.552:
            return (x, 0.003 + fold, z)
        return (x, 0.003 + fold - 1.2 * (z - 0.552), 0.556 + fold)
    sheet(s, place, 80, 50, "cloth")


def still_vessels(s):
    s.group("wine glass")
    outside = [(0, 0), (0.034, 0), (0.035, 0.002), (0.012, 0.006), (0.0045, 0.016), (0.004, 0.08), (0.007, 0.092), (0.022, 0.104),
               (0.034, 0.122), (0.0385, 0.145), (0.036, 0.175), (0.032, 0.2)]
    inside = [(0.0307, 0.2), (0.0347, 0.175), (0.0372, 0.145), (0.0327, 0.123), (0.021, 0.1065), (0.008, 0.0985), (0, 0.0975)]
    lathe(s, outside + inside, "glass", (0.125, 0.001, 0.1), 48)
    s.group("bottle")
    outside = [(0, 0.006), (0.028, 0), (0.036, 0.004), (0.0375, 0.012), (0.0375, 0.16), (0.033, 0.185), (0.018, 0.215),
               (0.0145, 0.235), (0.0145, 0.285), (0.0165, 0.287), (0.0165, 0.297)]
    inside = [(0.0105, 0.297), (0.0105, 0.235), (0.0145, 0.214), (0.029, 0.184), (0.0335, 0.16), (0.0335, 0.016), (0, 0.016)]
    lathe(s, outside + inside, "bottle", (0.235, 0.001, -0.12), 48)
    s.group("jug", "of copper")
    outside = [(0, 0), (0.055, 0), (0.06, 0.006), (0.078, 0.05), (0.082, 0.085), (0.072, 0.125), (0.05, 0.16), (0.043, 0.19),
               (0.052, 0.225)]
    inside = [(0.049, 0.225), (0.04, 0.19), (0.047, 0.159), (0.069, 0.124), (0.079, 0.085), (0.075, 0.051), (0.057, 0.009), (0, 0.008)]
    center = (-0.15, 0.001, -0.05)
    lathe(s, outside + inside, "copper", center, 56)

    def upright(p):
        return (p[0], p[2], p[1])

    def handle(p):
        x, y, z = upright(p)
        c, q = math.cos(0.5), math.sin(0.5)
        return (c * x + q * z, y, c * z - q * x)
    ring(s, (center[0] - 0.068, 0.135, center[2] + 0.034), 0.055, 0.0065, "copper", lambda p: mirrored(handle(p)), 36, 10)
    s.group("candlestick", "of silver, with a candle")
    lathe(s, [(0, 0), (0.048, 0), (0.05, 0.006), (0.04, 0.014), (0.012, 0.022), (0.008, 0.04), (0.014, 0.055), (0.008, 0.07),
              (0.0065, 0.13), (0.012, 0.145), (0.02, 0.15), (0.022, 0.165), (0.013, 0.166), (0, 0.166)], "silver", (0.01, 0.001, -0.17), 40)
    lathe(s, [(0, 0), (0.0105, 0), (0.0105, 0.13), (0.007, 0.134), (0, 0.133)], "candle", (0.01, 0.168, -0.17), 24)
    tube(s, (0.01, 0.3, -0.17), (0.011, 0.315, -0.17), 0.0009, "stem", 6)
    s.group("ball", "a mirror")
    ball(s, (-0.035, 0.0285, 0.135), 0.0275, "mirror", 24, 48)
    s.group("bowl", "of porcelain")
    outside = [(0, 0), (0.03, 0), (0.032, 0.006), (0.06, 0.02), (0.083, 0.045), (0.09, 0.06)]
    inside = [(0.087, 0.06), (0.08, 0.046), (0.057, 0.023), (0.03, 0.011), (0, 0.009)]
    lathe(s, outside + inside, "porcelain", (0.05, 0.001, 0.0), 48)


def mirrored(p):
    """A motion again: turned by 180 degrees about the vertical axis."""
    return (-p[0], p[1], -p[2])


def fruit(s, at, profile, material, size, tilt=0.0, turn=0.0):
    """A body of revolution that lies as it has been put."""
    c, q = math.cos(tilt), math.sin(tilt)
    place = moved_and_turned(turn, at)
    s.transform = lambda p: place((p[0], c * p[1] - q * p[2], q * p[1] + c * p[2]))
    lathe(s, [(size * r, size * y) for r, y in profile], material, (0, 0, 0), 36)
    tube(s, (0, size * (profile[-1][1] - 0.05), 0), (size * 0.06, size * (profile[-1][1] + 0.42), 0), size * 0.035, "stem", 8)
    s.transform = STILL


def still_fruit(s):
    s.group("fruit")
    apple = [(0, -0.82), (0.25, -0.93), (0.5, -0.9), (0.8, -0.6), (0.98, -0.1), (1.0, 0.25), (0.85, 0.65), (0.55, 0.86), (0.25, 0.82),
             (0.1, 0.7), (0, 0.62)]
    pear = [(0, -0.95), (0.3, -1.0), (0.65, -0.85), (0.88, -0.45), (0.85, 0.0), (0.6, 0.5), (0.42, 0.95), (0.36, 1.3), (0.25, 1.52),
            (0, 1.58)]
    lemon = [(0, -1.35), (0.12, -1.3), (0.25, -1.1), (0.65, -0.75), (0.9, -0.2), (0.9, 0.2), (0.65, 0.75), (0.25, 1.1), (0.12, 1.3),
             (0, 1.35)]
    fruit(s, (0.02, 0.055, 0.005), apple, "apple", 0.036, 0.2, 30)
    fruit(s, (0.085, 0.056, -0.012), apple, "apple", 0.034, -0.35, 140)
    fruit(s, (0.055, 0.058, 0.055), pear, "pear", 0.029, 1.25, 65)
    for x, z, turn, tilt in ((-0.11, 0.16, 40, 1.5), (0.035, 0.2, -70, 1.5)):
        c, q = math.cos(tilt), math.sin(tilt)
        place = moved_and_turned(turn, (x, 0.0285, z))
        s.transform = lambda p, place=place, c=c, q=q: place((p[0], c * p[1] - q * p[2], q * p[1] + c * p[2]))
        lathe(s, [(0.03 * r, 0.03 * y) for r, y in lemon], "lemon", (0, 0, 0), 32)
        s.transform = STILL
    fruit(s, (-0.23, 0.034, 0.09), apple, "apple", 0.036, 0.1, 210)


def tiles(x, y):
    """A chessboard of black and gray stone with veins."""
    vein = (x * 5 + y * 9 + (x * y) % 7) % 17 == 0
    dark = (x // 32 + y // 32) % 2 == 0
    if x % 32 == 0 or y % 32 == 0:
        return 58, 56, 54
    return ((52, 50, 50) if vein else (34, 33, 34)) if dark else ((150, 146, 140) if vein else (168, 164, 156))


def bricks(x, y):
    row = y // 8
    seam = y % 8 == 0 or (x + 8 * (row % 2)) % 16 == 0
    tone = ((x + 8 * (row % 2)) // 16 * 37 + row * 53) % 30
    return (122, 112, 102) if seam else (118 + tone, 62 + tone // 2, 48 + tone // 3)


def bar():
    s = Scene("bar", "Bar",
              "a bar by night under 41 lamps of five kinds, which a mirror doubles",
              "A bar of 7 x 3.1 x 11 m by night: pendant lamps over counter and tables, candles, strips of light behind bottles,\n"
              "lamps on the wall; a mirror on the end wall doubles them.",
              ([1.75, 1.55, 4.6], [-0.5, 1.2, -1.2], [0, 1, 0], 55),
              {"plaster": ((0.5, 0.44, 0.36), None), "brick": (0.9, None, "map_Kd bricks.png"), "ceiling": ((0.2, 0.18, 0.17), None),
               "floor": (0.9, None, *plastic(0.25), "map_Kd tiles.png"), "wood": ((0.3, 0.15, 0.07), None, *plastic(0.3)),
               "panel": ((0.12, 0.17, 0.15), None, *plastic(0.35)), "top": ((0.1, 0.06, 0.04), None, *plastic(0.12)),
               "leather": ((0.33, 0.09, 0.06), None, *plastic(0.4)), "steel": (BLACK, None, *metal((0.6, 0.6, 0.62), 0.3)),
               "brass": (BLACK, None, *metal((0.88, 0.7, 0.36), 0.28)), "shade": ((0.75, 0.7, 0.6), None),
               "mirror": (BLACK, None, *metal((0.88, 0.89, 0.88), 0)), "glass": (BLACK, None, *glass()),
               "green": ((0.05, 0.2, 0.08), None, *plastic(0.05)), "amber": ((0.42, 0.17, 0.03), None, *plastic(0.05)),
               "clear": ((0.5, 0.55, 0.56), None, *plastic(0.05)), "red": ((0.4, 0.04, 0.04), None, *plastic(0.05)),
               "label": ((0.7, 0.66, 0.55), None), "bulb": (BLACK, (420, 270, 130)), "globe": (BLACK, (15, 10.5, 6)), "strip": (BLACK, (16, 10.5, 5)),
               "candle": (BLACK, (60, 30, 9)), "wax": ((0.8, 0.7, 0.5), None), "sconce": (BLACK, (26, 17, 8.5))},
              settings={"exposure": 2, "tonemap": "aces"})
    s.images = {"tiles.png": png(64, 64, tiles), "bricks.png": png(64, 64, bricks)}
    bar_room(s)
    bar_counter(s)
    bar_bottles(s)
    bar_tables(s)
    bar_lamps(s)
    s.knob("height", 0, [-0.35, 0.4], "by how much the pendant lamps hang higher, in meters",
           moves=[{"groups": ["pendants"], "by": [0, 1, 0]}],
           scales=[{"groups": [f"cords {round(100 * length)}"], "about": [0, BY1 - CLEAR, 0], "by": [0, round(-1 / length, 6), 0]}
                   for length in CORDS])
    return s


CORDS = (0.948, 1.048, 0.698)  # lengths of the cords of pendant lamps
BX0, BX1, BY1, BZ0, BZ1 = -3.5, 3.5, 3.1, -5.5, 5.5


def bar_room(s):
    s.group("room")
    s.painted_quad([(BX0, 0, BZ1), (BX1, 0, BZ1), (BX1, 0, BZ0), (BX0, 0, BZ0)], "floor", (7, 11))
    s.quad([(BX0, BY1, BZ0), (BX1, BY1, BZ0), (BX1, BY1, BZ1), (BX0, BY1, BZ1)], "ceiling")
    s.painted_quad([(BX1, 0, BZ0), (BX1, 0, BZ1), (BX1, BY1, BZ1), (BX1, BY1, BZ0)], "brick", (11, 4))
    s.painted_quad([(BX0, 0, BZ0), (BX1, 0, BZ0), (BX1, BY1, BZ0), (BX0, BY1, BZ0)], "brick", (7, 4))
    s.quad([(BX0, 0, BZ1), (BX0, 0, BZ0), (BX0, BY1, BZ0), (BX0, BY1, BZ1)], "plaster")
    s.quad([(BX1, 0, BZ1), (BX0, 0, BZ1), (BX0, BY1, BZ1), (BX1, BY1, BZ1)], "plaster")
    s.group("beams")
    for i in range(6):
        z = -4.6 + 1.8 * i
        s.box((BX0 + 0.001, BY1 - 0.22, z), (BX1 - 0.001, BY1 - 0.001, z + 0.16), "wood", ("top", "left", "right"))
    s.group("mirror", "on the end wall, in a frame of brass")
    z = BZ0 + 0.02
    s.quad([(0.0, 0.9, z), (2.6, 0.9, z), (2.6, 2.4, z), (0.0, 2.4, z)], "mirror")
    for low, high in (((-0.07, 0.83), (2.67, 0.9)), ((-0.07, 2.4), (2.67, 2.47)), ((-0.07, 0.9), (0.0, 2.4)), ((2.6, 0.9), (2.67, 2.4))):
        s.box((*low, BZ0 + 0.002), (*high, BZ0 + 0.045), "brass", ("back",))


def bar_counter(s):
    s.group("counter")
    x0, x1, z0, z1 = -2.05, -1.45, -4.6, 2.2
    s.box((x0, 0.001, z0), (x1 - 0.06, 1.06, z1 - 0.06), "panel", ("bottom",))
    rounded_box(s, (x0 - 0.03, 1.062, z0 - 0.03), (x1 + 0.04, 1.11, z1 + 0.04), 0.018, "top")
    for i in range(9):
        z = z0 + 0.08 + 0.74 * i
        s.box((x1 - 0.062, 0.16, z), (x1 - 0.045, 0.98, z + 0.62), "panel", ("left",))
    cord(s, (x1 + 0.12, 0.2, z0), (x1 + 0.12, 0.2, z1), 0.022, "brass", 14)
    s.group("stools")
    for i in range(7):
        x, z = -1.02, -4.1 + 0.95 * i
        lathe(s, [(0, 0), (0.2, 0), (0.2, 0.012), (0.03, 0.03), (0.026, 0.04), (0.026, 0.66), (0, 0.66)], "steel", (x, 0.001, z), 24)
        ring(s, (x, 0.3, z), 0.16, 0.011, "steel", columns=24, rows=8)
        lathe(s, [(0, 0), (0.16, 0), (0.175, 0.02), (0.178, 0.05), (0.165, 0.075), (0.1, 0.088), (0, 0.09)], "leather", (x, 0.662, z), 28)
    s.group("things", "on the counter")
    for i, z in enumerate((1.4, 0.9, -0.2, -1.9, -2.1, -3.3)):
        tumbler(s, (-1.72 + 0.07 * (i % 3), 1.111, z))


def tumbler(s, at):
    lathe(s, [(0, 0), (0.032, 0), (0.034, 0.004), (0.038, 0.1), (0.0362, 0.1), (0.0325, 0.012), (0, 0.011)], "glass", at, 24)


def bar_bottles(s):
    s.group("shelves", "behind the counter, with strips of light under them")
    x0, x1, z0, z1 = -3.49, -3.2, -4.6, 2.2
    s.box((x0, 0.001, z0), (x1 + 0.2, 0.94, z1), "panel", ("bottom", "left"))
    rounded_box(s, (x0, 0.942, z0 - 0.02), (x1 + 0.23, 0.98, z1 + 0.02), 0.012, "top")
    for y in (1.36, 1.78, 2.2):
        s.box((x0, y, z0), (x1, y + 0.03, z1), "wood", ("left",))
    for z in (z0, -2.35, -0.05, z1 - 0.03):
        s.box((x0, 0.981, z), (x1 - 0.01, 2.6, z + 0.03), "wood", ("left", "bottom"))
    s.group("strips")
    for y in (1.36, 1.78, 2.2):
        for a, b in ((z0 + 0.1, -2.4), (-2.25, -0.1), (0.05, z1 - 0.1)):
            s.quad([(x0 + 0.03, y - 0.004, a), (x0 + 0.05, y - 0.004, a), (x0 + 0.05, y - 0.004, b), (x0 + 0.03, y - 0.004, b)], "strip")
    s.group("bottles")
    dice = Dice(11)
    slim = [(0, 0), (0.036, 0), (0.037, 0.006), (0.037, 0.17), (0.014, 0.225), (0.013, 0.285), (0, 0.287)]
    wide = [(0, 0), (0.046, 0), (0.047, 0.006), (0.047, 0.14), (0.03, 0.165), (0.013, 0.18), (0.013, 0.22), (0, 0.222)]
    for y in (1.391, 1.811, 2.231):
        z = z0 + 0.12
        while z < z1 - 0.12:
            if min(abs(z - 0.015 - b) for b in (z0, -2.35, -0.05, z1 - 0.03)) > 0.075:
                lathe(s, dice.of((slim, slim, wide)), dice.of(("green", "amber", "clear", "amber", "red")),
                      (x0 + 0.17 + dice.between(-0.03, 0.04), y, z), 14)
            z += dice.between(0.11, 0.2)


def bar_tables(s):
    s.group("tables")
    for i, (x, z) in enumerate(((2.3, -4.2), (2.3, -2.1), (2.3, 0.0), (2.3, 2.1), (0.45, -3.6), (0.55, -1.1))):
        lathe(s, [(0, 0), (0.26, 0), (0.27, 0.012), (0.05, 0.04), (0.035, 0.07), (0.035, 0.7), (0.05, 0.718), (0, 0.718)], "steel", (x, 0.001, z), 24)
        lathe(s, [(0, 0), (0.39, 0), (0.4, 0.01), (0.4, 0.024), (0.39, 0.032), (0, 0.032)], "wood", (x, 0.72, z), 40)
        lathe(s, [(0, 0), (0.035, 0), (0.042, 0.05), (0.0385, 0.05), (0.033, 0.012), (0, 0.012)], "glass", (x + 0.08, 0.7535, z - 0.06), 20)
        lathe(s, [(0, 0), (0.016, 0), (0.016, 0.018), (0, 0.018)], "wax", (x + 0.08, 0.767, z - 0.06), 12)
        lathe(s, [(0, 0), (0.004, 0.004), (0.005, 0.01), (0, 0.024)], "candle", (x + 0.08, 0.787, z - 0.06), 8)
        tumbler(s, (x - 0.14, 0.7535, z + 0.1))
        for turn in ((100, 250) if i % 2 else (70, 280)):
            chair(s, (x, z), turn)


def chair(s, about, turn):
    """Looks at the table from 0.62 m."""
    a = math.radians(turn)
    s.transform = moved_and_turned(turn, (about[0] - 0.62 * math.sin(a), 0.001, about[1] - 0.62 * math.cos(a)))
    rounded_box(s, (-0.2, 0.43, -0.2), (0.2, 0.48, 0.2), 0.022, "leather")
    rounded_box(s, (-0.2, 0.62, -0.235), (0.2, 0.86, -0.195), 0.018, "leather")
    for x in (-0.175, 0.175):
        tube(s, (x, 0, -0.215), (x, 0.64, -0.205), 0.014, "wood", 8)
        tube(s, (x, 0, 0.175), (x, 0.44, 0.165), 0.014, "wood", 8)
    s.transform = STILL


def bar_lamps(s):
    s.group("pendants", "over the counter shades of brass, white inside, with a bulb each; over the tables globes of opal glass")
    shades = [(-1.72, 1.95, -4.2 + 0.85 * i) for i in range(8)]
    for x, y, z in shades:
        lathe(s, [(0.16, 0), (0.15, 0.03), (0.11, 0.09), (0.05, 0.14), (0.022, 0.155), (0.022, 0.2), (0, 0.205)], "brass", (x, y, z), 32)
        lathe(s, [(0, 0.148), (0.046, 0.134), (0.106, 0.086), (0.147, 0.027), (0.16, 0)], "shade", (x, y, z), 32)
        ball(s, (x, y + 0.045, z), 0.035, "bulb", 6, 10)
    globes = [(2.3, 1.95, -4.2 + 2.1 * i) for i in range(5)] + [(0.45, 2.05, -3.6), (0.55, 2.05, -1.1), (0.5, 2.05, 1.6)]
    globes += [(-0.75, 2.3, -4.6 + 1.8 * i) for i in range(5)]
    for x, y, z in globes:
        ball(s, (x, y, z), 0.1, "globe", 8, 14)
        lathe(s, [(0.045, 0), (0.045, 0.03), (0.015, 0.045), (0, 0.046)], "brass", (x, y + 0.085, z), 20)
    tops = [(x, y + 0.19, z) for x, y, z in shades] + [(x, y + 0.09, z) for x, y, z in globes]
    for length in CORDS:
        s.group(f"cords {round(100 * length)}", "from the ceiling into the lamps; they stretch with the knob")
        for x, y, z in tops:
            if abs(BY1 - CLEAR - y - length) < 0.06:
                cord(s, (x, BY1 - CLEAR - length, z), (x, BY1 - CLEAR, z), 0.006, "top", 6)
    s.group("sconces", "on the brick wall, lit upwards and downwards")
    for z in (-4.9, -3.15, -1.05, 1.05, 3.15):
        x, y = BX1 - 0.07, 1.85
        tube(s, (x, y - 0.1, z), (x, y + 0.1, z), 0.05, "brass", 20)
        for side in (-1, 1):
            lamp = [(0.0, 0.0), (0.047, 0.0)] if side < 0 else [(0.047, 0.0), (0.0, 0.0)]
            lathe(s, lamp, "sconce", (x, y + side * 0.06, z), 20)
