#!/usr/bin/env python3
"""That learning gains what docs/learning.md says, at equal samples and at equal time.

Usage: check_gains.py GAIN_BENCH [KEY=NUMBER ...]; the keys are those of gain_bench.

Every scene has a least gain for each: the goal that was set where it is reached, else three quarters of what was measured. On easy
scenes learning must not be noticeably worse than default path tracing: a tenth at equal samples, a quarter at equal time. Half of the
gain on the door has to be there after 16 of 128 passes. Time is processor time; where other work takes more than a quarter of a
processor, it meets the methods unevenly: exit code 77, a skip and no pass.
"""
import re
import subprocess
import sys

MOST_FOREIGN = 0.25  # processors

# Least gains of reinforcement at equal samples and at equal time, and of precomputed. The pictures are always the same, times are not.
HARD = {
    "door": ((8.0, 2.4), (3.6, 1.2)),
    "shelter": ((3.0, 2.0), (3.0, 1.2)),
    "indirect": ((4.0, 2.5), (4.0, 1.4)),
    "pillars": ((5.0, 2.3), (2.8, 1.2)),
    "cornell": ((4.0, 2.0), (4.0, 2.0)),
    "labyrinth": ((60.0, 12.0), (4.0, 0.6)),
    "staircase": ((55.0, 12.0), (8.0, 2.5)),
    "thin-wall": ((10.0, 2.5), (4.5, 1.0)),
    "boxed-lights": ((5.0, 1.9), (1.9, 0.6)),
    "two-lights": ((2.4, 0.8), (1.9, 0.7)),
}
NOT_WORSE = (1 / 1.1, 1 / 1.25)
LEAST = HARD | {scene: (NOT_WORSE, NOT_WORSE) for scene in ("open-box", "ceiling", "sky")}
EARLY = ["door", "seeds=9", "reference=256", "threads=1"]
ROW = re.compile(r"(?P<scene>\S+) +(?P<method>precomputed|reinforcement) +\S+ +(?P<samples>\S+) +\S+ +\S+ +(?P<time>\S+) ")


def rows_of(program, arguments):
    """What the bench prints, and its rows of guided methods."""
    output = subprocess.run([program, *arguments], check=True, capture_output=True, text=True).stdout
    print(output)
    return output, [match.groupdict() for match in map(ROW.match, output.splitlines()) if match]


def early_share(program):
    """How much of the gain of reinforcement after 128 passes of the door is there after 16."""

    def gain_after(passes):
        rows = rows_of(program, [*EARLY, f"spp={passes}"])[1]
        return next(float(row["samples"]) for row in rows if row["method"] == "reinforcement")

    return gain_after(16) / gain_after(128)


def main():
    keys = sys.argv[2:] or ["seeds=3", "reference=128", "threads=1"]
    output, rows = rows_of(sys.argv[1], [*LEAST, *keys])
    if len(rows) != 2 * len(LEAST):
        sys.exit(f"FAILED: expected {2 * len(LEAST)} rows of guided methods, got {len(rows)}")
    failures = []
    share = early_share(sys.argv[1])
    if not share >= 0.5:
        failures.append(("samples", f"door: expected half of the gain within 16 passes, got {share:.3f} of it"))
    for row in rows:
        least = LEAST[row["scene"]][0 if row["method"] == "reinforcement" else 1]
        for what, limit in zip(("samples", "time"), least):
            if not float(row[what]) >= limit:
                failures.append((what, f"{row['scene']}, {row['method']}: expected a gain of at least {limit:.3g} "
                                       f"at equal {what}, got {row[what]}"))
    foreign = float(re.search(r"own, (\S+) others", output)[1])
    if foreign > MOST_FOREIGN and all(what == "time" for what, _ in failures):
        print(f"other work took {foreign} processors: times say nothing")
        sys.exit(77)
    for _, failure in failures:
        print(f"FAILED: {failure}")
    sys.exit(1 if failures else 0)


main()
