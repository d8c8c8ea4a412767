#!/usr/bin/env python3
"""That effects which a scene lacks cost no time: the kernels of the whole program against those compiled for no effects.

Usage: check_effect_time.py PROGRAM PROGRAM_WITHOUT [PAIRS]

Both render the Cornell box with every method, one thread, and the same bits. A pair is a fresh process of each kind, which take
turns pass by pass; what counts is the ratio of the processor times of their median passes. Beside each pair runs a second process of PROGRAM, and one
with the kernel that can do every effect:
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
PASSES = 32  # of each process in a pair, after one that does not count
LIMIT = 0.01
WIDEST = 0.004  # half of an interval
STUDENT_975 = {29: 2.045}  # by degrees of freedom; fewer pairs are for trying out and take the normal quantile


class Runner:
    """A process that renders a pass when asked to."""

    def __init__(self, command):
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1)
        self.seconds = []

    def ask(self):
        self.process.stdin.write("pass\n")
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
    """Processor seconds of the median pass of every command, all in turns; `turn` says who begins."""
    runners = [Runner(command) for command in commands]
    for runner in runners:
        runner.ask()
    for i in range(PASSES):
        for k in range(len(runners)):
            runner = runners[(k + i + turn) % len(runners)]
            runner.seconds.append(runner.ask())
    pictures = {runner.end() for runner in runners}
    if len(pictures) != 1:
        sys.exit(f"FAILED: expected the same bits of all kernels, got {len(pictures)} pictures")
    return [statistics.median(runner.seconds) for runner in runners]


def interval(ratios):
    """95 % interval of the geometric mean."""
    logs = [math.log(ratio) for ratio in ratios]
    mean = sum(logs) / len(logs)
    variance = sum((x - mean) ** 2 for x in logs) / (len(logs) - 1)
    half = STUDENT_975.get(len(logs) - 1, 1.96) * math.sqrt(variance / len(logs))
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
        seconds = [measure(commands, pair) for pair in range(pairs)]
        floor = interval([s[2] / s[0] for s in seconds])
        claim = interval([s[0] / s[1] for s in seconds])
        control = interval([s[3] / s[0] for s in seconds])
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
