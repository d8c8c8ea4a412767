#!/usr/bin/env python3
"""Writes results.md and the plot of the front page of the raw results in results/.

Usage: make_results.py [BENCH...]   each folder of `pathlight bench SCENE... -o BENCH` that `pathlight report` has made a page of replaces the
results of its name (one of TITLES), and its plots of error against time; without any, the page is made again of those that are there
       make_results.py --check      exit code 1 if page and plot are not what the raw results give
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
RAW = DOCS / "results"
GAINS = DOCS / "images" / "gains.svg"
# The benches of the page, in its order. The first gives the plots.
TITLES = {"light-samples-on": "With light samples", "light-samples-on-larger": "With light samples, larger pictures",
          "light-samples-off": "Without light samples"}
# An interval that reaches further from its value is one of few bright paths: the trimmed error decides instead.
WIDEST = (0.8, 1.25)
COLORS = {"faster": "#1b7f4d", "undecided": "#777777", "slower": "#b4370f"}


def interval(values, digits=3):
    """A value with its interval of 95 %, or the word unknown."""
    if values[0] is None:
        return "unknown"
    if any(v is None for v in values):
        return f"{values[0]:.{digits}g}"
    return f"{values[0]:.{digits}g} ({values[1]:.{digits}g} to {values[2]:.{digits}g})"


def head(definitions):
    return f"""# Results

This page has error against time of every method on every shipped scene. Each run starts with nothing learned, and placing, precomputing and
learning are charged. [make_results.py](make_results.py) makes the page of the [raw results](results) of benches.

* The tables *to the same error* have the time that the first method needs over the time that another method needs, to equal error. Below 1
  the other method needs more time. *Trimmed* is without the worst {percent(definitions)} % of the pixels. Where the interval of the whole error
  reaches below {WIDEST[0]} or above {WIDEST[1]} times its value, a few bright paths rule the error, and the trimmed error decides what is faster.
* relMSE is {definitions['metrics']['relmse']} with epsilon {definitions['metrics']['epsilon']},
  taken against a reference in two halves, so that the reference's own noise drops out. Intervals: {definitions['intervals']}.
* Pictures are small and runs short, so that a bench fits into minutes; the cost of an update of the tables does not depend on the size, and
  weighs less in larger pictures. `precomputed` ends after its first sample where precomputing takes longer than the limit.
* Light samples (next-event estimation) are the program's default. Learning gains most without them.

"""


def section(name, results):
    """A bench: how it was measured, and its tables."""
    machine = "; ".join(f"{backend}: {b['device']}" + (f", {b['threads']} threads" if b["threads"] else "")
                        for backend, b in results["plan"]["backends"].items())
    return f"""## {TITLES[name]}
* Machine: {machine}. {results['date']}, version {results['version']}, commit {', '.join(results['commits'])}.
* Command: `{results['command']}`
* References: {references(results)}{few_runs(results)}.

