#!/usr/bin/env python3
"""That effects which a scene lacks cost no time: the kernels of the whole program against those compiled for no effects.

Usage: check_effect_time.py PROGRAM PROGRAM_WITHOUT [PAIRS]

Both render the Cornell box with every method, one thread, and the same bits. A pair is a fresh process of each kind. They render
several pictures, each in other memory, and take turns pass by pass; what counts is the ratio of the processor times of their median
passes, averaged over the pictures. Beside each pair runs a second process of PROGRAM, and one with the kernel that can do every effect:
  floor     the same program twice. If the 95 % interval of this ratio is not within [0.99, 1.01], or half of it is more than 0.4 %,
            the machine is too noisy to tell: exit code 77, which is a skip and no pass.
  claim     PROGRAM over PROGRAM_WITHOUT: the interval has to be within [0.99, 1.01] (two one-sided tests of 2.5 % each).
  control   the kernel for everything over PROGRAM: the interval must not be within [0.99, 1.01], or this test could not fail.
At that width a cost of 1.2 % passes, and one of 0 % fails, in about one run of a thousand for each method.
"""
import math
import statistics
import subprocess
import sys

METHODS = ["default", "precomputed", "reinforcement"]
PICTURES = 8  # of each process in a pair
PASSES = 9  # of each picture; the first one does not count
LIMIT = 0.01
WIDEST = 0.004  # half of an interval
STUDENT_975 = {29: 2.045}  # by degrees of freedom; fewer pairs are for trying out and take the normal quantile


class Runner:
    """A process that renders a pass when asked to."""

    def __init__(self, command):
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1)
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


def measure(commands, turn):
    """For every command the logarithms of the processor seconds of the median pass of each picture, all in turns; `turn` says who
    begins."""
    runners = [Runner(command) for command in commands]
    for picture in range(PICTURES):
        for runner in runners:
            runner.ask("anew")
            runner.seconds.append([])
        for i in range(1, PASSES):
            for k in range(len(runners)):
                runner = runners[(k + i + picture + turn) % len(runners)]
                runner.seconds[-1].append(runner.ask())
    pictures = {runner.end() for runner in runners}
    if len(pictures) != 1:
        sys.exit(f"FAILED: expected the same bits of all kernels, got {len(pictures)} checksums")
    return [[math.log(statistics.median(seconds)) for seconds in runner.seconds] for runner in runners]


def log_ratios(measured, above, below):
    """One for each pair: the mean over its pictures."""
    return [statistics.mean(a - b for a, b in zip(logs[above], logs[below])) for logs in measured]


def interval(logs):
    """95 % interval of the ratio: of the geometric mean."""
    mean = statistics.mean(logs)
    half = STUDENT_975.get(len(logs) - 1, 1.96) * statistics.stdev(logs) / math.sqrt(len(logs))
    return math.exp(mean - half), math.exp(mean + half)


def within(bounds):
    return 1.0 - LIMIT <= bounds[0] and bounds[1] <= 1.0 + LIMIT


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    program, without = sys.argv[1:3]
    pairs = int(sys.argv[3]) if len(sys.argv) == 4 else 30
    failures, noisy = [], []
    for method in METHODS:
        commands = [[program, method], [without, method], [program, method], [program, method, "forced"]]
        measured = [measure(commands, pair) for pair in range(pairs)]
        floor = interval(log_ratios(measured, 2, 0))
        claim = interval(log_ratios(measured, 0, 1))
        control = interval(log_ratios(measured, 3, 0))
        for what, (low, high) in (("floor", floor), ("claim", claim), ("control", control)):
            print(f"{method}: {what} [{low:.4f}, {high:.4f}]", flush=True)
        if not within(floor) or floor[1] - floor[0] > 2.0 * WIDEST:
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
