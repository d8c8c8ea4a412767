#!/usr/bin/env python3
"""Predicts how a rendering scales over ranks: docs/scaling.md. Inputs are the --stats of a run of one process with one thread, and latency
and bandwidth of the network.

    scaling_model.py STATS.json [--size WxH] [--spp N] [--threads N] [--gigabits G --microseconds U] [--ranks N,N,...]
"""
import argparse
import json
import math

BYTES_OF_CELL = 12      # pending sum and count
BYTES_OF_VOLUME = 44    # pending sums of light samples, mixture and reach
BYTES_OF_PIXEL = 64     # of a film
BYTES_OF_COMMAND = 1024  # command and report
MESSAGES_OF_PASS = 2    # command, report
FEWEST_PATHS_BEFORE_UPDATE = 1024
MOST_PASSES_WITHOUT_UPDATE = 16
PIXELS_OF_SHARE = 1 << 16


def is_updated_after(passes):
    """core/session/update_schedule.h"""
    floor = 1 << (passes.bit_length() - 1)
    return passes % min(max(floor // 8, 1), MOST_PASSES_WITHOUT_UPDATE) == 0


def parts_of_first_pass(pixels, volumes):
    """Updates within the first pass of a learner."""
    end = 1 << (max(volumes, FEWEST_PATHS_BEFORE_UPDATE) - 1).bit_length()
    parts = 0
    while end < pixels:
        parts += 1
        end *= 2
    return parts


class Run:
    """The parts of the time of a run on one thread."""

    def __init__(self, stats, size=None, spp=None):
        """Of the run that was measured, or of a larger picture that takes as long per path and per update."""
        width, height = size or (stats["width"], stats["height"])
        self.pixels = width * height
        self.passes = spp or stats["spp"]
        paths = stats["width"] * stats["height"] * stats["spp"]
        self.paths_per_second = paths / stats["seconds"]["render"]
        self.render = self.pixels * self.passes / self.paths_per_second
        self.serial = sum(stats["seconds"][clock] for clock in ("load", "build", "upload", "place"))
        self.precompute = stats["seconds"]["precompute"]
        field = stats["field"] if stats["method"] == "reinforcement" else None
        self.volumes = field["volumes"] if field else 0
        self.update_bytes = self.volumes * (field["bins"] * BYTES_OF_CELL + BYTES_OF_VOLUME) if field else 0
        self.updates = self.count_updates(self.pixels, self.passes)
        measured = self.count_updates(stats["width"] * stats["height"], stats["spp"])
        self.learn = stats["seconds"]["learn"] * self.updates / max(measured, 1)

    def count_updates(self, pixels, passes):
        if self.volumes == 0:
            return 0
        return parts_of_first_pass(pixels, self.volumes) + sum(map(is_updated_after, range(1, passes + 1)))

    def seconds(self, ranks, threads, latency, bandwidth):
        """latency in seconds, bandwidth in bytes per second. Updates run on every rank, by all of its threads."""
        steps = math.ceil(math.log2(ranks)) if ranks > 1 else 0
        share = (ranks - 1) / ranks
        blocks = math.ceil(self.pixels / (PIXELS_OF_SHARE * ranks))
        of_pass = (MESSAGES_OF_PASS + blocks - 1) * steps * (latency + BYTES_OF_COMMAND / bandwidth)
        # Reduce-scatter and allgather [Rabenseifner 2004].
        of_update = 2 * steps * latency + 2 * share * self.update_bytes / bandwidth + MESSAGES_OF_PASS * steps * latency
        of_film = share * self.pixels * BYTES_OF_PIXEL / bandwidth + (ranks - 1) * latency if ranks > 1 else 0.0
        work = (self.render + self.precompute) / (ranks * threads) + self.learn / threads + self.serial
        return work + self.passes * of_pass + self.updates * of_update + of_film


def rows(run, threads, ranks, latency, bandwidth):
    one = run.seconds(1, threads, latency, bandwidth)
    for count in ranks:
        time = run.seconds(count, threads, latency, bandwidth)
        yield count, time, one / time, one / time / count


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("stats", help="--stats of pathlight render -t 1, one process")
    parser.add_argument("--size", type=lambda text: tuple(map(int, text.split("x"))), help="WxH of another picture")
    parser.add_argument("--spp", type=int, help="samples per pixel of another picture")
    parser.add_argument("--threads", type=int, default=16, help="of each rank")
    parser.add_argument("--gigabits", type=float, help="bandwidth of a rank, per second")
    parser.add_argument("--microseconds", type=float, help="latency of a message")
    parser.add_argument("--ranks", default="1,2,4,8,16,128,1024")
    options = parser.parse_args()
    with open(options.stats, encoding="utf-8") as file:
        run = Run(json.load(file), options.size, options.spp)
    networks = [(10.0, 20.0), (100.0, 3.0)]
    if options.gigabits:
        networks = [(options.gigabits, options.microseconds or 20.0)]
    ranks = [int(count) for count in options.ranks.split(",")]
    print(f"{run.passes} passes of {run.pixels} pixels, {run.updates} updates of {run.update_bytes / 1e6:.2f} MB, "
          f"{run.paths_per_second / 1e6:.2f} Mpaths/s and thread, {options.threads} threads a rank\n")
    for gigabits, microseconds in networks:
        print(f"| {gigabits:g} Gbit/s, {microseconds:g} us: ranks | seconds | speed-up | efficiency |\n| ---: | ---: | ---: | ---: |")
        for count, time, speedup, efficiency in rows(run, options.threads, ranks, microseconds * 1e-6, gigabits * 1e9 / 8):
            print(f"| {count} | {time:.3g} | {speedup:.1f} | {efficiency:.2f} |")
        print()


if __name__ == "__main__":
    main()
