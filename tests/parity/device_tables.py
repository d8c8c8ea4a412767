#!/usr/bin/env python3
"""Turns the results of run_on_device.sh into the tables of README.md and docs/cuda.md, as Markdown on standard output.

Usage: device_tables.py RESULTS [SECTION...]   RESULTS is a folder with stage-a.log, stage-b.log, stage-c.log, as many as there are;
sections: steps, parity, goals, speed, ratios, launches, parts, kernels, profile, ceilings, switches,
variants; default: all.

A figure is printed only if a record of the results holds it or the records that it is computed from; else "not measured".
Exit code: 0 printed, 2 usage, 3 no results or a line that is no record.
"""
import csv
import re
import statistics
import sys
from pathlib import Path

MISSING = "not measured"


class BadResults(Exception):
    """Results that cannot be read; the message says where."""


class Results:
    """The records of all stages, each a dict of its fields, with "kind", "stage" and the "step" that printed it."""

    def __init__(self, folder):
        logs = sorted(Path(folder).glob("stage-?.log"))
        if not logs:
            raise BadResults(f"{folder}: expected stage-a.log, stage-b.log or stage-c.log, got none")
        self.records = []
        self.profiles = {}
        for log in logs:
            self._read(log)

    def _read(self, log):
        stage = log.stem[-1]
        step = ""
        for number, line in enumerate(log.read_text(errors="replace").splitlines(), 1):
            if not line.startswith("@"):
                if step.startswith(("profile-", "ceilings")) and line.startswith('"'):
                    self.profiles.setdefault(step, []).append(line)
                continue
            kind, *fields = line[1:].split("\t")
            if any("=" not in field for field in fields):
                raise BadResults(f"{log}:{number}: expected key=value fields after tabs, got '{line}'")
            record = dict(field.split("=", 1) for field in fields)
            if kind == "begin":
                step = record["step"]
            self.records.append({"kind": kind, "stage": stage, **{"step": step, **record}})

    def all(self, kind, **fields):
        """Records of a kind whose fields have these values."""
        return [r for r in self.records
                if r["kind"] == kind and all(r.get(key) == value for key, value in fields.items())]

    def bench(self, **fields):
        """The row of the benchmark with these fields, of the longest run: stage b before c before a; None without one."""
        rows = [r for r in self.all("bench", **fields) if not r["step"].startswith("variant-")]
        return max(rows, key=lambda r: "acb".index(r["stage"]), default=None)


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + " --- |" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows])


def number(record, field, scale=1.0, digits=2):
    """A field of a record times a scale, as text."""
    return MISSING if record is None or field not in record else f"{float(record[field]) * scale:.{digits}f}"


def ratio(a, b, field):
    """field of a / field of b, as text."""
    if a is None or b is None or float(b[field]) == 0.0:
        return MISSING
    return f"{float(a[field]) / float(b[field]):.2f}"


def method_name(record):
    return record["method"] + (", light samples" if record["nee"] == "on" else "")


def heading(results):
    lines = []
    for run in results.all("run"):
        name = run["gpu"].strip() or "no GPU"
        lines.append(f"* Stage {run['stage']}: {name}, {run['date']}, {run['kit'].strip() or 'no kit'}")
    if any(run["rehearsal"] == "yes" for run in results.all("run")):
        lines.insert(0, "**A rehearsal by the host stand-in: no figure here is one of a GPU.**\n")
    return "\n".join(lines)


def steps(results):
    rows = [(r["stage"], r["step"], r["status"], r["seconds"], r["note"]) for r in results.all("step")]
    bad = [row for row in rows if row[2] != "ok"]
    return f"{len(rows)} steps, {len(bad)} not ok.\n\n" + table(("stage", "step", "status", "seconds", "note"), bad or rows)


def parity(results):
    lines = []
    for kind, what in (("compare", "scenes by methods by light samples"), ("random", "random settings")):
        cases = results.all(kind)
        differing = [r for r in cases if r["result"] != "equal"]
        lines.append(f"{what}: {len(cases)} cases, {len(differing)} differ." if cases else f"{what}: {MISSING}.")
        if differing:
            lines.append(table(
                ("case", "film: share", "largest", "tables: share", "largest", "counters", "settings"),
                [(r["case"], r["film_share"], r["film_largest"], r["table_share"], r["table_largest"], r["counters"],
                  r["settings"]) for r in differing]))
    return "\n\n".join(lines)


