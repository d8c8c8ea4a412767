#!/usr/bin/env python3
"""That the model of docs/scaling.md predicts messages and bytes of jobs of 1, 2, 4 and 8 ranks, as --stats counts them.

Usage: check_scaling.py PROGRAM MPIRUN

Its inputs are the --stats of one process. A prediction is a pair of bounds: exact but for pixels that move by the times of
shares, of which the model knows the most, and for lists of training samples, known to a factor (FACTOR_OF_SAMPLES). The scene's
own messages are the messages of a job of one pass and two ranks without its prediction.
"""
import json
import os
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "docs"))
import scaling_model  # noqa: E402

RANKS = (1, 2, 4, 8)
BASE = ("--size", "24x20", "--spp", "1", "--method", "default")
RUNS = {
    "no learning": ("--size", "24x20", "--spp", "40", "--method", "default"),
    # Every cell gets samples: sums of whole arrays. Times decide about shares from the 4th pass on, so bounds are close.
    "dense sums": ("--size", "96x80", "--spp", "3", "--method", "reinforcement", "--volumes", "40", "--bins", "16"),
    # Fewer samples than cells: lists.
    "sparse sums": ("--size", "24x20", "--spp", "12", "--method", "reinforcement", "--volumes", "400", "--bins", "256"),
}


class Jobs:
    def __init__(self, program, mpirun, folder):
        self.program, self.mpirun, self.folder = program, mpirun, folder

    def stats(self, ranks, arguments):
        path = os.path.join(self.folder, "stats.json")
        start = ["--oversubscribe", "--bind-to", "none", "-n", str(ranks)]
        render = [self.program, "render", "cornell", "--nee", "off", "-t", "1", "--stats", path,
                  "-o", os.path.join(self.folder, "a.pfm")]
        allowed = {f"{name}_ALLOW_RUN_AS_ROOT{more}": "1" for name in ("OMPI", "PRTE") for more in ("", "_CONFIRM")}
        subprocess.run([self.mpirun, *start, *render, *arguments], check=True, timeout=120, stdout=subprocess.DEVNULL,
                       env={**os.environ, **allowed})
        with open(path, encoding="utf-8") as file:
            return json.load(file)


def main():
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        jobs = Jobs(sys.argv[1], sys.argv[2], folder)
        base = jobs.stats(2, BASE)
        known = scaling_model.Run(base).traffic(2)
        scene = {"messages": base["messages"] - known.messages[0], "bytes_sent": base["bytes_sent"] - known.bytes[0]}
        for name, arguments in RUNS.items():
            run = scaling_model.Run(jobs.stats(1, arguments))
            for ranks in RANKS:
                stats = jobs.stats(ranks, arguments)
                traffic = run.traffic(ranks)
                for key, bounds in (("messages", traffic.messages), ("bytes_sent", traffic.bytes)):
                    # A job of one rank has no driver.
                    low, high = (scene[key] + bound if ranks > 1 else 0 for bound in bounds)
                    got = stats.get(key, 0)
                    fits = low <= got <= high
                    failures += 0 if fits else 1
                    verdict = "" if fits else "WRONG, "
                    print(f"{name}, {ranks} ranks, {key}: {verdict}expected {low:.0f} to {high:.0f}, got {got}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
