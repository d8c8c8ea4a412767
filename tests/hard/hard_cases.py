#!/usr/bin/env python3
"""The table of hard cases, docs/hard-cases.md, made of tests/hard/catalogue.txt, the tests' sources and their measurements.

hard_cases.py --check            fails if a case is missing, names a test that does not exist, or the table is another one
hard_cases.py --write [BUILD]..  writes the table; margins and seconds are from BUILD/margins, or else from the table
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
CATALOGUE = ROOT / "tests/hard/catalogue.txt"
TABLE = ROOT / "docs/hard-cases.md"
# Every case that has to be there.
LAST = {"G": 17, "O": 13, "P": 19, "Q": 21, "K": 10, "L": 17, "M": 17, "C": 10, "A": 14, "F": 24, "X": 13, "N": 6, "R": 23}
TIERS = ["push", "merge", "nightly"]

HEAD = """# Hard cases

`tests/hard/hard_cases.py --write BUILD` makes this page from [tests/hard/catalogue.txt](../tests/hard/catalogue.txt); a test fails if a case is
missing.

* *Used* is the largest share of a tolerance that the tests of a case used. For a bound, this is the share of the limit. For a rule that
  compares means, densities or pictures, 100 % is a false alarm of one in a million, above which the test fails.
* *exact* means no tolerance: bits, counts, words.
* *Seconds* is the time of one run of all tests of a case on a busy machine; the field is empty if no run was kept.

The rules S1 to S3 ([rules.h](../tests/support/statistics/rules.h)) check their own power: a test that could not have detected the difference
fails. `./run test` runs the tier push, after which `tests/hard/hard_cases.py --write build/release` updates the numbers; `./run test merge`
and `./run test nightly` also run the larger tiers.
"""


def known_tests():
    """Tier of every test by its name."""
    tests = {}
    for path in sorted((ROOT / "tests").rglob("*.cpp")):
        for name, tags in re.findall(r'TEST_CASE\(\s*"((?:[^"\\]|\\.)*)"(?:\s*,\s*"([^"]*)")?', path.read_text()):
            tier = next((t for t in ("nightly", "merge") if f"[{t}]" in tags or f"[.{t}]" in tags), "push")
            tests[name] = ("by hand" if "[.]" in tags else tier, "[hard]" in tags)
    for path in sorted((ROOT / "tests").rglob("CMakeLists.txt")):
        text = path.read_text()
        for name in re.findall(r'add_test\(NAME "([^"$]+)"', text):
            tests[name] = ("nightly" if name.startswith("fuzz.") else "push", False)
        for name, tier in re.findall(r"pl_add_mutant\((\w+) (\w+)", text):
            tests["mutants." + name] = (tier, False)
    return tests


def catalogue():
    """(heading, id, case, criterion, tests) for every case."""
    rows = []
    heading = ""
    for line in CATALOGUE.read_text().splitlines():
        if line.startswith("## "):
            heading = line[3:]
        elif line and not line.startswith("#"):
            id_, case, criterion, tests = (part.strip() for part in line.split("|"))
            rows.append((heading, id_, case, criterion, tests))
    return rows


def complaints(rows, tests):
    found = []
    ids = [row[1] for row in rows]
    found += [f"case {g}{i} is not in the catalogue" for g, n in LAST.items() for i in range(1, n + 1) if f"{g}{i}" not in ids]
    found += [f"case {i} is there twice" for i in sorted({i for i in ids if ids.count(i) > 1})]
    named = set()
    for _, id_, _, _, names in rows:
        if names.startswith("-"):
            continue
        for name in names.split(";;"):
            named.add(name.strip())
            if name.strip() not in tests:
                found.append(f"case {id_} names a test that does not exist: {name.strip()}")
    found += [f"no case names the test: {name}" for name, (_, hard) in tests.items() if hard and name not in named]
    return found


def measured(builds):
    """(seconds, share of the tolerance or None) of every test that was run."""
    results = {}
    for build in builds:
        for path in pathlib.Path(build).glob("margins/*/*"):
            lines = path.read_text().splitlines()
            if len(lines) < 2:
                continue
            seconds, share, _, failed = lines[1].split()
            if int(failed) == 0:
                results[lines[0].split(".", 1)[1]] = (float(seconds), None if float(share) < 0 else float(share))
    return results


def old_numbers():
    """Used and seconds of every case as the table has them."""
    if not TABLE.exists():
        return {}
    lines = (line for line in TABLE.read_text().splitlines() if re.match(r"\| [A-Z]\d+ \|", line))
    rows = ([cell.strip() for cell in line.strip("|").split("|")] for line in lines)
    return {row[0]: (row[3], row[4]) for row in rows}


def table(rows, tests, results, numbers):
    lines = [HEAD.rstrip()]
    heading = None
    for group, id_, case, criterion, names in rows:
        if group != heading:
            lines += ["", f"## {group}", "| | case | criterion | used | seconds | tier | tests |", "| --- | --- | --- | ---: | ---: | --- | --- |"]
            heading = group
        if names.startswith("-"):
            lines.append(f"| {id_} | {case} | {criterion} | | | | {names[1:].strip()} |")
            continue
        names = [name.strip() for name in names.split(";;")]
        tiers = " ".join(t for t in TIERS if any(tests.get(n, ("", 0))[0] == t for n in names))
        used, seconds = numbers.get(id_, ("", ""))
        have = [results[n] for n in names if n in results]
        if have:
            shares = [share for _, share in have if share is not None]
            used = f"{100 * max(shares):.0f} %" if shares and max(shares) > 0 else "exact"
            seconds = f"{sum(s for s, _ in have):.1f}"
        lines.append(f"| {id_} | {case} | {criterion} | {used} | {seconds} | {tiers} | {'<br>'.join(names)} |")
    return "\n".join(lines) + "\n"


def main():
    if len(sys.argv) < 2 or sys.argv[1] not in ("--check", "--write"):
        sys.exit(__doc__)
    tests = known_tests()
    rows = catalogue()
    found = complaints(rows, tests)
    text = table(rows, tests, measured(sys.argv[2:]) if sys.argv[1] == "--write" else {}, old_numbers())
    if sys.argv[1] == "--write":
        TABLE.write_text(text)
    elif not TABLE.exists() or TABLE.read_text() != text:
        found.append("docs/hard-cases.md is not what tests/hard/hard_cases.py --write makes of the catalogue and the tests")
    for complaint in found:
        print(complaint)
    sys.exit(1 if found else 0)


main()
