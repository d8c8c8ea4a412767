#!/usr/bin/env python3
"""Writes literature.md of the raw results in literature/, published figures beside them.

Usage: make_literature.py [BENCH...]   each folder of `pathlight bench --protocol ...` that `pathlight report` has made a page of replaces
the results of its name in literature/, and its pictures; without any, the page is made again of those that are there.
       make_literature.py --check      exit code 1 if the page is not what the raw results give
"""
import base64
import json
import lzma
import re
import sys
import tempfile
from pathlib import Path

from make_pictures import read_png, shrink
from make_results import interval, verdict

DOCS = Path(__file__).resolve().parent
RAW = DOCS / "literature"
STRIPS = DOCS / "images" / "literature"
TITLES = {"veach-ajar": "Veach, Ajar", "veach-bidir": "Veach, Bidir Room", "breakfast-room": "The Breakfast Room",
          "grey-white-room": "The Grey & White Room", "staircase": "The Wooden Staircase", "classroom": "Japanese Classroom",
          "bathroom": "Contemporary Bathroom", "kitchen": "Country Kitchen", "spaceship": "Spaceship"}
# What the page has to answer for: scene, light samples, figure of a comparison, the least that is wanted, and why that much.
GOALS = [
    ("veach-ajar", "off", "samples", 8.3, "the gain published for a network per vertex by radiance"),
    ("veach-ajar", "off", "samples", 13.4, "the gain published for a network per vertex by product"),
    ("veach-ajar", "on", "net", 2.5, "the goal of this project"),
    ("veach-bidir", "on", "net", 3.2, "the goal of this project"),
]
LEAST = 0.95
# What figures of the tables come from.
NOTES = [
    "The Breakfast Room, light samples off: in most pixels `default` does not find the sun within 64 samples. Its trimmed error is the "
    "missing light,\n  which is the same for every seed. `reinforcement` finds the sun more often; each such path is a bright pixel, so its trimmed error is larger,\n  and its whole error, of a few pixels, smaller.",
    "Where light samples are on, so small a picture pays for asking whether guiding pays, by two training passes of small weight, and for placing volumes:\n  on The Grey & White Room, where it gives guiding up, an eighth of its 64 samples' time.",
]


def keep(folder):
    """Takes the results and the strips of pictures of a bench."""
    results = json.loads((folder / "results.json").read_text())
    if not results["complete"]:
        sys.exit(f"{folder}: the bench is not complete; run it again, it goes on where it was")
    RAW.mkdir(exist_ok=True)
    STRIPS.mkdir(parents=True, exist_ok=True)
    (RAW / f"{folder.name}.json.xz").write_bytes(lzma.compress(json.dumps(results).encode(), preset=9))
    page = (folder / "report.html").read_text()
    for scene in json.loads(re.search(r'id="pictures">(.*?)</script>', page, re.DOTALL)[1]):
        urls = [cell["points"][-1]["picture"] for cell in scene["cells"]] + [scene["reference"]]
        with tempfile.TemporaryDirectory() as work:
            files = [Path(work) / f"{number}.png" for number in range(len(urls))]
            for file, url in zip(files, urls):
                file.write_bytes(base64.b64decode(url.split(",", 1)[1]))
            shrink([[read_png(file) for file in files]], STRIPS / f"{scene['scene']}-{folder.name}.png")


class Bench:
    def __init__(self, path):
        self.name = path.name.removesuffix(".json.xz")
        self.results = json.loads(lzma.decompress(path.read_bytes()))
        self.settings = {s["name"]: s["settings"] for s in self.results["plan"]["scenes"]}
        self.base = self.results["plan"]["methods"][0]

    def cell(self, scene, method):
        return next(c for c in self.results["summary"] if c["scene"] == scene and c["method"] == method)

    def comparisons(self):
        return self.results["comparisons"]


def light_samples(settings):
    return "on" if settings["nee"] == "on" else "off"


def all_comparisons(benches):
    """(bench, scene's settings, comparison)."""
    return [(b, b.settings[c["scene"]], c) for b in benches for c in b.comparisons()]


