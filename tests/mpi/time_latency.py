#!/usr/bin/env python3
"""Time of jobs over a slow network against the model of docs/scaling.md, by hand and as root: ranks in network namespaces of their own,
joined by a switch in this process that delivers every packet late.

Usage: time_latency.py PROGRAM MPIRUN [RUNS]

Prints, for each number of ranks and each latency, the seconds that rendering and learning take longer than without latency:
predicted, and measured as the median of RUNS (3) runs in turns. Needs iproute2 and /dev/net/tun.
"""
import collections
import fcntl
import json
import os
import select
import statistics
import struct
import subprocess
import sys
import tempfile
import threading
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "docs"))
import scaling_model  # noqa: E402

RANKS = (2, 4)
MILLISECONDS = (1.0, 5.0)
RUN = ("--size", "256x256", "--spp", "16", "--method", "reinforcement", "--nee", "off", "--volumes", "100", "--bins", "256", "-t", "1")
NO_LIMIT = 1e15  # bytes per second
TUNSETIFF = 0x400454CA
IFF_TUN_WITHOUT_HEADER = 0x1001
MTU = 9000
ALLOWED = {f"{name}_ALLOW_RUN_AS_ROOT{more}": "1" for name in ("OMPI", "PRTE") for more in ("", "_CONFIRM")}


def call(*words):
    subprocess.run(words, check=True)


class Switch(threading.Thread):
    """Hosts pl0, pl1, ... with the addresses 10.77.0.1, ...; a packet arrives `delay` seconds after it was sent."""

    def __init__(self, hosts):
        super().__init__(daemon=True)
        self.delay = 0.0
        self.has_ended = False
        self.names = [f"pl{i}" for i in range(hosts)]
        self.devices = []
        for number, name in enumerate(self.names):
            device = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK)
            fcntl.ioctl(device, TUNSETIFF, struct.pack("16sH", f"{name}t".encode(), IFF_TUN_WITHOUT_HEADER))
            self.devices.append(device)
            call("ip", "netns", "add", name)
            call("ip", "link", "set", f"{name}t", "netns", name)
            inside = ("ip", "netns", "exec", name, "ip")
            call(*inside, "addr", "add", f"10.77.0.{number + 1}/24", "dev", f"{name}t")
            call(*inside, "link", "set", f"{name}t", "mtu", str(MTU), "up")
            call(*inside, "link", "set", "lo", "up")

    def run(self):
        under_way = collections.deque()
        while not self.has_ended:
            now = time.monotonic()
            while under_way and under_way[0][0] <= now:
                _, device, packet = under_way.popleft()
                try:
                    os.write(device, packet)
                except OSError:
                    pass  # a full queue drops the packet, as a switch does
            wait = min(under_way[0][0] - now, 0.1) if under_way else 0.1
            for device in select.select(self.devices, [], [], max(wait, 0.0))[0]:
                packet = os.read(device, 65536)
                number = packet[19] - 1  # last byte of the destination of IPv4
                if packet[0] >> 4 == 4 and packet[16:19] == b"\x0a\x4d\x00" and number < len(self.devices):
                    under_way.append((time.monotonic() + self.delay, self.devices[number], packet))

    def close(self):
        self.has_ended = True
        self.join()
        for name in self.names:
            subprocess.run(["ip", "netns", "del", name], check=False)


class Jobs:
    def __init__(self, program, mpirun, folder):
        self.program, self.mpirun, self.folder = program, mpirun, folder
        # mpirun starts the part of a host by this command: host, then the words of a shell command.
        self.agent = os.path.join(folder, "agent")
        with open(self.agent, "w", encoding="utf-8") as file:
            file.write('#!/bin/sh\nhost=pl$((${1##*.} - 1)); shift\n'
                       'exec ip netns exec $host unshare --uts sh -c "hostname $host; $*"\n')
        os.chmod(self.agent, 0o755)

    def stats(self, ranks):
        path = os.path.join(self.folder, "stats.json")
        render = [self.program, "render", "cornell", *RUN, "--stats", path, "-o", os.path.join(self.folder, "a.pfm")]
        command = render
        if ranks > 1:
            hosts = ",".join(f"10.77.0.{i + 1}" for i in range(ranks))
            network = ["--mca", "btl", "tcp,self", "--mca", "btl_tcp_if_include", "10.77.0.0/24", "--mca", "oob_tcp_if_include",
                       "10.77.0.0/24", "--mca", "plm_rsh_agent", self.agent]
            command = ["ip", "netns", "exec", "pl0", self.mpirun, *network, "--host", hosts, "--bind-to", "none", "-n", str(ranks),
                       *render]
        subprocess.run(command, check=True, timeout=300, stdout=subprocess.DEVNULL, env={**os.environ, **ALLOWED})
        with open(path, encoding="utf-8") as file:
            return json.load(file)


def work_seconds(stats):
    return stats["seconds"]["render"] + stats["seconds"]["learn"]


def main():
    runs = int(sys.argv[3]) if len(sys.argv) > 3 else 3
    switch = Switch(max(RANKS))
    try:
        switch.start()
        with tempfile.TemporaryDirectory() as folder:
            jobs = Jobs(os.path.abspath(sys.argv[1]), sys.argv[2], folder)
            model = scaling_model.Run(jobs.stats(1))
            print("| ranks | latency | predicted | measured |\n| ---: | ---: | ---: | ---: |")
            for ranks in RANKS:
                seconds = collections.defaultdict(list)
                for _ in range(runs):
                    for milliseconds in (0.0, *MILLISECONDS):
                        switch.delay = milliseconds * 1e-3
                        seconds[milliseconds].append(work_seconds(jobs.stats(ranks)))
                for milliseconds in MILLISECONDS:
                    predicted = (model.seconds(ranks, 1, milliseconds * 1e-3, NO_LIMIT) -
                                 model.seconds(ranks, 1, 0.0, NO_LIMIT))
                    measured = statistics.median(seconds[milliseconds]) - statistics.median(seconds[0.0])
                    print(f"| {ranks} | {milliseconds:g} ms | {predicted:.2f} | {measured:.2f} |", flush=True)
    finally:
        switch.close()


if __name__ == "__main__":
    main()
