#!/usr/bin/env python3
"""That effects which a scene lacks cost no instruction: passes of the whole program against those compiled for no effects.

Usage: check_effect_instructions.py PROGRAM PROGRAM_WITHOUT

Both render passes of the Cornell box by every method under valgrind's callgrind, which counts instructions by function.
  exact    every function of pathlight that does a thousandth of the work or more executes as many in both.
  total    of all functions of pathlight, those that render and those that prepare, within a ten-thousandth. Which small ones become
           part of others is up to the compiler, and looking through a table of kernels takes longer if there are more.
  control  the kernel that can do every effect executes more, or this test would see nothing.
Exit code 77: there is no valgrind.
"""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from callgrind import count_instructions, require_valgrind, sum_by

METHODS = ["default", "precomputed", "reinforcement"]
PASSES = 3
LEAST_SHARE = 1e-3
LARGEST_DIFFERENCE = 1e-4


def instructions_by_function(command):
    return sum_by(count_instructions(command, "pass\n" * PASSES), 1)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    require_valgrind()
    program, without = sys.argv[1:]
    failures = []
    for method in METHODS:
        able, unable, forced = (
            {name: count for name, count in instructions_by_function(command).items() if "pl::" in name}
            for command in ([program, method], [without, method], [program, method, "forced"]))
        total = sum(unable.values())
        difference = (sum(able.values()) - total) / total
        extra = (sum(forced.values()) - total) / total
        working = [name for name in able | unable
                   if max(able.get(name, 0), unable.get(name, 0)) >= LEAST_SHARE * total]
        print(f"{method}: {total} instructions, {difference:+.1e} with effects, {extra:+.1e} with the kernel for every effect, "
              f"{len(working)} functions compared", flush=True)
        for name in working:
            got, expected = able.get(name, 0), unable.get(name, 0)
            if got != expected:
                failures.append(f"{method}: {name}: expected {expected} instructions, got {got} with effects")
        if abs(difference) > LARGEST_DIFFERENCE:
            failures.append(f"{method}: expected {total} instructions within {LARGEST_DIFFERENCE}, got {difference:+.1e} with effects")
        if extra < 100 * LARGEST_DIFFERENCE:
            failures.append(f"{method}: the kernel for every effect seems to cost nothing, so this test tells nothing")
    if failures:
        sys.exit("FAILED:\n" + "\n".join(failures))


if __name__ == "__main__":
    main()