def about(benches):
    first = benches[0].results
    backends = first["plan"]["backends"]
    machine = "; ".join(f"{b['device']}, {b['threads']} threads" for b in backends.values())
    commits = sorted({c for b in benches for c in b.results["commits"]})
    lines = ["# Scenes of the literature", "",
             "This page has the gains of guiding on scenes that papers on path guiding use, with intervals, with and without light samples.",
             "Published figures stand beside them where settings agree. [make_literature.py](make_literature.py) makes this page of raw results in [literature](literature);",
             "[measuring.md](measuring.md#suites-and-protocols) says how to repeat them, and defines terms and intervals.", "",
             f"* Machine: {machine}, with nothing else on it. Commit {', '.join(commits)}."]
    lines.append("* References are two halves by `pathlight reference --method reinforcement`, which has the least noise where light is hidden; tests "
                 "hold\n  its means to the means of `default`. Pictures are small and runs short: longer runs gain more by learning.\n"
                 "* A path that finds the sun or a lamp by chance weighs a thousand times as much as others where lights are not sampled. Then relMSE is\n"
                 "  the error of a few pixels, and trimmed relMSE says more.")
    for b in benches:
        sizes = ", ".join(sorted({s["size"] for s in b.settings.values()}))
        first_settings = next(iter(b.settings.values()))
        limits = [f"{first_settings['spp']} samples per pixel"] if first_settings["spp"] else []
        limits += [f"{first_settings['time-limit']} s"] if first_settings["time-limit"] else []
        noise = [r["noise_relmse"] for r in b.results["references"].values()]
        lines.append(f"* `{b.name}` ({b.results['date']}): `{b.results['command']}`; {sizes} pixels, at most {' and '.join(limits)}, "
                     f"{b.results['plan']['seeds']} seeds; own noise of the references {min(noise):.2g} to {max(noise):.2g}.")
    return "\n".join(lines) + "\n\n"


def losses(benches):
    """What does not gain, first."""
    rows = ["## What does not gain\n"]
    for b, settings, c in all_comparisons(benches):
        net = c["net"]
        if net[0] is not None and net[0] >= 1.0 and net[1] is not None and net[1] > 1.0:
            continue
        rows.append(f"* {TITLES.get(c['scene'], c['scene'])}, light samples {light_samples(settings)}, `{c['method']}`: {interval(c['net'])} {verdict(c['net'])}; "
                    f"{interval(c['samples'])} times fewer samples, {cost(c)} as long.")
    if len(rows) == 1:
        rows.append("Every method gains on every scene measured here.")
    return "\n".join(rows) + "\n\n"


def cost(comparison):
    return "unknown" if not comparison["cost"][0] else f"each {1.0 / comparison['cost'][0]:.2g} times"


def decided(values, least):
    """Whether an interval lies above what is wanted."""
    if values[1] is None or values[2] is None or values[1] < least <= values[2]:
        return "not decided"
    return "reached" if values[1] >= least else "missed"


def goals(benches):
    rows = ["## Goals and what is reached\n", "| scene | light samples | goal | reason | measured | verdict |", "| --- | --- | --- | --- | --- | --- |"]
    for scene, light, figure, least, why in GOALS:
        found = [c for _, s, c in all_comparisons(benches) if c["scene"] == scene and light_samples(s) == light and c[figure][0]]
        if not found:
            rows.append(f"| {TITLES[scene]} | {light} | {least} | {why} | not measured | open |")
            continue
        best = max(found, key=lambda c: c[figure][0])
        word = decided(best[figure], least)
        what = "fewer samples" if figure == "samples" else "less time"
        rows.append(f"| {TITLES[scene]} | {light} | {least} times {what} | {why} | {interval(best[figure])} by `{best['method']}` | {word} |")
    for worst in sorted((c for _, s, c in all_comparisons(benches) if c["net"][0] and light_samples(s) == "on"), key=lambda c: c["net"][0])[:1]:
        word = decided(worst["net"], LEAST)
        rows.append(f"| every scene | on | {LEAST} times less time | guiding should cost at most a twentieth where it does not pay | {interval(worst['net'])} on "
                    f"{TITLES.get(worst['scene'], worst['scene'])} by `{worst['method']}` | {word} |")
    return "\n".join(rows) + "\n\n"


def differences(table, settings):
    """Settings of a published table that a bench does not share."""
    apart = [f"{name} {value}, here {settings.get(name) or 'none'}" for name, value in table["setting"].items() if settings.get(name) != value]
    return apart + ([f"at equal time on {table['hardware']}"] if table["equal"] == "time" else [])


