"""Curved shapes with smooth normals: bodies of revolution, rounded boxes, tubes, rings, sheets. Their fronts are outside."""
import math

CREASE_DEG = 40  # sharper edges of a profile stay edges


def unit(v):
    length = math.sqrt(sum(x * x for x in v))
    return tuple(x / length for x in v) if length > 0 else tuple(v)


def lathe(s, profile, material, center=(0, 0, 0), columns=32):
    """`profile`: points (radius, height) that go up along the outside and down along the inside; a radius of 0 is a pole."""
    points, first, normals, faces = [], [], [], []
    around = [(math.sin(2 * math.pi * k / columns), math.cos(2 * math.pi * k / columns)) for k in range(columns)]
    for r, y in profile:
        first.append(len(points))
        points += [(center[0] + r * x, center[1] + y, center[2] + r * z) for x, z in (around if r > 0 else around[:1])]
    slopes = [unit((y1 - y0, r0 - r1)) for (r0, y0), (r1, y1) in zip(profile, profile[1:])]
    smooth = math.cos(math.radians(CREASE_DEG))

    def ring_of_normals(i, segment):
        """At a profile point, for one of the segments beside it: the mean of both, unless there is an edge between them."""
        other = i - 1 if segment == i else i
        own = slopes[segment]
        if 0 <= other < len(slopes) and other != segment:
            out, up = slopes[other]
            if own[0] * out + own[1] * up > smooth:
                own = unit((own[0] + out, own[1] + up))
        if profile[i][0] == 0:
            own = (0.0, 1.0 if own[1] > 0 else -1.0)
        normals.extend((own[0] * x, own[1], own[0] * z) for x, z in around)
        return len(normals) - columns

    for i in range(len(slopes)):
        low, high = ring_of_normals(i, i), ring_of_normals(i + 1, i)
        for k in range(columns):
            n = (k + 1) % columns
            a, b = (first[i] + k, low + k), (first[i] + n, low + n)
            c, d = (first[i + 1] + n, high + n), (first[i + 1] + k, high + k)
            if profile[i][0] == 0:
                faces.append([(first[i], low + k), c, d])
            elif profile[i + 1][0] == 0:
                faces.append([a, b, (first[i + 1], high + k)])
            else:
                faces.append([a, b, c, d])
    s.smooth_mesh(points, normals, material, faces)


def ball(s, center, radius, material, rows=8, columns=16):
    """A sphere of few faces."""
    profile = [(radius * math.sin(math.pi * i / rows) if 0 < i < rows else 0, -radius * math.cos(math.pi * i / rows))
               for i in range(rows + 1)]
    lathe(s, profile, material, center, columns)


def rounded_box(s, low, high, radius, material, steps=2):
    """A box with edges of this radius."""
    half = [(b - a) / 2 for a, b in zip(low, high)]
    middle = [(a + b) / 2 for a, b in zip(low, high)]
    points, normals, faces = [], [], []

    def ticks(h):
        """From -h to h; the rounded ends in equal angles."""
        r = min(radius, h)
        ends = [r * (1 - math.tan(math.pi / 4 * (1 - i / steps))) for i in range(steps + 1)]
        return [-h + e for e in ends] + [h - e for e in reversed(ends)]

    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for side in (1, -1):
            first, us, vs = len(points), ticks(half[u]), ticks(half[v])
            for b in vs:
                for a in us:
                    q = [0.0, 0.0, 0.0]
                    q[axis], q[u], q[v] = side * half[axis], side * a, b
                    core = [max(-(h - min(radius, h)), min(h - min(radius, h), x)) for h, x in zip(half, q)]
                    n = unit([x - c for x, c in zip(q, core)])
                    points.append(tuple(m + c + min(radius, *half) * x for m, c, x in zip(middle, core, n)))
                    normals.append(n)
            for j in range(len(vs) - 1):
                for i in range(len(us) - 1):
                    at = first + j * len(us) + i
                    faces.append([(k, k) for k in (at, at + 1, at + len(us) + 1, at + len(us))])
    s.smooth_mesh(points, normals, material, faces)


