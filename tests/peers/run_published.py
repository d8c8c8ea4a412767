#!/usr/bin/env python3
"""Noise of pictures that were published with a scene, beside the noise of pathlight with as many samples and no light samples.

    run_published.py SCENE.xml PICTURE.exr ... --program PATHLIGHT --folder DIR [--spp 1023] [--max-depth 10] [--from-column 0]

DIR gets a virtual environment with Mitsuba from PyPI, which reads the pictures, and pathlight's pictures of two seeds; those that are there
already are not rendered again. The noise is a variance by the squared mean, in the mean over channels and pixels from a column on, whole and
without the worst thousandth and hundredth. Pathlight's is half of the squared difference of two seeds; the noise of a published picture is taken
from its difference to the mean of pathlight's. A pixel's difference counts as far as it deviates from its four neighbors: the models of two
renderers differ smoothly. Exit code 77: Mitsuba cannot be installed here.
"""
import argparse
import json
import math
import re
import statistics
import subprocess
from pathlib import Path

from pictures import read_pfm
from run_peers import PEERS, python_with

METHODS = {
    "default": ["--method", "default"],
    "SD-tree": ["--method", "reinforcement", "--field", "sd-tree"],
    "table": ["--method", "reinforcement"],
}
SEEDS = (1, 2)
TRIMS = (0.0, 0.001, 0.01)
EPSILON = 0.01  # of the squared mean, as in core/measure/metrics.h
TO_PFM = """
import mitsuba, sys
mitsuba.set_variant("scalar_rgb")
bitmap = mitsuba.Bitmap(sys.argv[1])
bitmap.convert(mitsuba.Bitmap.PixelFormat.RGB, mitsuba.Struct.Type.Float32, False).write(sys.argv[2])
"""


def rendered(options, size, name, seed):
    """Channels of a picture, and its seconds."""
    stem = options.folder / f"{options.scene.stem}-{re.sub('[^a-z]+', '-', name.lower())}-{options.spp}-{seed}"
    picture, stats = stem.with_suffix(".pfm"), stem.with_suffix(".json")
    if not picture.exists():
        subprocess.run([options.program, "render", options.scene, *METHODS[name], "--guiding", "always", "--nee", "off",
                        "--spp", str(options.spp), "--max-depth", str(options.max_depth), "--size", f"{size[0]}x{size[1]}",
                        "--seed", str(seed), "--stats", stats, "-o", picture], check=True, capture_output=True)
    return read_pfm(picture)[2], json.loads(stats.read_text())["seconds"]["total"]


def squared_deviations(first, second, mean, size, column):
    """Of a difference by the mean from its four neighbors, so that independent values have their own variance."""
    width, height = size
    row = 3 * width
    relative = [(a - b) / math.sqrt(m * m + EPSILON) for a, b, m in zip(first, second, mean)]
    terms = []
    for y in range(1, height - 1):
        for i in range(y * row + 3 * max(column, 1), (y + 1) * row - 3):
            around = relative[i - row] + relative[i + row] + relative[i - 3] + relative[i + 3]
            terms.append((relative[i] - 0.25 * around) ** 2 / 1.25)
    return sorted(terms)


def trimmed(terms, scale):
    return "  ".join(f"{scale * statistics.fmean(terms[:math.ceil((1.0 - trim) * len(terms))]):9.6f}" for trim in TRIMS)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", type=Path)
    parser.add_argument("published", type=Path, nargs="+")
    parser.add_argument("--program", required=True)
    parser.add_argument("--folder", required=True, type=Path)
    parser.add_argument("--spp", type=int, default=1023)
    parser.add_argument("--max-depth", type=int, default=10)
    parser.add_argument("--from-column", type=int, default=0)
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    python = python_with(PEERS["mitsuba"][0], options.folder.resolve())
    published = {}
    for picture in options.published:
        copy = options.folder / f"{picture.stem}.pfm"
        subprocess.run([python, "-c", TO_PFM, picture, copy], check=True)
        published[picture.name] = read_pfm(copy)
    size = next(iter(published.values()))[:2]
    ours = {name: [rendered(options, size, name, seed) for seed in SEEDS] for name in METHODS}
    mean = [statistics.fmean(values) for values in zip(*(picture for pair in ours.values() for picture, _ in pair))]
    print(f"{options.scene.name}, {size[0]} x {size[1]}, {options.spp} samples: noise whole, without 0.1 %, without 1 %, seconds")
    for name, (first, second) in ours.items():
        terms = squared_deviations(first[0], second[0], mean, size, options.from_column)
        print(f"  {name:<26} {trimmed(terms, 0.5)}  {statistics.fmean([first[1], second[1]]):.0f}")
    for name, (_, _, picture) in published.items():
        print(f"  {name:<26} {trimmed(squared_deviations(picture, mean, mean, size, options.from_column), 1.0)}")


if __name__ == "__main__":
    main()
