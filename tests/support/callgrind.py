"""Instructions that a program executes, counted by valgrind's callgrind."""
import re
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path


def require_valgrind():
    """Ends the program with 77, "skipped", where there is no valgrind."""
    if not shutil.which("valgrind"):
        print("skipped: there is no valgrind")
        sys.exit(77)


def count_instructions(command, text=""):
    """By (file of source, function) the instructions that were executed there, without the instructions of functions called from there. Files
    are known where the program has line numbers. `text` is the program's input."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "callgrind.out"
        done = subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}", *command],
                              input=text, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"FAILED: {' '.join(command)}\n{done.stderr}")
        return parse(out.read_text())


def sum_by(counts, part):
    """Sums over the files (part 0) or the functions (part 1) of count_instructions()."""
    sums = Counter()
    for key, count in counts.items():
        sums[key[part]] += count
    return sums


def parse(profile):
    """Names stand at their first mention, and numbers for them afterwards; a line behind 'calls=' tells what a called function spent."""
    files, functions, counts = {}, {}, Counter()
    file, function, is_call = "", "", False
    for line in profile.splitlines():
        named = re.match(r"(fl|fi|fe|cfi|cfl|fn|cfn)=\((\d+)\)(?: (.*))?$", line)
        if named:
            kind, number, name = named.groups()
            names = functions if kind in ("fn", "cfn") else files
            if name:
                names[number] = re.sub(r"'\d+$", "", name)  # behind functions: depths of recursion
            if kind == "fn":
                function = names.get(number, "")
            elif kind in ("fl", "fi", "fe"):
                file = names.get(number, "")
        elif line.startswith("calls="):
            is_call = True
        elif re.match(r"[+\-*\d]", line):
            if not is_call:
                counts[file, function] += int(line.split()[1])
            is_call = False
    return counts
