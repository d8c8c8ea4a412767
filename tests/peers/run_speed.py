#!/usr/bin/env python3
"""Paths per second of processor time, and noise by that time, of pathlight's methods and of Mitsuba 3's `path`, in turn in one run.

    run_speed.py SCENE.xml --program PATHLIGHT --folder DIR [--variant llvm_ad_rgb] [--spp 32] [--rounds 5]
                 [--score DIR --reference HALF.exr HALF.exr]

DIR gets a virtual environment with Mitsuba from PyPI. Its LLVM variants look for the library at DRJIT_LIBLLVM_PATH, if that is set.
Times are without loading and compiling, with placing and learning: pathlight's is the difference to a picture of `default` with one sample,
Mitsuba's first picture does not count. Both sample lights, and play roulette from the third or fourth vertex on. Noise is the variance
of a channel over the rounds by the squared mean of all pictures of the renderer, in the mean over the picture, whole and without the worst
thousandth; it is independent of a difference of the models. With --score, DIR gets the pictures and the score.json by which `pathlight score`
measures their errors against a reference, such as one of `pathlight reference` of that size and depth. Exit code 77: Mitsuba cannot be installed here.
"""
import argparse
import json
import math
import os
import re
import shutil
import statistics
import subprocess
import sys
from pathlib import Path

from pictures import read_pfm
from run_peers import PEERS, processor_seconds, python_with

MITSUBA = r"""
import resource, sys
import mitsuba
mitsuba.set_variant(sys.argv[2])
scene = mitsuba.load_file(sys.argv[1])
spp = int(sys.argv[3])
for number, line in enumerate(sys.stdin):
    before = resource.getrusage(resource.RUSAGE_SELF).ru_utime
    picture = mitsuba.render(scene, spp=spp, seed=number)
    mitsuba.Bitmap(picture)  # waits for the picture
    seconds = resource.getrusage(resource.RUSAGE_SELF).ru_utime - before
    mitsuba.Bitmap(picture[:, :, :3]).write(sys.argv[4])
    height, width = picture.shape[:2]
    print(width, height, seconds, flush=True)
"""
METHODS = ("default", "reinforcement")
EPSILON = 0.01  # as in core/measure/metrics.h


def for_mitsuba(scene, folder):
    """A copy beside the original, so that its files are found: with `path` in place of other integrators, the box filter of pathlight in
    place of others, which spread samples over several pixels, and without properties that Mitsuba 3 does not know."""
    text = scene.read_text()
    path = '<integrator type="path"><integer name="max_depth" value="10"/><integer name="rr_depth" value="4"/></integrator>'
    text = re.sub(r"<integrator\b.*?</integrator>", path, text, count=1, flags=re.DOTALL)
    text = re.sub(r"<rfilter\b.*?(/>|</rfilter>)", "", text, flags=re.DOTALL)
    text = re.sub(r"(<film\b[^>]*>)", r'\1<rfilter type="box"/>', text)
    text = re.sub(r'<\w+ name="ext_?[eE]ta"[^>]*/>', "", text)
    copy = folder / scene.name
    copy.write_text(text)
    for entry in scene.parent.iterdir():
        link = folder / entry.name
        if entry != scene and not link.exists():
            link.symlink_to(entry)
    return copy


class Renderer:
    """Pictures of a renderer, and the seconds of processor time that each took."""
    def __init__(self, name):
        self.name, self.pictures, self.seconds, self.kept = name, [], [], []

    def add(self, picture, seconds, samples, options):
        self.pictures.append(read_pfm(picture)[2])
        self.seconds.append(seconds)
        if options.score:
            file = f"{re.sub('[^a-z0-9]+', '-', self.name.lower())}-{len(self.kept)}.pfm"
            shutil.copy(picture, options.score / file)
            self.kept.append({"file": file, "scene": options.scene.stem, "method": self.name, "seed": len(self.kept),
                              "samples": samples, "seconds": seconds})

    def noise(self):
        """Mean of the variance by the squared mean, of all channels and of all but the worst thousandth."""
        terms = []
        for values in zip(*self.pictures):
            mean = statistics.fmean(values)
            variance = sum((value - mean) ** 2 for value in values) / (len(values) - 1)
            terms.append(variance / (mean * mean + EPSILON))
        terms.sort()
        return statistics.fmean(terms), statistics.fmean(terms[:math.ceil(0.999 * len(terms))])