def cord(s, start, end, radius, material, columns=8, pieces=12):
    """A thin tube in pieces, because points on very long and narrow triangles are inexact."""
    places = [tuple(a + (b - a) * i / pieces for a, b in zip(start, end)) for i in range(pieces + 1)]
    for a, b in zip(places, places[1:]):
        tube(s, a, b, radius, material, columns)


def tube(s, start, end, radius, material, columns=10, end_radius=None):
    """A cylinder or cone between two points, without ends."""
    along = unit([b - a for a, b in zip(start, end)])
    helper = (1, 0, 0) if abs(along[0]) < 0.9 else (0, 1, 0)
    x = unit([along[1] * helper[2] - along[2] * helper[1], along[2] * helper[0] - along[0] * helper[2],
              along[0] * helper[1] - along[1] * helper[0]])
    z = [along[1] * x[2] - along[2] * x[1], along[2] * x[0] - along[0] * x[2], along[0] * x[1] - along[1] * x[0]]
    out = [tuple(math.cos(t) * a + math.sin(t) * b for a, b in zip(x, z))
           for t in (2 * math.pi * k / columns for k in range(columns))]
    points = [tuple(p + r * o for p, o in zip(place, way))
              for place, r in ((start, radius), (end, radius if end_radius is None else end_radius)) for way in out]
    faces = [[(k, k), ((k + 1) % columns, (k + 1) % columns), (columns + (k + 1) % columns, (k + 1) % columns),
              (columns + k, k)] for k in range(columns)]
    s.smooth_mesh(points, out, material, faces)


def ring(s, center, large, small, material, turn=lambda p: p, columns=24, rows=10, share=1.0):
    """A torus about the vertical axis, or this share of it; `turn` moves its points, as a motion about the center."""
    points, normals, faces = [], [], []
    count = columns if share >= 1 else columns + 1
    for i in range(count):
        a = 2 * math.pi * share * i / columns
        for k in range(rows):
            b = 2 * math.pi * k / rows
            n = turn((math.cos(b) * math.sin(a), math.sin(b), math.cos(b) * math.cos(a)))
            p = turn(((large + small * math.cos(b)) * math.sin(a), small * math.sin(b), (large + small * math.cos(b)) * math.cos(a)))
            points.append(tuple(c + x for c, x in zip(center, p)))
            normals.append(n)
    for i in range(columns):
        j = (i + 1) % count
        for k in range(rows):
            n = (k + 1) % rows
            faces.append([(c, c) for c in (i * rows + k, j * rows + k, j * rows + n, i * rows + n)])
    s.smooth_mesh(points, normals, material, faces)


def sheet(s, place, columns, rows, material, uv_scale=None):
    """The surface place(u, v), u and v from 0 to 1; its front is where u runs to the right and v up."""
    e = 1e-4
    points, normals, faces, uvs = [], [], [], []
    for j in range(rows + 1):
        for i in range(columns + 1):
            u, v = i / columns, j / rows
            points.append(place(u, v))
            along = [b - a for a, b in zip(place(u - e, v), place(u + e, v))]
            up = [b - a for a, b in zip(place(u, v - e), place(u, v + e))]
            normals.append(unit((along[1] * up[2] - along[2] * up[1], along[2] * up[0] - along[0] * up[2],
                                 along[0] * up[1] - along[1] * up[0])))
            if uv_scale:
                uvs.append((u * uv_scale[0], v * uv_scale[1]))
    for j in range(rows):
        for i in range(columns):
            at = j * (columns + 1) + i
            for corners in ((at, at + 1, at + columns + 2), (at, at + columns + 2, at + columns + 1)):
                faces.append([(c, c, c) if uv_scale else (c, c) for c in corners])
    s.smooth_mesh(points, normals, material, faces, uvs)


class Dice:
    """Numbers that look random and are the same everywhere."""

    def __init__(self, seed):
        self.state = seed

    def between(self, low, high):
        self.state = (1103515245 * self.state + 12345) % 2 ** 31
        return low + (high - low) * (self.state >> 8) / 2 ** 23

    def of(self, choices):
        return choices[int(self.between(0, len(choices) - 1e-6))]
