#!/usr/bin/env python3
"""Makes the pictures of the documents with the program, as PNGs of 256 colors.

Usage: make_pictures.py PROGRAM [NAME...]   NAME is tour, error-map, door, effects, cells, learning or scenes; default: all

For the first two the viewer plays pictures/NAME.script on SDL's dummy driver, so no display is needed; every `shot` of a script becomes
a picture. `door` and `effects` are renderings, side by side where they are several. `cells` is what a volume has learned after more and
more passes, at its right the truth. `learning` is animated, and wants a quiet machine: each of its frames is `default` and
`reinforcement` after the same time, and the disc of what a volume has learned by then. `scenes` are the small pictures of all scenes that come with the program, beside their files, for the
list of scenes and for the window. Each has as text what the scene file tells about the scene, and the hash by which a test finds pictures
of scenes that have changed.
"""
import json
import os
import re
import struct
import subprocess
import sys
import tempfile
import zlib
from collections import Counter
from pathlib import Path

DOCS = Path(__file__).resolve().parent
# Arguments of the viewer, and the folder of its pictures.
PICTURES = {
    "tour": (["cornell", "--nee", "off", "--size", "128x128", "--window", "1280x720"], DOCS / "images" / "tour"),
    "error-map": (["cornell", "--nee", "off", "--size", "384x384", "--window", "1280x720"], DOCS / "images"),
}
# Scenes, and the options of each.
RENDERINGS = {
    "door": (["door"], ["--method", "reinforcement", "--spp", "64", "--size", "300x300"]),
    "effects": (["spheres", "coats", "plates"], ["--method", "reinforcement", "--spp", "128", "--size", "300x300"]),
}
# Of the animation: scene and options, the seconds of each frame, the place of the volume, and where `inspect` draws its disc.
LEARNING = ["door", "--nee", "off", "--size", "260x260", "--threads", "1"]
SECONDS = [0.1, 0.2, 0.4, 0.8, 1.6, 3.2]
PLACE, DISC = ["--pixel", "150,225"], (24, 210, 520, 520)
# Of the cells: options, passes, and where `inspect --truth` draws the learned and the true disc: x, y, width, height.
CELLS = ["cornell", "--nee", "off", "--at", "400,0,200", "--size", "256x256", "--truth"]
PASSES = [1, 4, 16, 64]
LEARNED, TRUE = (20, 270, 388, 396), (523, 270, 388, 396)
COLORS = 256
SCENES = DOCS.parent / "assets" / "scenes"
SCENE_OPTIONS = ["--method", "reinforcement", "--nee", "on", "--spp", "512", "--size", "128x128"]


def paeth(left, up, corner):
    distances = (abs(up - corner), abs(left - corner), abs(left + up - 2 * corner))
    return (left, up, corner)[distances.index(min(distances))]


