#!/usr/bin/env python3
"""Paths per second of processor time of pathlight's `default` and of Mitsuba 3's `path`, in turn in one run.

    run_speed.py SCENE.xml --program PATHLIGHT --folder DIR [--variant llvm_ad_rgb] [--spp 32] [--rounds 5]

DIR gets a virtual environment with Mitsuba from PyPI. Its LLVM variants look for the library at DRJIT_LIBLLVM_PATH, if that is set.
Times are without loading and compiling: pathlight's is the difference of two renderings, Mitsuba's first picture does not count. Both
sample lights, and play roulette from the third or fourth vertex on. Exit code 77: Mitsuba cannot be installed here.
"""
import argparse
import os
import re
import resource
import statistics
import subprocess
import sys
from pathlib import Path

from run_peers import PEERS, python_with

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
    height, width = picture.shape[:2]
    print(width, height, seconds, flush=True)
"""


def for_mitsuba(scene, folder):
    """A copy beside the original, so that its files are found: with `path` in place of other integrators, and without properties
    that Mitsuba 3 does not know."""
    text = scene.read_text()
    path = '<integrator type="path"><integer name="max_depth" value="10"/><integer name="rr_depth" value="4"/></integrator>'
    text = re.sub(r"<integrator\b.*?</integrator>", path, text, count=1, flags=re.DOTALL)
    text = re.sub(r'<\w+ name="ext_?[eE]ta"[^>]*/>', "", text)
    copy = folder / scene.name
    copy.write_text(text)
    for entry in scene.parent.iterdir():
        link = folder / entry.name
        if entry != scene and not link.exists():
            link.symlink_to(entry)
    return copy


class Mitsuba:
    def __init__(self, python, scene, variant, spp):
        self.process = subprocess.Popen([python, "-c", MITSUBA, scene, variant, str(spp)], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, text=True)
        self.spp = spp
        self.size, _ = self.render()

    def render(self):
        """Size of the picture, and paths per second."""
        self.process.stdin.write("render\n")
        self.process.stdin.flush()
        words = self.process.stdout.readline().split()
        if len(words) != 3:
            sys.exit("Mitsuba has ended; LLVM variants may need another library, see DRJIT_LIBLLVM_PATH")
        width, height, seconds = int(words[0]), int(words[1]), float(words[2])
        return (width, height), width * height * self.spp / seconds


def pathlight_seconds(program, scene, size, spp, output):
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run([program, "render", scene, "--size", f"{size[0]}x{size[1]}", "--spp", str(spp), "--method", "default",
                    "--max-depth", "10", "-o", output], check=True, capture_output=True)
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", type=Path)
    parser.add_argument("--program", required=True)
    parser.add_argument("--folder", required=True, type=Path)
    parser.add_argument("--variant", default="llvm_ad_rgb")
    parser.add_argument("--spp", type=int, default=32)
    parser.add_argument("--rounds", type=int, default=5)
    options = parser.parse_args()
    folder = options.folder.resolve()
    (folder / "speed").mkdir(parents=True, exist_ok=True)
    mitsuba = Mitsuba(python_with(PEERS["mitsuba"][0], folder), for_mitsuba(options.scene.resolve(), folder / "speed"),
                      options.variant, options.spp)
    ours, theirs = [], []
    for _ in range(options.rounds):
        theirs.append(mitsuba.render()[1])
        few, many = (pathlight_seconds(options.program, options.scene, mitsuba.size, spp, folder / "speed.pfm")
                     for spp in (1, 1 + options.spp))
        ours.append(mitsuba.size[0] * mitsuba.size[1] * options.spp / (many - few))
    ratios = sorted(a / b for a, b in zip(ours, theirs))
    print(f"{options.scene.name}, {mitsuba.size[0]} x {mitsuba.size[1]}, {options.spp} samples, {options.rounds} rounds, "
          f"{os.cpu_count()} threads")
    print(f"  pathlight default                {statistics.median(ours) / 1e6:.3f} Mpaths per second of processor time")
    print(f"  Mitsuba path, {options.variant:<18} {statistics.median(theirs) / 1e6:.3f}")
    print(f"  ratio                            {statistics.median(ratios):.2f} [{ratios[0]:.2f}, {ratios[-1]:.2f}]")


if __name__ == "__main__":
    main()