def ball_rows(results):
    return [r for r in results.all("bench", row="method") if r["scene"].startswith("ball of ")]


def goals(results):
    """The goals of the back end, and what was measured."""
    at = {"scene": "cornell", "row": "method", "size": "1920x1080", "nee": "off"}
    plain = results.bench(**at, method="default")
    guided = results.bench(**at, method="precomputed")
    million = next((r for r in ball_rows(results) if r["method"] == "default" and r["nee"] == "off" and
                    int(r["scene"].split()[2]) >= 1000000), None)
    per_second = MISSING if plain is None else f"{1000.0 / float(plain['ms_per_pass']):.0f}"
    return table(("", "goal", "measured"), [
        ("Cornell box, `default`, 1920 x 1080", "4 G segments/s", number(plain, "segments_per_s", 1e-9)),
        ("a million triangles, `default`", "1 G segments/s", number(million, "segments_per_s", 1e-9)),
        ("guided over unguided, time per segment", "at most 1.4", ratio(plain, guided, "segments_per_s")),
        ("passes a second at 1920 x 1080", "60", per_second)])


def speed(results):
    rows = []
    for r in results.all("bench", row="method"):
        chosen = results.bench(**{key: r[key] for key in ("scene", "row", "size", "method", "nee")})
        if r is chosen:
            rows.append((r["scene"], r["size"], method_name(r), number(r, "ms_per_pass", digits=3),
                         number(r, "paths_per_s", 1e-6, 1), number(r, "segments_per_s", 1e-6, 1)))
    return table(("scene", "size", "method", "ms/pass", "Mpaths/s", "Msegments/s"), rows) if rows else MISSING


def ratios(results):
    tree, grid, linear = (results.bench(row=row) for row in ("tree", "grid", "linear"))
    return table(("lookup of a volume, time per segment", "ratio"), [
        ("tree / grid", ratio(grid, tree, "segments_per_s")),
        ("linear search / tree", ratio(tree, linear, "segments_per_s"))])


def launches(results):
    """Several samples per pixel in a launch, against one."""
    rows = results.all("bench", row="launch")
    one = {(r["step"], r["size"], r["method"]): r for r in rows if r["most_samples"] == "1"}
    cells = [(r["size"], method_name(r), r["most_samples"], number(r, "ms_per_pass", digits=3),
              ratio(r, one.get((r["step"], r["size"], r["method"])), "ms_per_pass"))
             for r in rows if not r["step"].startswith("variant-")]
    return table(("size", "method", "samples a launch at most", "ms/pass", "times one"), cells) if cells else MISSING


def parts(results):
    rows = []
    for passes in results.all("passes"):
        work = {r["work"]: r for r in results.all("work", case=passes["case"])}
        rows.append([passes["case"]] + [number(work.get(name), "ms_per_pass", digits=3)
                                        for name in ("trace", "learn", "publish", "copy", "other")] +
                    [number(passes, "host_ms_per_pass", digits=3)])
    head = ("case", "trace", "learn", "publish", "copy", "other kernels", "pass by the host's clock")
    return "Milliseconds per pass.\n\n" + table(head, rows) if rows else MISSING


def share_of_ceiling(results, kernel, ceiling):
    """Bytes moved over the bytes of a copy in the same time; for kernels that trace, issue slots for each segment."""
    seconds = float(kernel["ms"]) * 1e-3
    if seconds == 0.0 or ceiling is None:
        return MISSING
    if kernel["work"] != "copy" and int(kernel["bytes"]) > 0:
        return f"{100.0 * int(kernel['bytes']) / seconds / float(ceiling['bytes_per_s']):.0f} % of a copy"
    passes = next(iter(results.all("passes", case=kernel["case"])), None)
    if kernel["kernel"].startswith("trace_paths") and passes is not None:
        slots = seconds * float(ceiling["lane_instructions_per_s"]) / int(passes["segments"])
        return f"{slots:.0f} lane instructions a segment at most"
    return ""


