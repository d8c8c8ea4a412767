#!/usr/bin/env python3
"""Writes a shipped scene of diffuse surfaces, metals, plastics and glass as a Mitsuba 3 scene, for run_speed.py.

    mitsuba_from_obj.py assets/scenes/NAME/NAME.json FOLDER

FOLDER gets NAME.xml and an OBJ file for each material. Textures, knobs, skies and other options of scene files are refused.
"""
import json
import sys
from pathlib import Path

KNOWN_OPTIONS = {"schema", "name", "obj", "camera", "summary"}
KNOWN_WORDS = {"Kd", "Ks", "Ke", "Pm", "Tf", "Ni", "illum", "Pl_roughness", "Pl_surface", "Pl_ior"}


def read_materials(path):
    """{material: {word: arguments}} of an MTL file."""
    materials, current = {}, None
    for words in map(str.split, path.read_text().splitlines()):
        if not words or words[0].startswith("#"):
            continue
        if words[0] == "newmtl":
            current = materials.setdefault(words[1], {})
        elif words[0] in KNOWN_WORDS:
            current[words[0]] = words[1:]
        else:
            sys.exit(f"{path}: expected one of {', '.join(sorted(KNOWN_WORDS))}, got '{words[0]}'")
    return materials


def split_by_material(path):
    """{material: text of an OBJ file with its faces and the vertices that these need}."""
    rows, faces, current = {"v": [], "vt": [], "vn": []}, {}, None
    for line in path.read_text().splitlines():
        words = line.split()
        if words and words[0] in rows:
            rows[words[0]].append(line)
        elif words and words[0] == "usemtl":
            current = words[1]
        elif words and words[0] == "f":
            faces.setdefault(current, []).append(words[1:])
    return {material: obj_of(rows, corners) for material, corners in faces.items()}


def obj_of(rows, faces):
    numbers = {kind: {} for kind in rows}

    def renumbered(kind, text):
        if not text:
            return ""
        number = int(text) - 1 if int(text) > 0 else len(rows[kind]) + int(text)
        return str(numbers[kind].setdefault(number, len(numbers[kind])) + 1)

    lines = []
    for face in faces:
        corners = ("/".join(renumbered(kind, part) for kind, part in zip(rows, corner.split("/"))) for corner in face)
        lines.append("f " + " ".join(corners))
    return "\n".join([rows[kind][number] for kind in rows for number in numbers[kind]] + lines) + "\n"


def rgb(name, words):
    return f'<rgb name="{name}" value="{",".join(words)}"/>'


def bsdf(material):
    alpha = float(material.get("Pl_roughness", ["0"])[0]) ** 2
    rough = "rough" if alpha > 0 else ""
    facets = f'<string name="distribution" value="ggx"/><float name="alpha" value="{alpha}"/>' if rough else ""
    if "Tf" in material:
        return (f'<bsdf type="{rough}dielectric">{facets}<float name="int_ior" value="{material["Ni"][0]}"/>'
                f'{rgb("specular_transmittance", material["Tf"])}</bsdf>')
    if float(material.get("Pm", ["0"])[0]) == 1:
        inside = (f'<bsdf type="{rough}conductor">{facets}<string name="material" value="none"/>'
                  f'{rgb("specular_reflectance", material["Ks"])}</bsdf>')
    elif material.get("Pl_surface") == ["plastic"]:
        inside = (f'<bsdf type="{rough}plastic">{facets}<float name="int_ior" value="{material["Pl_ior"][0]}"/>'
                  f'{rgb("diffuse_reflectance", material["Kd"])}</bsdf>')
    else:
        inside = f'<bsdf type="diffuse">{rgb("reflectance", material["Kd"])}</bsdf>'
    return f'<bsdf type="twosided">{inside}</bsdf>'


def sensor(camera):
    def point(name):
        return ",".join(map(str, camera[name]))

    return (f'<sensor type="perspective"><float name="fov" value="{camera["fov_deg"]}"/><string name="fov_axis" value="y"/>'
            f'<transform name="to_world"><lookat origin="{point("eye")}" target="{point("target")}" up="{point("up")}"/></transform>'
            '<film type="hdrfilm"><integer name="width" value="256"/><integer name="height" value="256"/></film>'
            '<sampler type="independent"/></sensor>')


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    path, folder = Path(sys.argv[1]), Path(sys.argv[2])
    scene = json.loads(path.read_text())
    if unknown := scene.keys() - KNOWN_OPTIONS:
        sys.exit(f"{path}: expected the options {', '.join(sorted(KNOWN_OPTIONS))}, got {', '.join(sorted(unknown))}")
    obj = path.parent / scene["obj"]
    materials = read_materials(obj.with_suffix(".mtl"))
    folder.mkdir(parents=True, exist_ok=True)
    shapes = []
    for name, text in split_by_material(obj).items():
        (folder / f"{name}.obj").write_text(text)
        emission = materials[name].get("Ke")
        emitter = f'<emitter type="area">{rgb("radiance", emission)}</emitter>' if emission else ""
        shapes.append(f'<shape type="obj"><string name="filename" value="{name}.obj"/>{bsdf(materials[name])}{emitter}</shape>')
    parts = ['<integrator type="path"></integrator>', sensor(scene["camera"]), *shapes]
    (folder / f"{path.stem}.xml").write_text('<scene version="3.0.0">\n' + "\n".join(parts) + "\n</scene>\n")


if __name__ == "__main__":
    main()
