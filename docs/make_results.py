#!/usr/bin/env python3
"""Writes results.md of the folder of a bench, with its plots of error against time, the plot of the front page, and its results.json,
compressed.

Usage: make_results.py BENCH   (after `pathlight bench SCENE... -o BENCH` with the options that results.md names, which makes the references,
and `pathlight report BENCH`)
       make_results.py           page and plot of the front page of the committed raw results
       make_results.py --check   exit code 1 if these two are not what the raw results give
"""
import json
import lzma
import math
import shutil
import statistics
import sys
from pathlib import Path

DOCS = Path(__file__).resolve().parent
PLOTS = DOCS / "images" / "results"
RAW = DOCS / "results.json.xz"
GAINS = DOCS / "images" / "gains.svg"
COLORS = {"faster": "#1b7f4d", "undecided": "#777777", "slower": "#b4370f"}


def interval(values, digits=3):
    """A value with its interval of 95 %, or the word unknown."""
    if values[0] is None:
        return "unknown"
    if any(v is None for v in values):
        return f"{values[0]:.{digits}g}"
    return f"{values[0]:.{digits}g} ({values[1]:.{digits}g} to {values[2]:.{digits}g})"


def head(results):
    backends = results["plan"]["backends"]
    machine = "; ".join(f"{name}: {b['device']}" + (f", {b['threads']} threads" if b["threads"] else "")
                        for name, b in backends.items())
    commits = ", ".join(results["commits"])
    return f"""# Results

This page has error against time of every method on every shipped scene. Each run starts with nothing learned, and placing, precomputing and
learning are charged. [make_results.py](make_results.py) makes the page of one bench, whose [raw results](results.json.xz) are beside it.

* Machine: {machine}. {results['date']}, version {results['version']}, commit {commits}.
* Command: `{results['command']}`
* References: {references(results)}.
* relMSE is {results['definitions']['metrics']['relmse']} with epsilon {results['definitions']['metrics']['epsilon']},
  taken against a reference in two halves, so that the reference's own noise drops out. Intervals: {results['definitions']['intervals']}{few_runs(results)}.
* Pictures are small and runs short, so that the bench fits into minutes; the cost of an update of the tables does not depend on the size, and
  weighs less in larger pictures. `precomputed` ends after its first sample where precomputing takes longer than the limit.
{light_samples(results)}

"""


def few_runs(results):
    """What intervals of fewer runs than kFewestRuns (core/measure/statistics.h) are worth."""
    fewest = min(s["runs"] for s in results["summary"])
    return "" if fewest >= 5 else f".\n  They are of {fewest} runs and thus rough: `bench` itself prints none below 5"


def light_samples(results):
    """A line that says whether lights were sampled, which decides much of what learning can gain."""
    if "--nee off" not in results["command"]:
        return "* All runs have light samples (next-event estimation), the program's default."
    return ("* No run has light samples (`--nee off`): learning gains most without them, and [less with them](learning.md#with-light-samples),\n"
            "  the program's default.")


def references(results):
    found = results["references"].values()
    samples = sorted({n for r in found for n in r["spp"]})
    noise = [r["noise_relmse"] for r in found]
    span = str(samples[0]) if len(samples) == 1 else f"{samples[0]} to {samples[-1]}"
    return f"two halves of {span} samples each, own noise (relMSE) {min(noise):.2g} to {max(noise):.2g}"


def verdict(comparison):
    """Time of the first method over that of this one to the same error: above 1 this one is faster."""
    net = comparison["net"]
    if net[0] is None or net[1] is None or net[2] is None:
        return "unknown"
    return f"{interval(net)} {word_of(*net[1:])}"


def word_of(low, high):
    return "faster" if low > 1 else "slower" if high < 1 else "undecided"


def gains(results):
    base = results["plan"]["methods"][0]
    others = results["plan"]["methods"][1:]
    rows = [f"## To the same error\nThe table says how many times less time than `{base}` a method needs to equal error; below 1 it needs more time.\n",
            "| scene | back end | " + " | ".join(f"`{m}`" for m in others) + " |", "| --- " * (len(others) + 2) + "|"]
    cells = {(c["scene"], c["backend"], c["method"]): verdict(c) for c in results["comparisons"]}
    for scene, backend in sorted({(s, b) for s, b, _ in cells}):
        rows.append(f"| `{scene}` | {backend} | " + " | ".join(cells.get((scene, backend, m), "") for m in others) + " |")
    nets = {m: [c["net"][0] for c in results["comparisons"] if c["method"] == m and c["net"][0]] for m in others}
    return "\n".join(rows) + "\n\n" + "\n".join(count_verdicts(cells, m) + mean_factor(nets[m]) for m in others) + "\n\n"


def mean_factor(factors):
    return f" Geometric mean of {len(factors)}: {statistics.geometric_mean(factors):.3g}." if factors else ""