def kernels(results):
    ceiling = next(iter(results.all("ceiling")), None)
    rows = [(k["case"], k["kernel"], k["count"], number(k, "ms", digits=3), share_of_ceiling(results, k, ceiling))
            for k in results.all("kernel")]
    if not rows:
        return MISSING
    text = (f"Ceilings: {number(ceiling, 'lane_instructions_per_s', 1e-12)} T lane instructions/s (nominal), "
            f"{number(ceiling, 'bytes_per_s', 1e-9, 0)} GB/s (a copy within the device, measured).\n\n")
    return text + table(("case", "kernel", "launches", "ms in all", "share of the ceiling"), rows)


def profile(results):
    """Counters of the profiler, whose output is CSV: one line per metric of the launch."""
    columns = {step: {row["Metric Name"]: f"{row['Metric Value']} {row['Metric Unit']}".strip()
                      for row in csv.DictReader(lines) if "Metric Name" in row}
               for step, lines in results.profiles.items() if step != "ceilings"}
    columns = {step: values for step, values in columns.items() if values}
    if not columns:
        return MISSING
    names = list(dict.fromkeys(name for values in columns.values() for name in values))
    return table(["counter"] + [step.removeprefix("profile-") for step in columns],
                 [[f"`{name}`"] + [values.get(name, MISSING) for values in columns.values()] for name in names])


def ceilings(results):
    """Shares of the ceilings as the profiler has them: for each kernel its longest launch."""
    launches = {}
    for row in csv.DictReader(results.profiles.get("ceilings", [])):
        launch = launches.setdefault(row["ID"], {"kernel": re.search(r"(\w+)[<(]", row["Kernel Name"] + "(")[1]})
        launch[row["Metric Name"]] = row["Metric Value"], row["Metric Unit"]
    names = ("gpu__time_duration.sum", "sm__throughput.avg.pct_of_peak_sustained_elapsed",
             "gpu__compute_memory_throughput.avg.pct_of_peak_sustained_elapsed")
    longest = {}
    for launch in launches.values():
        before = longest.setdefault(launch["kernel"], launch)
        if float(launch[names[0]][0].replace(",", "")) > float(before[names[0]][0].replace(",", "")):
            longest[launch["kernel"]] = launch
    rows = [[kernel] + [" ".join(launch.get(name, (MISSING, ""))).strip() for name in names]
            for kernel, launch in longest.items()]
    return table(("kernel", "time", "arithmetic, of the peak", "memory, of the peak"), rows) if rows else MISSING


def switches(results):
    times = [float(r["ms"]) for r in results.all("switch")]
    if not times:
        return MISSING
    return f"{len(times)} switches: median {statistics.median(times):.0f} ms, longest {max(times):.0f} ms."


def variants(results):
    def key(r):
        return r["scene"], r["size"], method_name(r)

    plain = {key(r): r for r in results.all("bench", step="variant-none-bench", row="method")}
    rows = []
    for r in results.all("bench", row="method"):
        name = r["step"].removeprefix("variant-").removesuffix("-bench")
        if r["step"].startswith("variant-") and name != "none":
            rows.append((name, *key(r), number(r, "ms_per_pass", digits=3), ratio(r, plain.get(key(r)), "ms_per_pass")))
    head = ("variant", "scene", "size", "method", "ms/pass", "times the default build")
    return table(head, rows) if rows else MISSING


SECTIONS = {f.__name__: f for f in (steps, parity, goals, speed, ratios, launches, parts, kernels, profile, ceilings,
                                    switches, variants)}


def main(arguments):
    wanted = arguments[1:] or list(SECTIONS)
    unknown = [name for name in wanted if name not in SECTIONS]
    if not arguments or unknown:
        print(__doc__, file=sys.stderr)
        return 2
    try:
        results = Results(arguments[0])
        print(heading(results))
        for name in wanted:
            print(f"\n## {name.capitalize()}\n\n{SECTIONS[name](results)}")
    except BadResults as error:
        print(f"device_tables.py: {error}", file=sys.stderr)
        return 3
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
