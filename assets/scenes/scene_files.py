"""What scenes are made of: their text files, images, and shapes. See make_scenes.py."""
import json
import math
import re
import struct
import zlib

CLEAR = 0.002  # between a lamp and the wall behind it
BLACK = (0, 0, 0)


def number(x):
    text = f"{x:.6f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def turned_y(degrees, about):
    """Rotation about the vertical axis through (x, z), counter-clockwise seen from above."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))

    def turn(p):
        x, z = p[0] - about[0], p[2] - about[1]
        return (about[0] + c * x + s * z, p[1], about[1] - s * x + c * z)

    return turn


def png(width, height, texel):
    """An 8-bit RGB image of texel(column, row), rows from the top. Uncompressed, because versions of zlib compress differently."""
    rows = b"".join(b"\0" + bytes(c for x in range(width) for c in texel(x, y)) for y in range(height))
    blocks = [rows[i:i + 0xffff] for i in range(0, len(rows), 0xffff)]
    stored = b"\x78\x01" + b"".join(
        struct.pack("<BHH", block is blocks[-1], len(block), 0xffff - len(block)) + block for block in blocks)
    stored += struct.pack(">I", zlib.adler32(rows))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
            chunk(b"IDAT", stored) + chunk(b"IEND", b""))


def hdr(width, height, radiance):
    """A Radiance picture of radiance(column, row), not compressed."""
    def texel(color):
        exponent = math.frexp(max(color))[1]
        return bytes(int(math.ldexp(c, 8 - exponent)) for c in color) + bytes([exponent + 128])

    return (f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n".encode() +
            b"".join(texel(radiance(x, y)) for y in range(height) for x in range(width)))


class Scene:
    # Corners of a box by number: bit 0 is x, bit 1 is y, bit 2 is z; counter-clockwise from outside.
    SIDES = {"left": (0, 4, 6, 2), "right": (5, 1, 3, 7), "bottom": (0, 1, 5, 4), "top": (6, 7, 3, 2),
             "back": (1, 0, 2, 3), "front": (4, 5, 7, 6)}

    def __init__(self, name, title, shows, about, camera, materials, unit="meter", **more):
        self.name, self.about, self.unit = name, about, unit
        self.materials = materials
        self.json = {"schema": "pathlight.scene/1", "name": title, "summary": shows, "obj": f"{name}.obj",
                     "camera": dict(zip(("eye", "target", "up", "fov_deg"), camera)), **more}
        self.lines, self.vertices, self.normals, self.uvs, self.triangles = [], 0, 0, 0, 0
        self.images = {}  # file name -> bytes
        self.transform = lambda p: p

    def group(self, name, comment=None):
        self.lines += ["", f"o {name}"] + ([f"# {comment}"] if comment else [])

    def mesh(self, points, faces):
        """Faces are (material, corner numbers from 0); the corners are shared."""
        for p in points:
            self.lines.append("v " + " ".join(number(x) for x in self.transform(p)))
        last = None
        for material, corners in faces:
            if material != last:
                self.lines.append(f"usemtl {material}")
                last = material
            self.lines.append("f " + " ".join(str(self.vertices + i + 1) for i in corners))
            self.triangles += len(corners) - 2
        self.vertices += len(points)

    def box(self, low, high, material, without=(), inside=False):
        """`material` is a name, or one for each side with "" for the others."""
        points = [tuple((high if i >> k & 1 else low)[k] for k in range(3)) for i in range(8)]
        paint = material if isinstance(material, dict) else {"": material}
        self.mesh(points, [(paint.get(side, paint[""]), corners[::-1] if inside else corners)
                           for side, corners in self.SIDES.items() if side not in without])

    def room(self, low, high, material, without=()):
        self.group("room")
        self.box(low, high, material, without, inside=True)

    def quad(self, corners, material):
        self.mesh(corners, [(material, range(len(corners)))])

    def painted_quad(self, corners, material, repeats=(1, 1)):
        """Four corners from the image's lower left, counter-clockwise; the image is there so many times to the right and up."""
        uvs = ((0, 0), (repeats[0], 0), repeats, (0, repeats[1]))
        for p, uv in zip(corners, uvs):
            self.lines += ["v " + " ".join(number(x) for x in self.transform(p)), "vt " + " ".join(number(x) for x in uv)]
        self.lines += [f"usemtl {material}",
                       "f " + " ".join(f"{self.vertices + i + 1}/{self.uvs + i + 1}" for i in range(4))]
        self.vertices += 4
        self.uvs += 4
        self.triangles += 2

    def slab(self, outline, bottom, top, material, without=()):
        """`outline`: corners (x, z), counter-clockwise seen from above; edges in `without` get no face."""
        n = len(outline)
        points = [(x, y, z) for y in (bottom, top) for x, z in outline]
        sides = [(i, (i + 1) % n, n + (i + 1) % n, n + i) for i in range(n) if i not in without]
        self.mesh(points, [(material, corners) for corners in sides] +
                  [(material, tuple(range(n, 2 * n))), (material, tuple(reversed(range(n))))])

    def smooth_mesh(self, points, normals, material, faces, uvs=()):
        """Faces are lists of (point, normal) or, with image coordinates, (point, normal, uv), numbered from 0. The transform has to
        be a motion, which turns the normals, too."""
        self.lines += ["v " + " ".join(number(x) for x in self.transform(p)) for p in points]
        origin = self.transform((0, 0, 0))
        for n in normals:
            turned = [a - b for a, b in zip(self.transform(n), origin)]
            self.lines.append("vn " + " ".join(number(x) for x in turned))
        self.lines += ["vt " + " ".join(number(x) for x in uv) for uv in uvs]
        self.lines.append(f"usemtl {material}")
        for face in faces:
            words = [f"{self.vertices + c[0] + 1}/{self.uvs + c[2] + 1 if uvs else ''}/{self.normals + c[1] + 1}" for c in face]
            self.lines.append("f " + " ".join(words))
            self.triangles += len(face) - 2
        self.vertices += len(points)
        self.normals += len(normals)
        self.uvs += len(uvs)

    def sphere(self, center, radius, material, rows, columns):
        """From rings of corners, with normals of the true sphere; the poles are up and down."""
        directions = [(0, 1, 0)]
        for i in range(1, rows):
            up, out = math.cos(math.pi * i / rows), math.sin(math.pi * i / rows)
            directions += [(out * math.sin(2 * math.pi * k / columns), up, out * math.cos(2 * math.pi * k / columns))
                           for k in range(columns)]
        directions.append((0, -1, 0))
        ring = [[1 + i * columns + k % columns for k in range(columns + 1)] for i in range(rows - 1)]
        last = len(directions) - 1
        faces = [(0, ring[0][k], ring[0][k + 1]) for k in range(columns)]
        faces += [(a[k], b[k], b[k + 1], a[k + 1]) for a, b in zip(ring, ring[1:]) for k in range(columns)]
        faces += [(ring[-1][k], last, ring[-1][k + 1]) for k in range(columns)]
        for d in directions:
            self.lines.append("v " + " ".join(number(c + radius * x) for c, x in zip(center, d)))
        self.lines += ["vn " + " ".join(number(x) for x in d) for d in directions] + [f"usemtl {material}"]
        for corners in faces:
            self.lines.append("f " + " ".join(f"{self.vertices + i + 1}//{self.normals + i + 1}" for i in corners))
            self.triangles += len(corners) - 2
        self.vertices += len(directions)
        self.normals += len(directions)

    def knob(self, name, default, range_, does, **motions):
        self.json.setdefault("knobs", {})[name] = {"default": default, "range": range_, "does": does, **motions}

    def files(self):
        head = [f"# {line}" for line in self.about.split("\n")]
        obj = head + [f"# Unit: {self.unit}, +y up. Written by make_scenes.py.", f"mtllib {self.name}.mtl"] + self.lines
        mtl = []
        for name, (albedo, emission, *more) in self.materials.items():
            albedo = albedo if isinstance(albedo, tuple) else (albedo,) * 3
            mtl += [f"newmtl {name}", "Kd " + " ".join(number(x) for x in albedo)]
            if emission:
                emission = emission if isinstance(emission, tuple) else (emission,) * 3
                mtl.append("Ke " + " ".join(number(x) for x in emission))
            mtl += more
            mtl.append("")
        text = json.dumps(self.json, indent=2)
        text = re.sub(r"\[[^][{}]*\]", lambda array: re.sub(r"\s+", " ", array[0]).replace("[ ", "[").replace(" ]", "]"),
                      text)
        texts = {"obj": "\n".join(obj) + "\n", "mtl": "\n".join(mtl[:-1]) + "\n", "json": text + "\n"}
        return {**{f"{self.name}.{suffix}": text.encode() for suffix, text in texts.items()}, **self.images}