def count_verdicts(cells, method):
    """A line that counts faster, undecided and slower scenes of a method, and names those that are not faster."""
    ends = {word: sorted({f"`{s}`" for (s, _, m), text in cells.items() if m == method and text.endswith(word)})
            for word in ("faster", "undecided", "slower")}
    named = [f"{word} on {len(ends[word])}" + (f" ({', '.join(ends[word])})" if word != "faster" and ends[word] else "") for word in ends]
    return f"* `{method}`: {', '.join(named)}."


def ends(results):
    rows = ["## Runs\n", "| scene | back end | method | runs | relMSE at the end | seconds | samples per second | bias | invalid |",
            "| --- | --- | --- | --- | --- | --- | --- | --- | --- |"]
    for s in results["summary"]:
        per_sample = s["seconds_per_sample"][0]
        rate = f"{1 / per_sample:.3g}" if per_sample else "unknown"
        bias = "unknown" if s["relative_bias"][0] is None else f"{100 * s['relative_bias'][0]:+.2g} %"
        rows.append(f"| `{s['scene']}` | {s['backend']} | `{s['method']}` | {s['runs']} | {interval(s['relmse'])} | "
                    f"{s['seconds'][0]:.3g} | {rate} | {bias} | {s['invalid_samples']} |")
    return "\n".join(rows) + "\n\n"


def gains_plot(results):
    """An SVG of the net factor of reinforcement on every scene, with intervals, on a logarithmic axis."""
    rows = sorted((c["net"], c["scene"]) for c in results["comparisons"] if c["method"] == "reinforcement" and None not in c["net"])
    height = 20 * len(rows) + 70

    def x_of(factor):
        return 130 + 570 * math.log(min(max(factor, 0.125), 8) / 0.125) / math.log(64)

    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 720 {height}" font-family="sans-serif" font-size="13">',
             f'<rect width="720" height="{height}" rx="8" fill="#fff"/>']
    for tick in (0.125, 0.25, 0.5, 1, 2, 4, 8):
        x, color = f"{x_of(tick):.1f}", "#333" if tick == 1 else "#ddd"
        parts.append(f'<line x1="{x}" y1="14" x2="{x}" y2="{height - 48}" stroke="{color}"/>')
        parts.append(f'<text x="{x}" y="{height - 32}" text-anchor="middle" fill="#222">{tick:g}</text>')
    for i, ((value, low, high), scene) in enumerate(reversed(rows)):
        y, color = 24 + 20 * i, COLORS[word_of(low, high)]
        parts.append(f'<text x="118" y="{y + 4}" text-anchor="end" fill="#222">{scene}</text>')
        parts.append(f'<line x1="{x_of(low):.1f}" y1="{y}" x2="{x_of(high):.1f}" y2="{y}" stroke="{color}" stroke-width="3"/>')
        parts.append(f'<circle cx="{x_of(value):.1f}" cy="{y}" r="5" fill="{color}"/>')
    parts.append(f'<text x="360" y="{height - 10}" text-anchor="middle" fill="#222">time of default over time of reinforcement, '
                 'to the same error, with 95 % intervals; right of 1 learning wins</text>')
    return "\n".join([*parts, "</svg>"]) + "\n"


def plots(results):
    rows = ["## Error against seconds\n"]
    for scene in results["plan"]["scenes"]:
        rows.append(f'<img src="images/results/{scene["name"]}-time.svg" width="400" alt="{scene["name"]}: error against seconds">')
    return "\n".join(rows) + "\n"


def copy_plots(results, folder):
    PLOTS.mkdir(parents=True, exist_ok=True)
    for old in PLOTS.glob("*.svg"):
        old.unlink()
    for scene in results["plan"]["scenes"]:
        shutil.copy(folder / f"{scene['name']}-time.svg", PLOTS)


def page(results):
    return head(results) + gains(results) + ends(results) + plots(results)


def take_bench(folder):
    """Copies raw results and plots of a bench."""
    raw = (folder / "results.json").read_bytes()
    results = json.loads(raw)
    if not results["complete"]:
        sys.exit(f"{folder}: the bench is not complete; run it again, it goes on where it was")
    copy_plots(results, folder)
    RAW.write_bytes(lzma.compress(raw, preset=9))


def main():
    if len(sys.argv) > 2:
        sys.exit(__doc__)
    wanted = sys.argv[1] if len(sys.argv) == 2 else ""
    if wanted not in ("", "--check"):
        take_bench(Path(wanted))
    results = json.loads(lzma.decompress(RAW.read_bytes()))
    written = {DOCS / "results.md": page(results), GAINS: gains_plot(results)}
    if wanted == "--check":
        stale = [path.name for path, text in written.items() if path.read_text() != text]
        sys.exit(f"not what the raw results give: {', '.join(stale)}" if stale else 0)
    for path, text in written.items():
        path.write_text(text)


if __name__ == "__main__":
    main()
