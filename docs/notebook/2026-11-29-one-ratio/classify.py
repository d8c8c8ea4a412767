#!/usr/bin/env python3
"""Ratio of relative variances, default over guided, by which a film decides whether guiding pays, against what guiding gains.

classify.py FOLDER SIDE [CLAMP]: FOLDER holds SCENE.default.SEED and SCENE.reinforcement.SEED, written by build/*/bench/pass_records with
48 passes. CLAMP: largest quotient of a sample, 1024 as in core/kernel/film/sample_variance.h.
"""
import glob
import os
import sys

import numpy as np

PASSES = 48
WINDOWS = ((2, 4), (4, 8), (8, 12), (8, 16))


def pictures(path, side):
    size = 16 + 12 * side * side
    raw = np.fromfile(path, np.uint8)
    raw = raw[: len(raw) // size * size].reshape(-1, size)
    seconds = raw[:, :8].copy().view(np.float64)[:, 0]
    return seconds[:PASSES], raw[:, 16:].copy().view(np.float32).reshape(-1, side, side, 3)[:PASSES]


def ratios(default, guided, clamp):
    """Of each window, with the means of the guided film."""
    sums = np.zeros((2, 16))
    for number in range(2, 16):
        # The half that the pass does not belong to.
        mean = guided[1 - number % 2 : number : 2].mean(0)
        for kind, passes in enumerate((default, guided)):
            quotient = passes[number] * (passes[number] - mean) / (mean * mean + 0.01)
            sums[kind, number] = np.clip(quotient, -clamp, clamp).mean()
    return [sums[0, a:b].sum() / sums[1, a:b].sum() for a, b in WINDOWS]


def error(films, reference):
    """relMSE of one film without the worst thousandth, by the differences of films of different seeds."""
    errors = []
    for i, one in enumerate(films):
        for other in films[:i]:
            squares = ((one.mean(0) - other.mean(0)) ** 2 / (reference**2 + 0.01)).mean(2).ravel()
            errors.append(np.sort(squares)[: -max(1, squares.size // 1000)].mean() / 2)
    return np.mean(errors)


def main():
    folder, side = sys.argv[1], int(sys.argv[2])
    clamp = float(sys.argv[3]) if len(sys.argv) > 3 else 1024.0
    scenes = sorted({os.path.basename(f).split(".")[0] for f in glob.glob(os.path.join(folder, "*.default.*"))})
    rows = []
    for scene in scenes:
        films = {
            method: [pictures(f, side) for f in sorted(glob.glob(os.path.join(folder, f"{scene}.{method}.*")))]
            for method in ("default", "reinforcement")
        }
        default, guided = ([picture for _, picture in films[method]] for method in films)
        reference = np.mean([film.mean(0) for film in default + guided], 0)
        gain = error(default, reference) / error(guided, reference)
        price = np.median([s[8:] for s, _ in films["reinforcement"]]) / np.median([s for s, _ in films["default"]])
        by_seed = np.array([ratios(d, g, clamp) for d, g in zip(default, guided)])
        spans = " | ".join(f"{low:.2f} to {high:.2f}" for low, high in zip(by_seed.min(0), by_seed.max(0)))
        rows.append((gain, f"| `{scene}` | {gain:.2f} | {price:.2f} | {spans} |"))
    print("| scene | gain of 48 passes at equal samples | price | " + " | ".join(f"passes {a + 1} to {b}" for a, b in WINDOWS) + " |")
    print("| --- | --- | --- |" + " --- |" * len(WINDOWS))
    for _, row in sorted(rows):
        print(row)


main()