""" + gains(results) + ends(results)


def few_runs(results):
    """What intervals of fewer runs than kFewestRuns (core/measure/statistics.h) are worth."""
    fewest = min(s["runs"] for s in results["summary"])
    return "" if fewest >= 5 else f".\n  Intervals are of {fewest} runs and thus rough: `bench` itself prints none below 5"


def references(results):
    found = results["references"].values()
    samples = sorted({n for r in found for n in r["spp"]})
    noise = [r["noise_relmse"] for r in found]
    span = str(samples[0]) if len(samples) == 1 else f"{samples[0]} to {samples[-1]}"
    return f"two halves of {span} samples each, own noise (relMSE) {min(noise):.2g} to {max(noise):.2g}"


def percent(definitions):
    return f"{100 * definitions['metrics']['trimmed_share']:g}"


def decisive(comparison):
    """Time of the first method over that of this one to the same error, whole or trimmed: above 1 this one is faster."""
    net = comparison["net"]
    is_narrow = None not in net and net[1] >= WIDEST[0] * net[0] and net[2] <= WIDEST[1] * net[0]
    return net if is_narrow else comparison["net_trimmed"]


def verdict(factor):
    """Of a factor of time with its interval."""
    return "unknown" if None in factor else word_of(*factor[1:])


def word_of(low, high):
    return "faster" if low > 1 else "slower" if high < 1 else "undecided"


def gains(results):
    base = results["plan"]["methods"][0]
    others = results["plan"]["methods"][1:]
    rows = [f"### To the same error as `{base}`\n",
            "| scene | back end | " + " | ".join(f"`{m}` | trimmed | " for m in others) + " |", "| --- " * (3 * len(others) + 2) + "|"]
    cells = {(c["scene"], c["backend"], c["method"]): c for c in results["comparisons"]}
    for scene, backend in sorted({(s, b) for s, b, _ in cells}):
        found = [cells.get((scene, backend, m)) for m in others]
        rows.append(f"| `{scene}` | {backend} | " + " | ".join(factors(c) if c else " | | " for c in found) + " |")
    return "\n".join(rows) + "\n\n" + "\n".join(count_verdicts(results, m) + mean_factor(results, m) for m in others) + "\n\n"


def factors(comparison):
    return f"{interval(comparison['net'])} | {interval(comparison['net_trimmed'])} | {verdict(decisive(comparison))}"


def mean_factor(results, method):
    known = [decisive(c)[0] for c in results["comparisons"] if c["method"] == method and decisive(c)[0]]
    return f" Geometric mean over {len(known)} scenes: {statistics.geometric_mean(known):.3g}." if known else ""


def count_verdicts(results, method):
    """A line that counts faster, undecided and slower scenes of a method, and names those that are not faster."""
    ends = {word: sorted({f"`{c['scene']}`" for c in results["comparisons"] if c["method"] == method and verdict(decisive(c)) == word})
            for word in ("faster", "undecided", "slower")}
    named = [f"{word} on {len(ends[word])}" + (f" ({', '.join(ends[word])})" if word != "faster" and ends[word] else "") for word in ends]
    return f"* `{method}`: {', '.join(named)}."


def ends(results):
    rows = ["### Runs\n", "| scene | back end | method | runs | relMSE at the end | seconds | samples per second | bias | invalid |",
            "| --- | --- | --- | --- | --- | --- | --- | --- | --- |"]
    for s in results["summary"]:
        per_sample = s["seconds_per_sample"][0]
        rate = f"{1 / per_sample:.3g}" if per_sample else "unknown"
        bias = "unknown" if s["relative_bias"][0] is None else f"{100 * s['relative_bias'][0]:+.2g} %"
        rows.append(f"| `{s['scene']}` | {s['backend']} | `{s['method']}` | {s['runs']} | {interval(s['relmse'])} | "
                    f"{s['seconds'][0]:.3g} | {rate} | {bias} | {s['invalid_samples']} |")
    return "\n".join(rows) + "\n\n"


def gains_plot(results):
    """An SVG of the decisive factor of reinforcement on every scene, with intervals, on a logarithmic axis."""
    rows = sorted((decisive(c), c["scene"]) for c in results["comparisons"] if c["method"] == "reinforcement" and None not in decisive(c))
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


def page(benches):
    first = next(iter(benches.values()))
    return head(first["definitions"]) + "".join(section(name, results) for name, results in benches.items()) + plots(first)


def take_bench(folder):
    """Keeps the raw results of a bench and, if it is the first of the page, its plots."""
    if folder.name not in TITLES:
        sys.exit(f"{folder}: expected a folder named {', '.join(TITLES)}")
    raw = (folder / "results.json").read_bytes()
    results = json.loads(raw)
    if not results["complete"]:
        sys.exit(f"{folder}: the bench is not complete; run it again, it goes on where it was")
    if folder.name == next(iter(TITLES)):
        copy_plots(results, folder)
    RAW.mkdir(exist_ok=True)
    (RAW / f"{folder.name}.json.xz").write_bytes(lzma.compress(raw, preset=9))


def main():
    given = sys.argv[1:]
    check = given == ["--check"]
    if not check:
        for folder in given:
            take_bench(Path(folder))
    files = {name: RAW / f"{name}.json.xz" for name in TITLES}
    benches = {name: json.loads(lzma.decompress(file.read_bytes())) for name, file in files.items() if file.is_file()}
    written = {DOCS / "results.md": page(benches), GAINS: gains_plot(next(iter(benches.values())))}
    if check:
        stale = [path.name for path, text in written.items() if path.read_text() != text]
        sys.exit(f"not what the raw results give: {', '.join(stale)}" if stale else 0)
    for path, text in written.items():
        path.write_text(text)


if __name__ == "__main__":
    main()
