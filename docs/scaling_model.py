#!/usr/bin/env python3
"""Predicts how a rendering scales over ranks: docs/scaling.md. Inputs are the --stats of a run of one process with one thread, and latency
and bandwidth of the network.

    scaling_model.py STATS.json [--size WxH] [--spp N] [--threads N] [--gigabits G --microseconds U] [--ranks N,N,...]
"""
import argparse
import json
import math

BYTES_OF_CELL = 12      # pending sum and count
BYTES_OF_VOLUME = 44    # pending sums of light samples, mixture and reach; 8 more for each cluster of lights
ARRAYS_OF_PENDING = 9
BYTES_OF_INDEX = 4      # of an entry in a list of sums that are not 0
VOLUME_ENTRY = 48       # its entries of mixture and reach with their indices
LIGHT_ENTRY = 20        # and of light samples
BYTES_OF_PIXEL = 64     # of a film
BYTES_OF_EMISSION = 4   # that a pixel has seen
BYTES_OF_COMMAND = 312
BYTES_OF_REPORT = 648
BYTES_OF_WORD = 8
ARRAYS_OF_VOLUMES = 7
ARRAYS_OF_FIELD = 25
ARRAYS_OF_CLUSTERS = 3  # of them, empty without clusters of lights
BYTES_OF_SHAPE = 28
FEWEST_PATHS_BEFORE_UPDATE = 1024
MOST_TRAINING_PASSES = 16
ENOUGH_SAMPLES_PER_VOLUME = 16384
TRAINING_INTERVAL = 4
PIXELS_OF_SHARE = 1 << 16
EAGER_BYTES = 1 << 16      # a longer message waits for an answer to its announcement
LATENCIES_OF_LARGE = 3
# A list is as long as if so many times more or fewer training samples were spread evenly over cells and ranks.
FACTOR_OF_SAMPLES = 8