def unfiltered(kind, line, above, step):
    """One row of a PNG without its filter. [PNG specification, section 9]"""
    row = bytearray(line)
    for i, value in enumerate(line):
        left = row[i - step] if i >= step else 0
        corner = above[i - step] if i >= step else 0
        row[i] = (value + (0, left, above[i], (left + above[i]) // 2, paeth(left, above[i], corner))[kind]) & 255
    return row


def chunks_of(path):
    """Kind and body of all chunks of a PNG."""
    data, place = path.read_bytes(), 8
    while place < len(data):
        size, kind = struct.unpack(">I4s", data[place:place + 8])
        yield kind, data[place + 8:place + 8 + size]
        place += 12 + size


def read_png(path):
    """Width, height and the (r, g, b) of all pixels of an 8-bit RGB or RGBA PNG."""
    packed = b""
    for kind, body in chunks_of(path):
        if kind == b"IHDR":
            width, height, depth, color = struct.unpack(">IIBB", body[:10])
            if depth != 8 or color not in (2, 6):
                sys.exit(f"{path}: expected 8 bits of RGB or RGBA, got {depth} bits of color type {color}")
        packed += body if kind == b"IDAT" else b""
    step = 3 if color == 2 else 4
    raw, stride = zlib.decompress(packed), width * step + 1
    pixels, above = [], bytearray(width * step)
    for y in range(height):
        above = unfiltered(raw[y * stride], raw[y * stride + 1:(y + 1) * stride], above, step)
        pixels += zip(above[0::step], above[1::step], above[2::step])
    return width, height, pixels


def widest(box):
    """The channel in which the colors of a box differ most, and by how much."""
    spans = [max(c[i] for c, _ in box) - min(c[i] for c, _ in box) for i in range(3)]
    return spans.index(max(spans)), max(spans)


def palette_of(counts):
    """Colors of the palette, and the index of each color in it. The most frequent ones, as of panels, are kept; others share the rest.
    [Heckbert 1982, median cut]"""
    entries = counts.most_common()
    kept, rest = entries[:COLORS // 4], entries[COLORS // 4:]
    boxes = [[entry] for entry in kept] + ([rest] if rest else [])
    while len(boxes) < COLORS:
        box = max(boxes, key=lambda b: widest(b)[1])
        if len(box) == 1:
            break
        channel = widest(box)[0]
        box.sort(key=lambda entry: entry[0][channel])
        boxes.remove(box)
        boxes += [box[:len(box) // 2], box[len(box) // 2:]]
    colors, index = [], {}
    for box in boxes:
        weight = sum(n for _, n in box)
        colors.append(tuple(round(sum(c[i] * n for c, n in box) / weight) for i in range(3)))
        index.update((c, len(colors) - 1) for c, _ in box)
    return colors, index


def chunk(kind, body):
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def side_by_side(pictures):
    """One picture of several of the same height."""
    width, height = sum(p[0] for p in pictures), pictures[0][1]
    rows = [p[2][y * p[0]:(y + 1) * p[0]] for y in range(height) for p in pictures]
    return width, height, [pixel for row in rows for pixel in row]


def halved(picture, box):
    """A part of a picture at half its size: each pixel is the mean of 2 x 2."""
    (width, _, pixels), (left, top, wide, high) = picture, box
    blocks = ([pixels[y * width + x + i] for i in (0, 1, width, width + 1)]
              for y in range(top, top + high, 2) for x in range(left, left + wide, 2))
    return wide // 2, high // 2, [tuple(sum(channel) // 4 for channel in zip(*block)) for block in blocks]


def shrink(frames, target, texts=()):
    """Writes pictures as one PNG of a palette: colors that differ in the last bit only count as equal. Each frame is a list of pictures
    side by side; several are an animation that lasts a second for each. `texts` are bodies of text chunks.
    [PNG specification, third edition, section 11.3.6]"""
    pictures = [side_by_side(frame) for frame in frames]
    width, height = pictures[0][:2]
    pictures = [[(r & 254, g & 254, b & 254) for r, g, b in pixels] for _, _, pixels in pictures]
    colors, index = palette_of(sum(map(Counter, pictures), Counter()))
    chunks = [chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0))]
    chunks += [chunk(b"tEXt", text) for text in texts]
    if len(frames) > 1:
        chunks.append(chunk(b"acTL", struct.pack(">II", len(frames), 0)))
    chunks.append(chunk(b"PLTE", b"".join(map(bytes, colors))))
    count = 0
    for i, pixels in enumerate(pictures):
        numbers = bytes(index[p] for p in pixels)
        rows = zlib.compress(b"".join(b"\0" + numbers[y * width:(y + 1) * width] for y in range(height)), 9)
        if len(frames) > 1:
            seconds = 3 if i + 1 == len(frames) else 1
            chunks.append(chunk(b"fcTL", struct.pack(">IIIIIHHBB", count, width, height, 0, 0, seconds, 1, 0, 0)))
            count += 1
        chunks.append(chunk(b"IDAT", rows) if i == 0 else chunk(b"fdAT", struct.pack(">I", count) + rows))
        count += i > 0
    target.write_bytes(b"\x89PNG\r\n\x1a\n" + b"".join(chunks) + chunk(b"IEND", b""))
    print(f"{target}: {target.stat().st_size} bytes")


def render(program, name):
    scenes, options = RENDERINGS[name]
    with tempfile.TemporaryDirectory() as work:
        files = [Path(work) / f"{scene}.png" for scene in scenes]
        for scene, file in zip(scenes, files):
            subprocess.run([program, "render", scene, "-o", file, *options, "--backend", "cpu", "--quiet"], check=True)
        shrink([[read_png(file) for file in files]], DOCS / "images" / f"{name}.png")


def picture_scenes(program, _):
    with tempfile.TemporaryDirectory() as work:
        file = Path(work) / "scene.png"
        for folder in sorted(path.parent for path in SCENES.glob("*/*.json")):
            subprocess.run([program, "render", folder.name, "-o", file, *SCENE_OPTIONS, "--backend", "cpu", "--quiet"], check=True)
            summary = json.loads((folder / f"{folder.name}.json").read_text())["summary"]
            kept = [body for kind, body in chunks_of(file) if kind == b"tEXt" and body.startswith(b"picture_hash\0")]
            shrink([[read_png(file)]], folder / f"{folder.name}.png", [*kept, b"summary\0" + summary.encode("latin-1")])


def inspect(program, name):
    with tempfile.TemporaryDirectory() as work:
        file, strip = Path(work) / "disc.png", []
        for passes in PASSES:
            subprocess.run([program, "inspect", *CELLS, "--method", "reinforcement", "--spp", str(passes), "-o", file, "--backend", "cpu",
                            "--quiet"], check=True)
            strip.append(halved(read_png(file), LEARNED))
        shrink([[*strip, halved(read_png(file), TRUE)]], DOCS / "images" / f"{name}.png")


def animate(program, name):
    with tempfile.TemporaryDirectory() as work:
        file, field, frames = Path(work) / "picture.png", Path(work) / "learned.field", []
        for seconds in SECONDS:
            commands = [["render", *LEARNING, "--method", "default", "--time-limit", str(seconds)],
                        ["render", *LEARNING, "--method", "reinforcement", "--time-limit", str(seconds), "--save-field", field],
                        ["inspect", *LEARNING, *PLACE, "--load-field", field]]
            frames.append([])
            for command in commands:
                subprocess.run([program, *command, "-o", file, "--backend", "cpu", "--quiet"], check=True)
                frames[-1].append(halved(read_png(file), DISC) if command[0] == "inspect" else read_png(file))
        shrink(frames, DOCS / "images" / f"{name}.png")


def play(program, name):
    arguments, folder = PICTURES[name]
    script = DOCS / "pictures" / f"{name}.script"
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as work:
        subprocess.run([program, "view", *arguments, "--backend", "cpu", "--script", str(script)], check=True, cwd=work,
                       env=os.environ | {"SDL_VIDEODRIVER": "dummy"})
        for shot in re.findall(r"^\d+ shot (\S+)$", script.read_text(), re.MULTILINE):
            shrink([[read_png(Path(work) / shot)]], folder / shot)


def main():
    names = [*PICTURES, *RENDERINGS, "cells", "learning", "scenes"]
    if len(sys.argv) < 2 or set(sys.argv[2:]) - set(names):
        sys.exit(__doc__)
    program = str(Path(sys.argv[1]).resolve())
    for name in sys.argv[2:] or names:
        makers = {"cells": inspect, "learning": animate, "scenes": picture_scenes}
        (play if name in PICTURES else makers.get(name, render))(program, name)


if __name__ == "__main__":
    main()