class Mitsuba:
    def __init__(self, python, scene, variant, spp, picture):
        self.process = subprocess.Popen([python, "-c", MITSUBA, scene, variant, str(spp), picture], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, text=True)
        self.size, _ = self.render()

    def render(self):
        """Size of the picture, and seconds of processor time."""
        self.process.stdin.write("render\n")
        self.process.stdin.flush()
        words = self.process.stdout.readline().split()
        if len(words) != 3:
            sys.exit("Mitsuba has ended; LLVM variants may need another library, see DRJIT_LIBLLVM_PATH")
        return (int(words[0]), int(words[1])), float(words[2])


def pathlight_seconds(program, scene, size, spp, method, seed, output):
    return processor_seconds(program, "render", scene, "--size", f"{size[0]}x{size[1]}", "--spp", spp, "--method", method,
                             "--seed", seed, "--max-depth", "10", "-o", output)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", type=Path)
    parser.add_argument("--program", required=True)
    parser.add_argument("--folder", required=True, type=Path)
    parser.add_argument("--variant", default="llvm_ad_rgb")
    parser.add_argument("--spp", type=int, default=32)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--score", type=Path)
    parser.add_argument("--reference", type=Path, nargs="+")
    options = parser.parse_args()
    if options.score:
        if not options.reference:
            parser.error("--score: expected --reference with it")
        options.score.mkdir(parents=True, exist_ok=True)
    folder = options.folder.resolve()
    (folder / "speed").mkdir(parents=True, exist_ok=True)
    picture = folder / "speed.pfm"
    mitsuba = Mitsuba(python_with(PEERS["mitsuba"][0], folder), for_mitsuba(options.scene.resolve(), folder / "speed"),
                      options.variant, options.spp, picture)
    peer = Renderer(f"Mitsuba path, {options.variant}")
    ours = [Renderer(method) for method in METHODS]
    for seed in range(options.rounds):
        peer.add(picture, mitsuba.render()[1], options.spp, options)
        loading = pathlight_seconds(options.program, options.scene, mitsuba.size, 1, "default", seed, picture)
        for renderer in ours:
            seconds = pathlight_seconds(options.program, options.scene, mitsuba.size, 1 + options.spp, renderer.name, seed,
                                        picture)
            renderer.add(picture, (seconds - loading) * (1 + options.spp) / options.spp, 1 + options.spp, options)
    report(options, mitsuba.size, peer, ours)
    if options.score:
        (options.score / "score.json").write_text(json.dumps({
            "schema": "pathlight.score/1", "device": f"{os.cpu_count()} threads, seconds of processor time",
            "references": {options.scene.stem: [str(half.resolve()) for half in options.reference]},
            "pictures": [kept for renderer in [peer, *ours] for kept in renderer.kept]}, indent=1))


def report(options, size, peer, ours):
    print(f"{options.scene.name}, {size[0]} x {size[1]}, {options.spp} samples, {options.rounds} rounds, {os.cpu_count()} threads")
    print("  renderer                   Mpaths/s of processor time   relMSE x seconds   without the worst 0.1 %   to Mitsuba's: speed")
    for renderer in [peer, *ours]:
        samples = options.spp if renderer is peer else 1 + options.spp
        paths = size[0] * size[1] * samples
        seconds = statistics.median(renderer.seconds)
        ratios = sorted(theirs / own * samples / options.spp for theirs, own in zip(peer.seconds, renderer.seconds))
        whole, trimmed = (noise * seconds for noise in renderer.noise())
        print(f"  {renderer.name:<26} {paths / seconds / 1e6:26.3f} {whole:18.4f} {trimmed:25.4f}"
              f"   {statistics.median(ratios):.2f} [{ratios[0]:.2f}, {ratios[-1]:.2f}]")


if __name__ == "__main__":
    main()