def published_beside(benches, published):
    """Published factors beside the factors of benches without light samples, where the settings agree; else what does not."""
    text = "## Beside published figures\n\nAll are without light samples; none of these scenes has published figures with them.\n\n"
    for table in published["tables"]:
        names = list(table["methods"])[1:]
        rows = ["| scene | the same? | " + " | ".join(table["methods"][name] for name in names) + " | here |",
                "| --- " * (len(names) + 3) + "|"]
        apart = []
        for entry in table["scenes"]:
            for b, settings, c in all_comparisons(benches):
                if c["scene"] != entry["scene"] or settings["nee"] == "on":
                    continue
                errors = entry["errors"]
                if differences(table, settings):
                    apart.append(f"* {TITLES[c['scene']]}: other settings ({'; '.join(differences(table, settings))}), so its figures are not shown.")
                else:
                    factors = " | ".join(f"{errors['path'] / errors[name]:.3g}" for name in names)
                    rows.append(f"| {TITLES[c['scene']]} | {entry['same']} | {factors} | {interval(c['samples'])} by `{c['method']}` |")
        text += f"{table['source']}; {table['table']}. Factors over path tracing at equal {table['equal']}; {table['runs']}.\n\n"
        text += ("\n".join(rows) + "\n\n" if len(rows) > 2 else "") + ("\n".join(apart) + "\n\n" if apart else "")
    return text


def tables(benches):
    text = ""
    for light in ("off", "on"):
        rows = [row for b in benches for scene, s in b.settings.items() if light_samples(s) == light for row in scene_rows(b, scene)]
        if not rows:
            continue
        text += "\n".join([f"## Light samples {light}\n",
                           "| scene | method | samples per pixel | relMSE | trimmed | FLIP | fewer samples | time per sample | to the same error | trimmed |",
                           "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |", *rows]) + "\n\n"
    return text + ("Factors of samples, of time per sample and of time to the same error are over `default`. *Trimmed* is without the worst 0.1 % of the "
                   "pixels.\nThe last column has the factor of time by the trimmed error.\n\n" + "".join(f"* {n}\n" for n in NOTES) + "\n")


def scene_rows(bench, scene):
    rows = []
    for method in bench.results["plan"]["methods"]:
        cell = bench.cell(scene, method)
        per_sample = cell["seconds_per_sample"][0]
        row = [TITLES.get(scene, scene) if method == bench.base else "", f"`{method}`", f"{cell['seconds'][0] / per_sample:.3g}",
               interval(cell["relmse"]), interval(cell["relmse_trimmed"]), interval(cell["flip"])]
        gain = [c for c in bench.comparisons() if c["scene"] == scene and c["method"] == method]
        row += [interval(gain[0]["samples"]), f"{1.0 / gain[0]['cost'][0]:.2g}",
                f"{interval(gain[0]['net'])} {verdict(gain[0]['net'])}",
                interval(gain[0]["net_trimmed"])] if gain else ["", "", "", ""]
        rows.append("| " + " | ".join(row) + " |")
    return rows


def strips(benches):
    rows = ["## Pictures at the ends of runs\n", "From left to right: the methods in the order of the tables, and the reference; the first seed.\n"]
    for b in benches:
        for scene, settings in b.settings.items():
            picture = STRIPS / f"{scene}-{b.name}.png"
            if not picture.exists():
                continue
            numbers = ", ".join(f"`{m}` relMSE {b.cell(scene, m)['relmse'][0]:.3g}, FLIP {b.cell(scene, m)['flip'][0]:.2g}"
                                for m in b.results["plan"]["methods"] if b.cell(scene, m)["relmse"][0])
            title = f"{TITLES.get(scene, scene)}, light samples {light_samples(settings)}"
            rows.append(f'{title}: {numbers}\n\n<img src="images/literature/{picture.name}" width="768" alt="{title}">\n')
    return "\n".join(rows) + "\n"


def credits():
    return """## The scenes
Veach, Ajar and Veach, Bidir Room are by Benedikt Bitterli (CC0), after Eric Veach. The Breakfast Room, The Grey & White Room and The Wooden
Staircase are by Wig42 (CC-BY), Japanese Classroom by NovaZeeke (CC-BY), Contemporary Bathroom by Mareck (CC0), Spaceship by thecali (CC0). All
are in the conversions of [Bitterli's page](https://benedikt-bitterli.me/resources/). They are not part of this repository.
"""


def main():
    check = sys.argv[1:] == ["--check"]
    if not check:
        for folder in sys.argv[1:]:
            keep(Path(folder))
    benches = [Bench(path) for path in sorted(RAW.glob("*.json.xz"))]
    if not benches:
        sys.exit(__doc__)
    published = json.loads((RAW / "published.json").read_text())
    text = about(benches) + losses(benches) + goals(benches) + tables(benches) + published_beside(benches, published) + strips(benches) + credits()
    page = DOCS / "literature.md"
    if check:
        sys.exit(f"not what the raw results give: {page.name}" if page.read_text() != text else 0)
    page.write_text(text)


if __name__ == "__main__":
    main()
