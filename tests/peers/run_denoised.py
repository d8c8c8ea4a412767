#!/usr/bin/env python3
"""Errors of methods before and after Open Image Denoise: does guiding still pay when pictures are denoised?

    run_denoised.py SCENE... --program PATHLIGHT --folder DIR [--spp 4 16 64] [--seeds 5] [--reference-spp 1024]
                    [--render "OPTIONS"]

DIR gets a virtual environment with pyoidn from PyPI (Open Image Denoise 2 for the CPU), references, and the pictures, which are not rendered
again if they are there. DIR/noisy and DIR/denoised are scored by `pathlight score`, which writes their tables; `pathlight report` makes
their pages. Each picture is denoised with albedo and normals of 64 samples, which cost both methods the same and are not charged, and
neither is the denoiser. Seconds are of processor time without those of `pathlight info`, which reads the scene: placing and learning are
charged. Exit code 77: pyoidn cannot be installed here.
"""
import argparse
import json
import os
import resource
import subprocess
from pathlib import Path

from run_peers import python_with

METHODS = ("default", "reinforcement")
GUIDES = ("albedo", "normal")
# Reads lines of four file names: color, albedo, normal, picture to write. Rows of a PFM file go upwards, which a denoiser does not mind.
DENOISE = r"""
import sys
import numpy as np
import pyoidn
def read(path):
    with open(path, "rb") as file:
        assert file.readline().strip() == b"PF"
        width, height = map(int, file.readline().split())
        assert float(file.readline()) < 0
        return np.frombuffer(file.read(), "<f4").reshape(height, width, 3).copy()
for line in sys.stdin:
    color, albedo, normal, output = line.rstrip("\n").split("\t")
    color = read(color)
    picture = pyoidn.denoise(color, albedo=np.clip(read(albedo), 0, 1), normal=read(normal), hdr=True)
    with open(output, "wb") as file:
        file.write(b"PF\n%d %d\n-1.0\n" % (color.shape[1], color.shape[0]) + np.asarray(picture, "<f4").tobytes())
"""


def run(program, *arguments):
    """Seconds of processor time."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run([program, *map(str, arguments)], check=True, capture_output=True)
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


class Scene:
    def __init__(self, scene, options):
        self.scene, self.name, self.options = scene, Path(scene).stem if "/" in scene else scene, options
        if self.name == "scene":
            self.name = Path(scene).resolve().parent.name
        self.folder = options.folder / "pictures" / self.name
        self.folder.mkdir(parents=True, exist_ok=True)

    def reference(self):
        """The halves, relative to a folder of scores."""
        folder = self.options.folder / "references" / self.name
        run(self.options.program, "reference", self.scene, "-o", folder, "--spp", self.options.reference_spp, *self.options.render)
        return [os.path.relpath(half, self.options.folder / "noisy") for half in sorted(folder.glob("*.exr"))]

    def guides(self):
        for view in GUIDES:
            picture = self.folder / f"{view}.pfm"
            if not picture.exists():
                run(self.options.program, "render", self.scene, "--view", view, "--spp", 64, "-o", picture, *self.options.render)
        return [self.folder / f"{view}.pfm" for view in GUIDES]

    def picture(self, method, seed, spp, loading):
        """File, and seconds of processor time."""
        picture = self.folder / f"{method}-{spp}-{seed}.pfm"
        told = picture.with_suffix(".json")
        if not told.exists():
            seconds = run(self.options.program, "render", self.scene, "--method", method, "--seed", seed, "--spp", spp, "-o", picture,
                          *self.options.render)
            told.write_text(json.dumps(max(seconds - loading, 1e-3)))
        return picture, json.loads(told.read_text())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="+")
    parser.add_argument("--program", required=True)
    parser.add_argument("--folder", required=True, type=Path)
    parser.add_argument("--spp", type=int, nargs="+", default=[4, 16, 64])
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--reference-spp", type=int, default=1024)
    parser.add_argument("--render", default=[], type=str.split, help="options of render, in one word")
    options = parser.parse_args()
    options.folder = options.folder.resolve()
    denoiser = subprocess.Popen([python_with("pyoidn", options.folder), "-c", DENOISE], stdin=subprocess.PIPE, text=True)
    for kind in ("noisy", "denoised"):
        (options.folder / kind).mkdir(parents=True, exist_ok=True)
    references, pictures = {}, []
    for scene in [Scene(name, options) for name in options.scenes]:
        references[scene.name] = scene.reference()
        guides = scene.guides()
        loading = run(options.program, "info", scene.scene)
        for seed in range(1, options.seeds + 1):
            for method in METHODS:
                for spp in options.spp:
                    noisy, seconds = scene.picture(method, seed, spp, loading)
                    name = f"{scene.name}-{noisy.name}"
                    link = options.folder / "noisy" / name
                    if not link.exists():
                        link.symlink_to(noisy)
                    denoiser.stdin.write("\t".join(map(str, [noisy, *guides, options.folder / "denoised" / name])) + "\n")
                    pictures.append({"file": name, "scene": scene.name, "method": method, "seed": seed, "samples": spp,
                                     "seconds": seconds})
    denoiser.stdin.close()
    if denoiser.wait() != 0:
        raise SystemExit("the denoiser failed")
    for kind in ("noisy", "denoised"):
        folder = options.folder / kind
        (folder / "score.json").write_text(json.dumps({
            "schema": "pathlight.score/1", "device": f"{os.cpu_count()} threads, seconds of processor time", "methods": METHODS,
            "references": references, "pictures": pictures}, indent=1))
        print(f"{kind}\n{subprocess.run([options.program, 'score', folder], check=True, capture_output=True, text=True).stdout}")


if __name__ == "__main__":
    main()
