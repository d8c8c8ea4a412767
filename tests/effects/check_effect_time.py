#!/usr/bin/env python3
"""That effects which a scene lacks cost no time: the kernels of the whole program against those compiled for no effects.

Usage: check_effect_time.py PROGRAM PROGRAM_WITHOUT [PAIRS]

Both render the Cornell box with every method, one thread, and the same bits. A pair is a fresh process of each kind. They render
many pictures, each in other memory, and take turns pass by pass, all in random order: who follows whom changes what is in the caches.
All stay on one processor, because the processors of a shared machine are not equally fast, and each changes its speed from moment to moment: a
pass takes 3.1 or 4.1 ms, now here, now there. What counts is the ratio of the processor times of their median passes, its mean over
the middle half of the pictures: the others met such a change. Beside each pair runs a second process of PROGRAM, and one with the
kernel that can do every effect:
  floor     the same program twice. If the 95 % interval of this ratio is not within [0.99, 1.01], the machine is too noisy to tell:
            exit code 77, which is a skip and no pass. The same if half of this interval or of the next is more than 0.4 % even after
            three times as many pairs; how many there are hangs on the width alone, not on where the intervals lie.
  claim     PROGRAM over PROGRAM_WITHOUT: the interval has to be within [0.99, 1.01] (two one-sided tests of 2.5 % each).
  control   the kernel for everything over PROGRAM: the interval must not be within [0.99, 1.01], or this test could not fail.
At that width a cost of 1.2 % passes, and one of 0 % fails, in about one run of a thousand for each method.
"""
import math
import os
import random
import statistics
import subprocess
import sys

METHODS = ["default", "precomputed", "reinforcement"]
PICTURES = 24  # of each process in a pair
PASSES = 5  # of each picture; the first one does not count
LIMIT = 0.01
WIDEST = 0.004  # half of an interval
MOST_ROUNDS = 3  # of as many pairs


class Runner:
    """A process that renders a pass when asked to."""

    def __init__(self, command):
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1,
                                        env=os.environ | {"GLIBC_TUNABLES": "glibc.malloc.hugetlb=1"})
        self.seconds = []

    def ask(self, what="pass"):
        self.process.stdin.write(what + "\n")
        self.process.stdin.flush()
        answer = self.process.stdout.readline()
        if not answer:
            sys.exit(f"FAILED: {self.process.args} ended with {self.process.wait()}")
        return float(answer)

    def end(self):
        picture = self.process.communicate()[0].strip()
        if self.process.returncode != 0:
            sys.exit(f"FAILED: {self.process.args} ended with {self.process.returncode}")
        return picture


def measure(commands, turns):
    """For every command the logarithms of the processor seconds of the median pass of each picture; `turns` draws the order."""
    started = {place: Runner(commands[place]) for place in turns.sample(range(len(commands)), len(commands))}
    runners = [started[place] for place in range(len(commands))]
    for _ in range(PICTURES):
        for runner in turns.sample(runners, len(runners)):
            runner.ask("anew")
            runner.seconds.append([])
        for _ in range(1, PASSES):
            for runner in turns.sample(runners, len(runners)):
                runner.seconds[-1].append(runner.ask())
    pictures = {runner.end() for runner in runners}
    if len(pictures) != 1:
        sys.exit(f"FAILED: expected the same bits of all kernels, got {len(pictures)} checksums")
    return [[math.log(statistics.median(seconds)) for seconds in runner.seconds] for runner in runners]


def middle_mean(values):
    """Of the middle half."""
    quarter = len(values) // 4
    return statistics.mean(sorted(values)[quarter:len(values) - quarter])


def log_ratios(measured, above, below):
    """One for each pair, from its pictures."""
    return [middle_mean([a - b for a, b in zip(logs[above], logs[below])]) for logs in measured]


def interval(logs):
    """95 % interval of the ratio: of the geometric mean."""
    mean = statistics.mean(logs)
    student = 1.96 + 2.37 / (len(logs) - 1)  # the first two terms of its expansion: off by 0.002 for 30 pairs
    half = student * statistics.stdev(logs) / math.sqrt(len(logs))
    return math.exp(mean - half), math.exp(mean + half)


def within(bounds):
    return 1.0 - LIMIT <= bounds[0] and bounds[1] <= 1.0 + LIMIT


def is_wide(bounds):
    return bounds[1] - bounds[0] > 2.0 * WIDEST


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    program, without = sys.argv[1:3]
    pairs = int(sys.argv[3]) if len(sys.argv) == 4 else 30
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    failures, noisy = [], []
    turns = random.Random(1)
    for method in METHODS:
        commands = [[program, method], [without, method], [program, method], [program, method, "forced"]]
        measured = []
        for _ in range(MOST_ROUNDS):
            measured += [measure(commands, turns) for _ in range(pairs)]
            floor, claim, control = (interval(log_ratios(measured, *pair)) for pair in ((2, 0), (0, 1), (3, 0)))
            if not is_wide(floor) and not is_wide(claim):
                break
        for what, (low, high) in (("floor", floor), ("claim", claim), ("control", control)):
            print(f"{method}: {what} [{low:.4f}, {high:.4f}] of {len(measured)} pairs", flush=True)
        if not within(floor) or is_wide(floor) or is_wide(claim):
            noisy.append(method)
        elif not within(claim):
            failures.append(f"{method}: expected a ratio within {LIMIT:.0%} of 1, got [{claim[0]:.4f}, {claim[1]:.4f}]")
        elif within(control):
            failures.append(f"{method}: the kernel for everything seems to cost nothing, so this test tells nothing")
    if failures:
        sys.exit("FAILED:\n" + "\n".join(failures))
    if noisy:
        print(f"skipped: the machine is too noisy to tell for {', '.join(noisy)}")
        sys.exit(77)


if __name__ == "__main__":
    main()
