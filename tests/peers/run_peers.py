#!/usr/bin/env python3
"""Renders the scenes of peer_cases.py with pathlight and with another renderer, and compares the pictures by rule S2.

    run_peers.py mitsuba|blender --program PATHLIGHT --folder DIR [--only NAME]...

DIR gets a virtual environment with the renderer from PyPI, and the pictures. Both programs render 64 batches with seeds of their own,
64 x 48 pixels. Prints a row of a table for each scene. Exit code 0: all agree as stated, 1: not, 77: skipped, because the package
cannot be installed here.
"""
import argparse
import os
import resource
import subprocess
import sys
import time
from pathlib import Path

import peer_cases
import pictures
import rule_s2

HERE = Path(__file__).resolve().parent
BATCHES = rule_s2.LEAST_BATCHES
PEERS = {  # package of PyPI, script that renders, suffix of the scenes, their list
    "mitsuba": ("mitsuba==3.9.1", "render_mitsuba.py", ".xml", peer_cases.MITSUBA),
    "blender": ("bpy==4.2.0", "render_blender.py", ".glb", peer_cases.BLENDER),
}
SKIPPED = 77


def skip(package, result):
    words = (result.stderr or result.stdout).strip().splitlines()
    print(f"skipped: {package} cannot be installed or started here: {words[-1] if words else result.returncode}")
    sys.exit(SKIPPED)


def run(command):
    environment = {**os.environ, "OMP_WAIT_POLICY": "passive"}  # threads that wait leave the processor to others
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, env=environment)


def python_with(package, folder):
    """The Python of a virtual environment that has the package."""
    python = folder / "venv/bin/python"
    module = package.split("==")[0]
    if not python.exists():
        made = run([sys.executable, "-m", "venv", folder / "venv"])
        if made.returncode != 0:
            skip("a virtual environment", made)
    if run([python, "-c", f"import {module}"]).returncode != 0:
        installed = run([python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", package])
        started = run([python, "-c", f"import {module}"])
        if installed.returncode != 0 or started.returncode != 0:
            skip(package, installed if installed.returncode != 0 else started)
    return python


def processor_seconds(*command):
    """User time of a command, which has to succeed."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run([*map(str, command)], check=True, capture_output=True)
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def checked(result, what):
    if result.returncode != 0:
        words = (result.stdout + result.stderr).splitlines()[-10:]
        sys.exit("\n".join([f"{what} failed ({result.returncode}):", *words]))
    return result


def batches_of(prefix):
    """For each channel the tile means of all batches."""
    channels = [[], [], []]
    for number in range(1, BATCHES + 1):
        width, height, values = pictures.read_pfm(f"{prefix}_{number}.pfm")
        for k in range(3):
            channels[k].append(rule_s2.tile_means(width, height, values[k::3]))
    return channels


def render_ours(program, case, scene, prefix):
    for number in range(1, BATCHES + 1):
        checked(run([program, "render", scene, "-o", f"{prefix}_{number}.pfm", "--size", "64x48", "--spp", case.ours,
                     "--seed", number, "--nee", "on", "--default-light", "off", "--quiet", "--no-progress"]),
                f"pathlight render {scene}")


def percent(value):
    return f"{100 * value:+.2f}"


def compare(case, ours, theirs):
    """The row of the table, and whether the case passes."""
    results = [rule_s2.Comparison(a, b) for a, b in zip(ours, theirs)]
    if case.differs:
        verdicts = [r.verdict_within(*bounds, case.delta) for r, bounds in zip(results, case.differs)]
    else:
        verdicts = [r.verdict(case.delta) for r in results]
    verdict = next((v for v in ("fail", "inconclusive") if v in verdicts), "pass")
    half = max(rule_s2.Z_ALPHA * r.error for r in results)
    expected = ", ".join(f"{percent(low)} to {percent(high)}" for low, high in dict.fromkeys(case.differs)) or "equal"
    return (f"| `{case.name}` | {', '.join(percent(r.difference) for r in results)} | {100 * half:.2f} | "
            f"{100 * max(r.largest for r in results):.1f} | {expected} | {case.delta * 100:g} | {verdict} |"), verdict == "pass"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("peer", choices=PEERS)
    parser.add_argument("--program", type=Path, required=True)
    parser.add_argument("--folder", type=Path, required=True)
    parser.add_argument("--only", action="append", default=[])
    options = parser.parse_args()
    package, script, suffix, cases = PEERS[options.peer]
    options.folder.mkdir(parents=True, exist_ok=True)
    python = python_with(package, options.folder.resolve())
    print("| scene | difference of the means, red, green, blue, % | +- | largest of a tile | expected | delta, % | verdict |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    failed = []
    for case in cases:
        if options.only and case.name not in options.only:
            continue
        folder = options.folder / case.name
        folder.mkdir(exist_ok=True)
        scene = folder / (case.name + suffix)
        content = case.write(folder)
        scene.write_bytes(content if isinstance(content, bytes) else content.encode())
        start = time.monotonic()
        render_ours(options.program, case, scene, folder / "ours")
        between = time.monotonic()
        checked(run([python, HERE / script, scene, case.theirs, BATCHES, folder / "theirs"]), f"{options.peer} {scene}")
        row, passes = compare(case, batches_of(folder / "ours"), batches_of(folder / "theirs"))
        print(row, flush=True)
        print(f"{case.name}: {between - start:.0f} s, {time.monotonic() - between:.0f} s", file=sys.stderr)
        if not passes:
            failed.append(case.name)
    if failed:
        sys.exit("not as expected: " + ", ".join(failed))


if __name__ == "__main__":
    main()
