#!/usr/bin/env python3
"""Writes results.md of the folder of a bench, with its plots of error against time and its results.json, compressed.

Usage: make_results.py BENCH   (after `pathlight bench SCENE... -o BENCH` with the options that results.md names, which makes the references,
and `pathlight report BENCH`)
"""
import json
import lzma
import shutil
import statistics
import sys
from pathlib import Path

DOCS = Path(__file__).resolve().parent
PLOTS = DOCS / "images" / "results"


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
    word = "faster" if net[1] > 1 else "slower" if net[2] < 1 else "undecided"
    return f"{interval(net)} {word}"


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


def plots(results, folder):
    PLOTS.mkdir(parents=True, exist_ok=True)
    for old in PLOTS.glob("*.svg"):
        old.unlink()
    rows = ["## Error against seconds\n"]
    for scene in results["plan"]["scenes"]:
        name = f"{scene['name']}-time.svg"
        shutil.copy(folder / name, PLOTS / name)
        rows.append(f'<img src="images/results/{name}" width="400" alt="{scene["name"]}: error against seconds">')
    return "\n".join(rows) + "\n"


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = Path(sys.argv[1])
    results = json.loads((folder / "results.json").read_text())
    if not results["complete"]:
        sys.exit(f"{folder}: the bench is not complete; run it again, it goes on where it was")
    text = head(results) + gains(results) + ends(results) + plots(results, folder)
    (DOCS / "results.md").write_text(text)
    (DOCS / "results.json.xz").write_bytes(lzma.compress((folder / "results.json").read_bytes(), preset=9))


if __name__ == "__main__":
    main()