def update_interval(passes):
    """core/session/update_schedule.h"""
    return max((1 << passes.bit_length()) // 4, 1)


def is_updated_after(passes):
    """core/session/update_schedule.h"""
    return passes % update_interval(passes) == 0


def is_trained_by(number, has_enough):
    """core/session/update_schedule.h"""
    interval = update_interval(number)
    if not has_enough or interval < 2 * TRAINING_INTERVAL:
        return True
    return number % interval >= interval - min(interval // TRAINING_INTERVAL, MOST_TRAINING_PASSES)


def ends_of_parts(pixels, volumes):
    """Of the parts of the first pass; a learner has an update after each but the last."""
    end = 1 << (max(volumes, FEWEST_PATHS_BEFORE_UPDATE) - 1).bit_length()
    ends = []
    while volumes > 0 and end < pixels:
        ends.append(end)
        end *= 2
    return ends + [pixels]


def blocks_of(ends, ranks):
    """Blocks of pixels, each as the cuts between the shares of the ranks: mpi/shares.cpp."""
    blocks = []
    begin = 0
    for end in ends:
        while begin < end:
            left = math.ceil((end - begin) / (PIXELS_OF_SHARE * ranks))
            length = math.ceil((end - begin) / left)
            blocks.append([begin + math.ceil(i * length / ranks) for i in range(ranks + 1)])
            begin += length
    return blocks


def parts_of_rank_0(its_blocks, other_blocks):
    """Pixels of rank 0 in one set of blocks that others have in another one: the number of ranges, and of pixels."""
    parts = [min(end, other_end) - max(begin, other_begin)
             for begin, end, *_ in its_blocks
             for cuts in other_blocks for other_begin, other_end in zip(cuts[1:], cuts[2:])]
    return sum(length > 0 for length in parts), sum(length for length in parts if length > 0)


class Traffic:
    """Messages and bytes of rank 0, as --stats counts them, as bounds [low, high]: the times of shares decide which pixels
    move, and the paths how long the lists of training samples are."""

    def __init__(self):
        self.messages = [0, 0]
        self.bytes = [0, 0]

    def add(self, messages, sent, most_messages=None, most_sent=None):
        for total, low, high in ((self.messages, messages, most_messages), (self.bytes, sent, most_sent)):
            total[0] += low
            total[1] += low if high is None else high

    def add_command(self):
        self.add(2, BYTES_OF_COMMAND + BYTES_OF_REPORT)


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
        self.cells = self.volumes * field["bins"] if field else 0
        self.field_bytes = field["bytes"] if field else 0
        self.records_per_path = field["records"] / paths if field else 0.0
        self.samples_lights = stats["nee"]
        self.refines_emission = stats["emission_rays"] > 0
        self.update_bytes = self.volumes * (field["bins"] * BYTES_OF_CELL + BYTES_OF_VOLUME) if field else 0
        self.updates = self.paths_before_updates(self.pixels, self.passes)
        measured = len(self.paths_before_updates(stats["width"] * stats["height"], stats["spp"]))
        self.learn = stats["seconds"]["learn"] * len(self.updates) / max(measured, 1)

    def updated_passes(self, pixels, passes):
        """Numbers of the passes that an update follows. A field with enough training samples is trained by few passes."""
        updated = []
        records = 0.0
        for done in range(1, passes + 1) if self.volumes else []:
            has_enough = records >= ENOUGH_SAMPLES_PER_VOLUME * self.volumes
            if not is_trained_by(done - 1, has_enough):
                continue
            records += self.records_per_path * pixels
            if is_updated_after(done):
                updated.append(done)
        return updated

    def traffic(self, ranks):
        """Of everything behind the scene: volumes, passes, updates and one reading of the film. Without refinement of volumes."""
        traffic = Traffic()
        if ranks == 1:
            return traffic
        traffic.add_command()  # the empty film
        if self.volumes:
            arrays = ARRAYS_OF_VOLUMES + ARRAYS_OF_FIELD
            traffic.add_command()
            traffic.add_command()
            # An array without elements is only its length.
            most = 1 + 2 * arrays
            sent = BYTES_OF_SHAPE + arrays * BYTES_OF_WORD + self.field_bytes
            traffic.add(most - ARRAYS_OF_CLUSTERS, sent, most)
        ends = ends_of_parts(self.pixels, self.volumes)
        updated = self.updated_passes(self.pixels, self.passes)
        begin = 0
        for end in ends:
            traffic.add_command()
            traffic.add(len(blocks_of([end - begin], ranks)) - 1, 4 * (len(blocks_of([end - begin], ranks)) - 1))
            if end < self.pixels or 1 in updated:
                self.add_update(traffic, ranks, end - begin)
            begin = end
        last_update = 1
        for number in range(2, self.passes + 1):
            self.add_pass(traffic, ranks, number)
            if number in updated:
                self.add_update(traffic, ranks, (number - last_update) * self.pixels)
                last_update = number
        traffic.add_command()
        blocks = blocks_of(ends if self.passes == 1 else [self.pixels], ranks)
        receives = (ranks - 1) * len(blocks)
        traffic.add(receives if self.has_even_shares(ranks, self.passes) else 0, 0, receives)
        return traffic

    def joins_blocks(self, ranks):
        """Whether the second pass has fewer blocks than the parts of the first one."""
        return len(blocks_of(ends_of_parts(self.pixels, self.volumes), ranks)) != len(blocks_of([self.pixels], ranks))

    def has_even_shares(self, ranks, number):
        """Whether no time has decided about the shares of a pass yet."""
        return number < (4 if self.joins_blocks(ranks) else 2)

    def add_pass(self, traffic, ranks, number):
        """Of a pass after the first one."""
        blocks = blocks_of([self.pixels], ranks)
        traffic.add_command()
        traffic.add(len(blocks) - 1, 4 * (len(blocks) - 1))
        own = sum(cuts[1] - cuts[0] for cuts in blocks)
        if number & (number - 1) == 0:
            if number == 2 and self.joins_blocks(ranks):
                first = blocks_of(ends_of_parts(self.pixels, self.volumes), ranks)
                sent, pixels = parts_of_rank_0(first, blocks)
                received, _ = parts_of_rank_0(blocks, first)
                traffic.add(sent + received, BYTES_OF_PIXEL * pixels)
            else:
                traffic.add(1, BYTES_OF_WORD * len(blocks))
                most = own if number == 2 else self.pixels
                traffic.add(0, 0, (ranks - 1) * len(blocks), BYTES_OF_PIXEL * most)
        if not self.refines_emission:
            return
        if number == 2:
            traffic.add(1, self.pixels)  # marks of borders
        elif (number - 1) & (number - 2) == 0:
            least, most = (own, own) if self.has_even_shares(ranks, number) else (0, self.pixels)
            traffic.add(1, BYTES_OF_EMISSION * least, 1, BYTES_OF_EMISSION * most)

    def add_update(self, traffic, ranks, paths):
        traffic.add_command()
        traffic.add(1, BYTES_OF_WORD)  # how long the lists are together
        samples = self.records_per_path * paths / ranks
        least, most = self.list_bytes(samples / FACTOR_OF_SAMPLES), self.list_bytes(samples * FACTOR_OF_SAMPLES)
        if ranks * least >= 2 * self.update_bytes:
            traffic.add(1, self.update_bytes)
        elif ranks * most < 2 * self.update_bytes:
            traffic.add(1, least, 1, most)
        else:
            longest_list = min(most, 2 * self.update_bytes)
            traffic.add(1, min(least, self.update_bytes), 1, max(longest_list, self.update_bytes))

    def paths_before_updates(self, pixels, passes):
        """For each update, the paths since the one before."""
        ends = ends_of_parts(pixels, self.volumes)[:-1]
        ends += [number * pixels for number in self.updated_passes(pixels, passes)]
        return [end - begin for begin, end in zip([0] + ends, ends)]

    def summed_bytes(self, ranks, paths):
        """That a rank sends to sum the training samples of so many paths: the lists of the others passed on, or arrays twice."""
        lists = self.list_bytes(self.records_per_path * paths / ranks) * (ranks - 1)
        return min(lists, 2 * self.update_bytes * (ranks - 1) / ranks)

    def list_bytes(self, samples):
        """Of the sums of so many training samples, each as likely in every cell."""
        cells = self.cells * -math.expm1(-samples / self.cells)
        volumes = self.volumes * -math.expm1(-samples / self.volumes)
        of_volume = VOLUME_ENTRY + (LIGHT_ENTRY if self.samples_lights else 0)
        return ARRAYS_OF_PENDING * BYTES_OF_INDEX + cells * (BYTES_OF_CELL + 2 * BYTES_OF_INDEX) + volumes * of_volume

    def seconds(self, ranks, threads, latency, bandwidth):
        """latency in seconds, bandwidth in bytes per second. Updates run on every rank, by all of its threads."""
        steps = math.ceil(math.log2(ranks)) if ranks > 1 else 0
        share = (ranks - 1) / ranks
        of_command = steps * (2 * latency + (BYTES_OF_COMMAND + BYTES_OF_REPORT) / bandwidth)
        blocks = len(blocks_of([self.pixels], ranks))
        of_pass = of_command + (blocks - 1) * steps * latency
        commands = self.passes - 1 + len(ends_of_parts(self.pixels, self.volumes))
        # Reduce-scatter and allgather [Rabenseifner 2004], of the length of the lists and of the sums.
        lengths = [self.summed_bytes(ranks, paths) for paths in self.updates]
        waits = sum(1 + (LATENCIES_OF_LARGE if length > EAGER_BYTES else 1) for length in lengths)
        updates = len(lengths) * of_command + 2 * steps * waits * latency
        # Scatter and allgather.
        of_field = 2 * share * self.field_bytes / bandwidth
        of_film = share * self.pixels * BYTES_OF_PIXEL / bandwidth + (ranks - 1) * latency if ranks > 1 else 0.0
        work = (self.render + self.precompute) / (ranks * threads) + self.learn / threads + self.serial
        return work + of_field + commands * of_pass + updates + sum(lengths) / bandwidth + of_film


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
    parser.add_argument("--mpaths", type=float, help="millions of paths per second of a faster or slower thread")
    parser.add_argument("--ranks", default="1,2,4,8,16,128,1024")
    options = parser.parse_args()
    with open(options.stats, encoding="utf-8") as file:
        stats = json.load(file)
    if options.mpaths:
        slower = stats["paths"] / stats["seconds"]["render"] / 1e6 / options.mpaths
        stats["seconds"] = {clock: seconds * slower for clock, seconds in stats["seconds"].items()}
    run = Run(stats, options.size, options.spp)
    networks = [(10.0, 20.0), (100.0, 3.0)]
    if options.gigabits:
        networks = [(options.gigabits, options.microseconds or 20.0)]
    ranks = [int(count) for count in options.ranks.split(",")]
    print(f"{run.passes} passes of {run.pixels} pixels, {len(run.updates)} updates of {run.update_bytes / 1e6:.2f} MB, "
          f"{run.paths_per_second / 1e6:.2f} Mpaths/s and thread, {options.threads} threads a rank\n")
    for gigabits, microseconds in networks:
        print(f"| {gigabits:g} Gbit/s, {microseconds:g} us: ranks | seconds | speed-up | efficiency |\n| ---: | ---: | ---: | ---: |")
        for count, time, speedup, efficiency in rows(run, options.threads, ranks, microseconds * 1e-6, gigabits * 1e9 / 8):
            print(f"| {count} | {time:.3g} | {speedup:.1f} | {efficiency:.2f} |")
        print()


if __name__ == "__main__":
    main()
