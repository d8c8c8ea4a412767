#!/usr/bin/env python3
"""Rules that mix guided passes and passes of default, tried on records of single passes.

try_rules.py FOLDER SIDE: FOLDER holds SCENE.default.SEED and SCENE.reinforcement.SEED, written by build/*/bench/pass_records with 48
passes of SIDE x SIDE pixels. The seeds of the two methods differ by 1000, so that their random numbers are independent. Needs numpy.
"""
import glob
import os
import sys

import numpy as np

PASSES = 48
BUDGET = 40  # passes of default in the time of a picture
TILE = 16
RAMP = np.minimum(np.arange(PASSES) + 1, 4.0)  # weights of the passes of a learner, core/session/path_settings.cpp
CLAMPS = (16, 256, 4096)


def load(path, side):
    """Seconds of each pass, and its picture."""
    size = 16 + 12 * side * side
    raw = np.fromfile(path, dtype=np.uint8).reshape(-1, size)
    seconds = raw[:, :8].copy().view(np.float64)[:, 0]
    return seconds, raw[:, 16:].copy().view(np.float32).reshape(-1, side, side, 3)


def tiles(picture):
    height, width, channels = picture.shape
    return picture.reshape(height // TILE, TILE, width // TILE, TILE, channels).mean((1, 3, 4))


class Arm:
    """The passes of one kind. Even and odd passes form halves; member k of each list is after k passes."""

    def __init__(self, pictures, weights):
        self.pictures = pictures.astype(np.float64)
        side = pictures.shape[1]
        zero = np.zeros((side, side, 3))
        grid = np.zeros((side // TILE, side // TILE))
        self.sums, self.weights, self.squares = [[zero], [zero]], [[0.0], [0.0]], [[0.0], [0.0]]
        self.spread, self.measured, self.level = [[grid], [grid]], [[0], [0]], [[grid], [grid]]
        plain, count = [zero, zero], [0, 0]
        for k, picture in enumerate(self.pictures):
            half, other = k % 2, 1 - k % 2
            for lists in (self.sums, self.weights, self.squares, self.spread, self.measured, self.level):
                lists[other].append(lists[other][-1])
            spread, measured = self.spread[half][-1], self.measured[half][-1]
            if count[half] > 0:  # Welford's step: unbiased for independent samples, and never negative
                seen = count[half]
                spread = spread + tiles((picture - plain[half] / seen) ** 2) * seen / (seen + 1)
                measured += 1
            plain[half] = plain[half] + picture
            count[half] += 1
            self.spread[half].append(spread)
            self.measured[half].append(measured)
            self.level[half].append(tiles(plain[half]) / count[half])
            self.sums[half].append(self.sums[half][-1] + weights[k] * picture)
            self.weights[half].append(self.weights[half][-1] + weights[k])
            self.squares[half].append(self.squares[half][-1] + weights[k] ** 2)

    def mean(self, half, k):
        return self.sums[half][k] / max(self.weights[half][k], 1e-9)

    def samples(self, half, k):
        """As many samples of equal weight have the variance of the weighted mean."""
        return self.weights[half][k] ** 2 / max(self.squares[half][k], 1e-9)

    def variance(self, half, k, newest=PASSES):
        """Of a sample, by tile, from the newest passes of a half."""
        first = max(0, k - newest)
        count = self.measured[half][k] - self.measured[half][first]
        return (self.spread[half][k] - self.spread[half][first]) / max(count, 1), count


def to_pixels(grid, side):
    """Bilinear, so that tiles have no seams."""
    place = (np.arange(side) + 0.5) / TILE - 0.5
    low = np.clip(np.floor(place).astype(int), 0, len(grid) - 2)
    part = np.clip(place - low, 0.0, 1.0)
    rows = grid[low] * (1 - part)[:, None] + grid[low + 1] * part[:, None]
    return rows[:, low] * (1 - part) + rows[:, low + 1] * part


def ratio_of(baseline, guided, scale, kind):
    """Variance of a sample of default over that of a guided path."""
    by_mse = baseline.mean() / guided.mean()
    by_relmse = (baseline * scale).mean() / (guided * scale).mean()
    both = np.sqrt(by_mse * by_relmse)
    if kind != "tile":
        return {"mse": by_mse, "relmse": by_relmse, "both": both}[kind]
    prior = (baseline + guided * both) / 2  # shrinkage, with the weight of four passes
    return lambda n, m: (n * baseline + 4 * prior) / (n + 4) / ((m * guided + 4 * prior / both) / (m + 4) + 1e-12)


def mixed(baseline, guided, counts, kind):
    """The picture of counts[0] passes of default and counts[1] guided ones. Weights of a half come from the other half."""
    n, m = counts
    picture = 0
    for half in (0, 1):
        other = 1 - half
        samples = baseline.samples(half, n), guided.samples(half, m)
        (v, seen), (w, seen_guided) = baseline.variance(other, n), guided.variance(other, m)
        if samples[0] == 0 or samples[1] == 0:
            share = float(samples[0] == 0)
        else:
            ratio = 1.0
            if kind != "samples" and seen and seen_guided:
                scale = 1 / (((baseline.level[other][n] + guided.level[other][m]) / 2) ** 2 + 0.01)
                ratio = ratio_of(v, w, scale, kind)
                ratio = np.clip(ratio(seen, seen_guided) if callable(ratio) else ratio, 1 / 64, 64)
            share = samples[1] * ratio / (samples[1] * ratio + samples[0])
        if np.ndim(share):
            share = to_pixels(share, len(baseline.pictures[0]))[..., None]
        picture = picture + (share * guided.mean(half, m) + (1 - share) * baseline.mean(half, n)) / 2
    return picture


def schedule(baseline, guided, cost, share_of):
    """Numbers of passes of default and of guided ones, which take `cost`, by the share of guided time that a rule asks for."""
    n = m = 0
    while True:
        time = n + m * cost
        is_guided = m < PASSES and (n >= PASSES or m * cost < share_of(baseline, guided, n, m, cost) * (time + 1e-9))
        if m == 0 and n == 0:
            is_guided = share_of(baseline, guided, 0, 0, cost) >= 0.5
        if time + (cost if is_guided else 1) > BUDGET + 0.5:
            return n, m
        n, m = n + (not is_guided), m + is_guided


def fixed(share):
    return lambda *_: share


def larger_gain(baseline, guided, n, m, cost):
    """0.9 or 0.1: whichever pass takes more relative variance from the tiles for its time."""
    if n < 4 or m < 4:
        return 0.5
    scale = 1 / (((baseline.level[0][n] + guided.level[0][m]) / 2) ** 2 + 0.01)
    v = scale * (baseline.variance(0, n)[0] + baseline.variance(1, n)[0]) / 2 + 1e-9
    w = scale * (guided.variance(0, m, 16)[0] + guided.variance(1, m, 16)[0]) / 2 + 1e-9
    precision = n / v + m / w
    return 0.9 if (1 / w / cost / precision**2).sum() > (1 / v / precision**2).sum() else 0.1


def errors(pictures, truth):
    """MSE, relMSE, relMSE without the worst thousandth, from the differences between seeds: all pictures are unbiased."""
    pictures = np.array(pictures)
    square = pictures.var(0, ddof=1)
    relative = np.sort((square / (truth**2 + 0.01)).mean(-1).ravel())
    kept = int(0.999 * len(relative))
    return np.array([square.mean(), relative.mean(), relative[:kept].sum() / len(relative)])


def clamped_sums(pictures):
    """By pass and clamp: L (L - m) / (m^2 + 0.01) and L (L - m), with m of the other half, as core/kernel/film/sample_variance.h."""
    sums = np.zeros((PASSES, len(CLAMPS), 2))
    totals, count = [0.0, 0.0], [0, 0]
    for k, picture in enumerate(pictures.astype(np.float64)):
        half = k % 2
        if k >= 3:
            mean = totals[1 - half] / count[1 - half]
            product = picture * (picture - mean)
            for i, clamp in enumerate(CLAMPS):
                sums[k, i, 0] = np.clip((product / (mean**2 + 0.01)).mean(-1), -clamp, clamp).mean()
                sums[k, i, 1] = np.clip(product.mean(-1), -clamp, clamp).mean()
        totals[half] = totals[half] + picture
        count[half] += 1
    return sums


RULES = {
    "guided": ("samples", fixed(1.0)),
    "half, by samples": ("samples", fixed(0.5)),
    "half, by both": ("both", fixed(0.5)),
    "half, by tile": ("tile", fixed(0.5)),
    "0.1, by tile": ("tile", fixed(0.1)),
    "0.9, by tile": ("tile", fixed(0.9)),
    "larger gain, by both": ("both", larger_gain),
    "larger gain, by tile": ("tile", larger_gain),
}


def main(folder, side):
    names = sorted({os.path.basename(path).split(".")[0] for path in glob.glob(folder + "/*.reinforcement.*")})
    gains, predictions = {rule: [] for rule in RULES}, {}
    print("relMSE of default over that of the rule at equal time, and the same without the worst thousandth:", ", ".join(RULES))
    for name in names:
        paths = [(f"{folder}/{name}.default.{seed}", f"{folder}/{name}.reinforcement.{seed}") for seed in range(1, 11)]
        records = [[load(path, side) for path in pair] for pair in paths if all(map(os.path.exists, pair))]
        records = [pair for pair in records if all(len(kind[1]) == PASSES for kind in pair)]
        if len(records) < 2:
            continue
        cost = np.median([pair[1][0][8:] for pair in records]) / np.median([pair[0][0] for pair in records])
        arms = [(Arm(pair[0][1], np.ones(PASSES)), Arm(pair[1][1], RAMP)) for pair in records]
        truth = np.mean([arm.mean(half, PASSES) for pair in arms for arm in pair for half in (0, 1)], 0)
        plain = errors([mixed(*pair, (BUDGET, 0), "samples") for pair in arms], truth)
        row = []
        for rule, (kind, share_of) in RULES.items():
            pictures = [mixed(*pair, schedule(*pair, cost, share_of), kind) for pair in arms]
            gains[rule].append(plain / errors(pictures, truth))
            row.append("%.2f %.2f" % tuple(gains[rule][-1][1:]))
        print("%-14s cost %.2f  " % (name, cost) + ", ".join(row), flush=True)
        last = errors([mixed(*pair, (PASSES, 0), "samples") for pair in arms], truth)
        gained = last / errors([mixed(*pair, (0, PASSES), "samples") for pair in arms], truth) / cost
        sums = np.array([[clamped_sums(arm.pictures) for arm in pair] for pair in arms])
        for first, end in ((3, 8), (8, 16), (32, 48)):
            ratio = sums[:, 0, first:end].mean(1) / sums[:, 1, first:end].mean(1) / cost
            log = np.log(np.maximum(ratio, 1e-3))
            for i, clamp in enumerate(CLAMPS):
                for j, kind in enumerate(("relative", "absolute")):
                    predictions.setdefault((kind, clamp, first, end), []).append(
                        (log[:, i, j].std(ddof=1), log[:, i, j].mean() - np.log(gained[2])))
    for rule, gain in gains.items():
        logs = np.log(np.array(gain)[:, 1:])
        print("%-22s geometric mean %.2f %.2f, worst %.2f %.2f" % (rule, *np.exp(logs.mean(0)), *np.exp(logs.min(0))))
    print("log of the predicted gain: kind, clamp, passes; spread over seeds (median, worst); error (mean, standard deviation)")
    for key, rows in predictions.items():
        spread, error = np.array(rows).T
        print("%-9s %5d %2d-%2d  " % key + "%.3f %.3f  %+.3f %.3f" % (np.median(spread), spread.max(), error.mean(), error.std()))


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]))
