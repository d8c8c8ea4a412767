#!/usr/bin/env python3
"""Which effects the processor executed instructions of, told by the lines of source they come from.

Usage: check_effect_lines.py PATHLIGHT quick|all

Renders small pictures under valgrind's callgrind, which counts instructions per line. The Cornell box and rooms that need no
effect must not execute a single one of an effect's file; a scene that needs the effect must, or this test would see nothing.
Exit code 77: there is no valgrind.
"""
import json
import struct
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from callgrind import count_instructions, require_valgrind, sum_by

# File of core/kernel: a scene that needs it.
EFFECTS = {
    "shading/fresnel.h": "spheres",
    "shading/conductor.h": "plates",
    "shading/dielectric.h": "coats",
    "shading/microfacet.h": "plates",
    "shading/plastic.h": "coats",
    "shading/directional_albedo.h": "coats",
    "shading/environment_map.h": "textured-room",
    "shading/far_lights.h": "textured-room",
    "scene/texture.h": "textured-room",
    "base/hash.h": str(Path(__file__).with_name("ink.json")),
    "scene/normal_map.h": str(Path(__file__).with_name("relief.obj")),
    "shading/light_tree.h": "gallery",
    "shading/delta_lights.h": str(Path(__file__).with_name("ink.json")),
    "shading/absorption.h": str(Path(__file__).with_name("ink.json")),
    "shading/blends.h": str(Path(__file__).with_name("rust.json")),
    "shading/anisotropy.h": str(Path(__file__).with_name("brush.json")),
    "shading/velvet.h": str(Path(__file__).with_name("cloth.json")),
    "geometry/instance_traversal.h": "instances",
}
PLAIN = (["cornell", "--nee", "off"], ["cornell", "--nee", "on"], ["cornell", "--method", "reinforcement", "--nee", "on"],
         ["cornell", "--method", "precomputed", "--bins", "16"], ["door", "--nee", "on"], ["sky", "--nee", "on"])


def write_instances(folder):
    """A glTF file of a mesh of ten thousand triangles that is shown 250 times: too often for copies."""
    columns, rows = 100, 50
    positions = [(0.01 * x, 0.1 * ((x + y) % 2), -0.02 * y) for y in range(rows + 1) for x in range(columns + 1)]
    triangles = []
    for y in range(rows):
        for x in range(columns):
            a = y * (columns + 1) + x
            triangles += [a, a + 1, a + columns + 2, a, a + columns + 2, a + columns + 1]
    data = b"".join(struct.pack("<3f", *p) for p in positions)
    indices = len(data)
    data += struct.pack(f"<{len(triangles)}I", *triangles)
    (folder / "mesh.bin").write_bytes(data)
    nodes = [{"mesh": 0, "translation": [i % 16, 0, i // 16]} for i in range(250)]
    gltf = {"asset": {"version": "2.0"}, "scenes": [{"nodes": list(range(250))}], "nodes": nodes,
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
            "buffers": [{"uri": "mesh.bin", "byteLength": len(data)}],
            "bufferViews": [{"buffer": 0, "byteLength": indices},
                            {"buffer": 0, "byteOffset": indices, "byteLength": len(data) - indices}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(positions), "type": "VEC3",
                           "min": [0, 0, -0.02 * rows], "max": [0.01 * columns, 0.1, 0]},
                          {"bufferView": 1, "componentType": 5125, "count": len(triangles), "type": "SCALAR"}]}
    path = folder / "instances.gltf"
    path.write_text(json.dumps(gltf))
    return str(path)


def instructions_by_file(program, arguments):
    """Instructions executed, by file of source, where the program knows its lines."""
    with tempfile.TemporaryDirectory() as folder:
        if arguments[0] == "instances":
            arguments = [write_instances(Path(folder)), *arguments[1:]]
        command = [program, "render", *arguments, "--spp", "2", "--size", "16x16", "--volumes", "50", "--threads", "1",
                   "--output", str(Path(folder) / "picture.pfm")]
        return sum_by(count_instructions(command), 0)


def spent_in(counts, file):
    return sum(count for name, count in counts.items() if name.endswith("core/kernel/" + file))


# Left out by the quick check: many runs under callgrind take long.
QUICK_PLAIN = PLAIN[2:3]
QUICK_SCENES = ("coats", "instances", *(str(Path(__file__).with_name(f"{name}.json")) for name in ("ink", "rust", "brush", "cloth")))


def main():
    if len(sys.argv) != 3 or sys.argv[2] not in ("quick", "all"):
        sys.exit(__doc__)
    is_quick = sys.argv[2] == "quick"
    effects = {file: scene for file, scene in EFFECTS.items() if not is_quick or scene in QUICK_SCENES}
    require_valgrind()
    failures = []
    for arguments in QUICK_PLAIN if is_quick else PLAIN:
        counts = instructions_by_file(sys.argv[1], arguments)
        in_kernel = sum(count for name, count in counts.items() if "core/kernel/" in name)
        print(f"{' '.join(arguments)}: {in_kernel} instructions of the kernel")
        if in_kernel == 0:
            failures.append(f"{arguments}: no line of the kernel is known")
        for file in EFFECTS:
            if spent_in(counts, file):
                failures.append(f"{arguments}: expected none of {file}, got {spent_in(counts, file)} instructions")
    profiles = {scene: instructions_by_file(sys.argv[1], [scene, "--nee", "on"]) for scene in set(effects.values())}
    for file, scene in effects.items():
        spent = spent_in(profiles[scene], file)
        print(f"{scene}: {spent} instructions of {file}")
        if spent == 0:
            failures.append(f"{scene} needs {file}: expected instructions of it, got none")
    # Metals, glass and coats without images have a kernel without anisotropy and velvet.
    for file in ("shading/anisotropy.h", "shading/velvet.h"):
        if spent_in(profiles["coats"], file):
            failures.append(f"coats: expected none of {file}, got instructions of it")
    if failures:
        sys.exit("FAILED:\n" + "\n".join(failures))


if __name__ == "__main__":
    main()
