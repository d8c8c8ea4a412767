#!/usr/bin/env python3
"""Displays that are hidden cost the renderer nothing: counted by valgrind's callgrind in the real viewer on SDL's dummy driver.

Usage: check_hidden_displays.py PROGRAM

The viewer renders and learns by a script with every display hidden: no instruction of their functions is executed, on any thread. A second
script shows them all: every one of the functions is executed, so that none is missed because it has another name now.
Exit code 77: there is no valgrind.
"""
import os
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from callgrind import count_instructions, require_valgrind, sum_by  # noqa: E402

# Functions without which a display cannot be: light, key frames, flowers, paths, discs and shapes.
DISPLAYS = ["pl::LightGatherer::trace", "pl::FieldKeyFrame::FieldKeyFrame", "pl::make_flowers", "pl::flower_mesh",
            "pl::trace_pixel", "pl::lines_of", "pl::draw_shapes", "pl::draw_disc", "pl::answer_paths"]
RENDERER = "pl::FilmRenderer::advance"

HIDDEN = """
0 tap 3
1 wait learned >= 3
2 quit
"""
SHOWN = """
0 tap 3
1 wait learned >= 2
2 tap Space
3 wait state == paused
4 aim 0.5 0.92
5 down left
6 up left
7 wait inspected == yes
8 aim_at 0.1 0.5 keep the past
9 down left
10 up left
11 tap U
12 tap J
13 aim 0.5 0.92
14 down left
15 up left
16 tap Space
17 wait key_frames >= 1
18 wait flowers >= 10
19 wait path_lines >= 1
20 aim_at 0.5 0.5 Volume
21 down left
22 up left
23 wait curve_points >= 1
24 quit
"""


def counts_of(program, script):
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "check.script"
        path.write_text(script)
        command = [program, "view", "cornell", "--backend", "cpu", "--threads", "1", "--size", "16x16", "--volumes", "64",
                   "--bins", "16", "--window", "1280x720", "--script", str(path)]
        return sum_by(count_instructions(command), 1)


def executed(counts, name):
    return sum(n for function, n in counts.items() if function.startswith(name + "(") or function == name)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    require_valgrind()
    os.environ["SDL_VIDEODRIVER"] = "dummy"
    hidden = counts_of(sys.argv[1], HIDDEN)
    shown = counts_of(sys.argv[1], SHOWN)
    failures = [f"{name}: {n} instructions while it is hidden"
                for name in DISPLAYS if (n := executed(hidden, name)) > 0]
    failures += [f"{name}: nothing is executed while it is shown: is that its name?"
                 for name in DISPLAYS if executed(shown, name) == 0]
    failures += [f"{RENDERER}: nothing is executed" for counts in (hidden, shown) if executed(counts, RENDERER) == 0]
    for name in DISPLAYS:
        print(f"{name}: hidden {executed(hidden, name)}, shown {executed(shown, name)}")
    sys.exit("FAILED\n" + "\n".join(failures) if failures else 0)


main()
