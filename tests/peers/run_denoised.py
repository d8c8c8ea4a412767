#!/usr/bin/env python3
"""Errors of methods before and after Open Image Denoise: does guiding still pay when pictures are denoised?

    run_denoised.py SCENE... --program PATHLIGHT --folder DIR [--spp 4 16 64] [--seeds 5] [--reference-spp 1024]
                    [--render "OPTIONS"]

DIR gets a virtual environment with pyoidn from PyPI (Open Image Denoise 2 for the CPU), references, and the pictures, which are not rendered
again if they are there. DIR/noisy and DIR/denoised are scored by `pathlight score`, which writes their tables; `pathlight report` makes
their pages. Each picture is denoised with albedo and normals of 64 samples, which cost both methods the same and are not charged, and
neither is the denoiser. Seconds are of processor time without the seconds of `pathlight info`, which reads the scene: placing and learning are
charged. Exit code 77: pyoidn cannot be installed here.
"""
import argparse
import json
import os
import subprocess
from pathlib import Path

from run_peers import processor_seconds, python_with

METHODS = ("default", "reinforcement")
GUIDES = ("albedo", "normal")
# Given the folder of pictures.py, reads lines of four file names: color, albedo, normal, picture to write.
DENOISE = r"""
import sys
import numpy as np
import pyoidn
sys.path.insert(0, sys.argv[1])
from pictures import read_pfm, write_pfm
def read(path):
    width, height, values = read_pfm(path)
    return np.frombuffer(values, np.float32).reshape(height, width, 3)
for line in sys.stdin:
    color, albedo, normal, output = line.rstrip("\n").split("\t")
    picture = pyoidn.denoise(read(color), albedo=np.clip(read(albedo), 0, 1), normal=read(normal), hdr=True)
    write_pfm(output, picture.shape[1], picture.shape[0], picture.ravel())
"""


class Scene:
    def __init__(self, scene, options):
        self.scene, self.name, self.options = scene, Path(scene).stem if "/" in scene else scene, options
        if self.name == "scene":
            self.name = Path(scene).resolve().parent.name
        self.folder = options.folder / "pictures" / self.name
        self.folder.mkdir(parents=True, exist_ok=True)

    def seconds(self, subcommand, *arguments):
        return processor_seconds(self.options.program, subcommand, self.scene, *arguments, *self.options.render)

    def reference(self):
        """The halves, relative to a folder of scores."""
        folder = self.options.folder / "references" / self.name
        self.seconds("reference", "-o", folder, "--spp", self.options.reference_spp)
        return [os.path.relpath(half, self.options.folder / "noisy") for half in sorted(folder.glob("*.exr"))]

    def guides(self):
        for view in GUIDES:
            picture = self.folder / f"{view}.pfm"
            if not picture.exists():
                self.seconds("render", "--view", view, "--spp", 64, "-o", picture)
        return [self.folder / f"{view}.pfm" for view in GUIDES]

    def picture(self, method, seed, spp, loading):
        """File, and seconds of processor time."""
        picture = self.folder / f"{method}-{spp}-{seed}.pfm"
        told = picture.with_suffix(".json")
        if not told.exists():
            seconds = self.seconds("render", "--method", method, "--seed", seed, "--spp", spp, "-o", picture)
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
    denoiser = subprocess.Popen([python_with("pyoidn", options.folder), "-c", DENOISE, Path(__file__).parent],
                                stdin=subprocess.PIPE, text=True)
    for kind in ("noisy", "denoised"):
        (options.folder / kind).mkdir(parents=True, exist_ok=True)
    references, pictures = {}, []
    for scene in [Scene(name, options) for name in options.scenes]:
        references[scene.name] = scene.reference()
        guides = scene.guides()
        loading = processor_seconds(options.program, "info", scene.scene)
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
