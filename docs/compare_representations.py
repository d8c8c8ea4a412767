#!/usr/bin/env python3
"""Prints the gains of the representations side by side, at equal memory, as a table for the notebook.

Usage: compare_representations.py PROGRAM BENCH [KEY=VALUE ...]
PROGRAM: pathlight. BENCH: gain_bench. Keys and their values:
scenes=door,cornell,indirect,thin-wall   memory=2,16 (MB, 1e6 bytes)   fields=table,lobes,sd-tree,neural
light=on,off   size=256   early=16   late=64 (samples)   seeds=2   reference=64 (samples a half)
Field and placement fill the memory: volumes for all but the SD-tree, whose nodes do with the usual 1000 volumes.
"""
import json
import os
import subprocess
import sys
import tempfile

FIELDS = ["table", "sd-tree", "lobes", "neural"]  # by the number that gain_bench calls them
DEFAULTS = {"scenes": "door,cornell,indirect,thin-wall", "memory": "2,16",
            "fields": "table,lobes,sd-tree,neural", "light": "off,on", "size": "256",
            "early": "16", "late": "64", "seeds": "2", "reference": "64"}


def parse(words):
    settings = dict(DEFAULTS)
    for word in words:
        key, _, value = word.partition("=")
        if key not in settings or not value:
            sys.exit(f"compare_representations.py: unexpected '{word}': keys are {', '.join(settings)}")
        settings[key] = value
    for field in settings["fields"].split(","):
        if field not in FIELDS:
            sys.exit(f"compare_representations.py: unknown field '{field}': expected {', '.join(FIELDS)}")
    return settings


def field_bytes(program, field, volumes, folder):
    """Bytes of placement and field, as --stats tells them."""
    path = os.path.join(folder, "stats.json")
    subprocess.run([program, "render", "cornell", "--method", "reinforcement", "--field", field, "--volumes", str(volumes),
                    "--spp", "1", "--size", "16x16", "--no-progress", "--stats", path, "-o", os.path.join(folder, "x.exr")],
                   check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    with open(path) as file:
        return json.load(file)["field"]["bytes"]


def volumes_within(program, field, megabytes, folder):
    """Number of volumes for the memory, by two sizes; 0, the usual number, for an SD-tree."""
    if field == "sd-tree":
        return 0
    few, many = (field_bytes(program, field, n, folder) for n in (100, 1100))
    of_volume = (many - few) / 1000
    return max(int((megabytes * 1e6 - (few - 100 * of_volume)) / of_volume), 1)


def measure(bench, scene, field, light, megabytes, volumes, settings, folder):
    path = os.path.join(folder, "gains.json")
    size = settings["size"]
    subprocess.run([bench, scene, f"field={FIELDS.index(field)}", f"nee={int(light == 'on')}", f"megabytes={megabytes}",
                    f"volumes={volumes}", f"seeds={settings['seeds']}", f"spp={settings['late']}",
                    f"short={settings['early']}", f"width={size}", f"height={size}", "threads=1", "seconds=0",
                    "precomputed=0", f"reference={settings['reference']}", f"json={path}"],
                   check=True, stdout=subprocess.DEVNULL)
    with open(path) as file:
        methods = json.load(file)["results"][0]["methods"]
    learning = next(m for m in methods if m["method"] == "reinforcement")
    return [row for row in learning["lengths"] if row["equal_samples"]["mse"][0] is not None]


def cell(row, kind):
    value, low, high = row[kind]["mse"]
    if low is None or high is None:
        return "-" if value is None else f"{value:.3g}"
    return f"{value:.3g} [{low:.3g}, {high:.3g}]"


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    program, bench = sys.argv[1:3]
    settings = parse(sys.argv[3:])
    print("| scene | light samples | MB | field | volumes | " +
          " | ".join(f"{settings[k]}: equal samples | time" for k in ("early", "late")) + " |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    with tempfile.TemporaryDirectory() as folder:
        for scene in settings["scenes"].split(","):
            for light in settings["light"].split(","):
                for megabytes in settings["memory"].split(","):
                    for field in settings["fields"].split(","):
                        volumes = volumes_within(program, field, float(megabytes), folder)
                        rows = measure(bench, scene, field, light, megabytes, volumes, settings, folder)
                        figures = " | ".join(f"{cell(row, 'equal_samples')} | {row['slowdown'][0]:.2f}" for row in rows)
                        print(f"| `{scene}` | {light} | {megabytes} | `{field}` | {volumes or 1000} | {figures} |", flush=True)


if __name__ == "__main__":
    main()
