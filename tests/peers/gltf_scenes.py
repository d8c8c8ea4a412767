"""Scenes for Blender as .glb, which pathlight opens as they are."""
import json
import math
import struct

WIDTH, HEIGHT = 64, 48


class Glb:
    def __init__(self):
        self.root = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": [],
                     "accessors": [], "bufferViews": [], "materials": [],
                     "extensionsUsed": ["KHR_materials_specular", "KHR_materials_emissive_strength",
                                        "KHR_materials_transmission", "KHR_materials_ior", "KHR_materials_volume"]}
        self.binary = b""

    def accessor(self, values, component, kind, count, **more):
        self.root["bufferViews"].append({"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(values)})
        self.binary += values + b"\0" * (-len(values) % 4)
        self.root["accessors"].append({"bufferView": len(self.root["bufferViews"]) - 1, "componentType": component,
                                       "type": kind, "count": count, **more})
        return len(self.root["accessors"]) - 1

    def node(self, **members):
        self.root["nodes"].append(members)
        self.root["scenes"][0]["nodes"].append(len(self.root["nodes"]) - 1)

    def material(self, color, metal=0.0, rough=1.0, **extensions):
        self.root["materials"].append({
            "name": f"material {len(self.root['materials'])}", "doubleSided": False,
            "pbrMetallicRoughness": {"baseColorFactor": [*color, 1], "metallicFactor": metal, "roughnessFactor": rough},
            "extensions": extensions})
        return len(self.root["materials"]) - 1

    def matte(self, color):
        return self.material(color, KHR_materials_specular={"specularFactor": 0})

    def lamp(self, radiance):
        strongest = max(radiance)
        number = self.material((0, 0, 0), KHR_materials_specular={"specularFactor": 0},
                               KHR_materials_emissive_strength={"emissiveStrength": strongest})
        self.root["materials"][number]["emissiveFactor"] = [c / strongest for c in radiance]
        return number

    def glass(self):
        return self.material((1, 1, 1), rough=0, KHR_materials_transmission={"transmissionFactor": 1},
                             KHR_materials_ior={"ior": 1.5}, KHR_materials_volume={"thicknessFactor": 1})

    def quads(self, faces, material):
        """Each a list of four corners, counter-clockwise seen from the front."""
        corners = [c for face in faces for c in face]
        indices = [4 * i + k for i in range(len(faces)) for k in (0, 1, 2, 0, 2, 3)]
        bounds = {"min": [min(c[k] for c in corners) for k in range(3)], "max": [max(c[k] for c in corners) for k in range(3)]}
        position = self.accessor(b"".join(struct.pack("<3f", *c) for c in corners), 5126, "VEC3", len(corners), **bounds)
        index = self.accessor(struct.pack(f"<{len(indices)}H", *indices), 5123, "SCALAR", len(indices))
        self.root["meshes"].append({"primitives": [{"attributes": {"POSITION": position}, "indices": index, "material": material}]})
        self.node(mesh=len(self.root["meshes"]) - 1)

    def box(self, low, high, material, degrees=0, painted=None):
        """`painted` maps sides to other materials."""
        middle = [(a + b) / 2 for a, b in zip(low, high)]
        c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))

        def corner(i):
            p = [(high if i >> k & 1 else low)[k] - middle[k] for k in range(3)]
            return (middle[0] + c * p[0] + s * p[2], middle[1] + p[1], middle[2] - s * p[0] + c * p[2])

        sides = {"left": (0, 4, 6, 2), "right": (5, 1, 3, 7), "bottom": (0, 1, 5, 4), "top": (6, 7, 3, 2),
                 "back": (1, 0, 2, 3), "front": (4, 5, 7, 6)}
        for paint in {material, *(painted or {}).values()}:
            self.quads([[corner(i) for i in corners] for side, corners in sides.items()
                        if (painted or {}).get(side, material) == paint], paint)

    def camera(self, eye, target, fov_deg):
        """Looks along -z of its node."""
        z = [a - b for a, b in zip(eye, target)]
        length = math.hypot(*z)
        z = [c / length for c in z]
        x = [z[2], 0, -z[0]]
        length = math.hypot(*x)
        x = [c / length for c in x]
        y = [z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]]
        self.root["cameras"] = [{"type": "perspective", "perspective": {
            "yfov": math.radians(fov_deg), "aspectRatio": WIDTH / HEIGHT, "znear": 0.01, "zfar": 100}}]
        self.node(camera=0, matrix=[*x, 0, *y, 0, *z, 0, *eye, 1])

    def bytes(self):
        self.root["buffers"] = [{"byteLength": len(self.binary)}]
        text = json.dumps(self.root).encode()
        text += b" " * (-len(text) % 4)
        return (struct.pack("<4sII", b"glTF", 2, 12 + 16 + len(text) + len(self.binary)) +
                struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(self.binary), b"BIN\0") + self.binary)


def room(tall, short):
    """The room of mitsuba_scenes.room() with two blocks, whose materials two functions of the file give. Emitting surfaces shine to
    both sides in Cycles: the lamp is the lower side of a closed black box. It is above the picture: all seeds of Cycles share 256
    patterns of samples, so its border would be off by the same amount in a whole row of pixels."""
    g = Glb()
    white, red, green = g.matte((0.73, 0.71, 0.68)), g.matte((0.63, 0.065, 0.05)), g.matte((0.14, 0.45, 0.091))
    black, lamp = g.matte((0, 0, 0)), g.lamp((17, 12, 4))
    g.quads([[(-1, 0, 1), (1, 0, 1), (1, 0, -1), (-1, 0, -1)], [(-1, 2, -1), (1, 2, -1), (1, 2, 1), (-1, 2, 1)],
             [(-1, 0, -1), (1, 0, -1), (1, 2, -1), (-1, 2, -1)]], white)
    g.quads([[(-1, 0, 1), (-1, 0, -1), (-1, 2, -1), (-1, 2, 1)]], red)
    g.quads([[(1, 0, -1), (1, 0, 1), (1, 2, 1), (1, 2, -1)]], green)
    g.box((-0.25, 1.93, -0.25), (0.25, 1.98, 0.25), black, painted={"bottom": lamp})
    g.box((-0.65, -0.01, -0.6), (-0.05, 1.19, 0), tall(g), 18)
    g.box((0.05, 0.01, 0), (0.65, 0.59, 0.6), short(g), -17)
    g.camera((0, 1, 3.6), (0, 0.7, 0), 32)
    return g.bytes()
