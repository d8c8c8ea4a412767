#!/usr/bin/env python3
"""Tests device_tables.py on results that a rehearsal has left (examples/), on parts of them, and on broken ones.

Usage: device_tables_test.py [--write]   --write makes examples/tables.md anew.
"""
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
EXAMPLES = HERE / "examples"
RUN = "@run\tstage=b\tdate=2026-01-01T00:00:00Z\tgpu=\trehearsal=no\tkit=\n"


def run(folder, *sections):
    return subprocess.run([sys.executable, HERE / "device_tables.py", folder, *sections], capture_output=True, text=True)


def tables_of(log, *sections):
    """Tables of one stage-b.log."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "stage-b.log").write_text(log)
        return run(folder, *sections)


class DeviceTables(unittest.TestCase):
    def test_results_of_a_rehearsal_give_their_tables(self):
        self.assertEqual(run(EXAMPLES).stdout, (EXAMPLES / "tables.md").read_text())

    def test_a_rehearsal_says_that_it_is_one(self):
        self.assertIn("no figure here is one of a GPU", run(EXAMPLES).stdout)
        self.assertNotIn("rehearsal", tables_of(RUN).stdout)

    def test_without_records_no_figure_is_printed(self):
        for section in ("goals", "speed", "ratios", "launches", "parts", "kernels", "profile", "ceilings", "switches", "variants"):
            text = tables_of(RUN, section).stdout.split("\n## ", 1)[1]
            self.assertIn("not measured", text, section)
            if section != "goals":  # which has the figures that are asked for
                self.assertIsNone(re.search(r"\d", text), text)
        self.assertEqual(tables_of(RUN, "goals").stdout.count("not measured"), 4)

    def test_figures_are_those_of_the_records(self):
        row = "@bench\tscene=cornell\trow=method\tmethod={}\tnee=off\tsize=1920x1080\tpasses=9\tms_per_pass={}\t" \
              "paths_per_s=1e9\tsegments_per_s={}\n"
        text = tables_of(RUN + row.format("default", 8, 5e9) + row.format("precomputed", 10, 4e9), "goals").stdout
        self.assertIn("| Cornell box, `default`, 1920 x 1080 | 4 G segments/s | 5.00 |", text)
        self.assertIn("| guided over unguided, time per segment | at most 1.4 | 1.25 |", text)
        self.assertIn("| passes a second at 1920 x 1080 | 60 | 125 |", text)

    def test_shares_are_those_of_the_ceilings(self):
        text = tables_of(
            RUN + "@ceiling\tlane_instructions_per_s=2e12\tbytes_per_s=1e12\n"
            "@kernel\tcase=c\tkernel=add_samples\twork=publish\tcount=2\tms=4\tbytes=1000000000\n"
            "@kernel\tcase=c\tkernel=trace_paths default entry 0 set 0\twork=trace\tcount=2\tms=10\tbytes=0\n"
            "@passes\tcase=c\tsize=8x8\tpasses=2\thost_ms_per_pass=9\tsegments=40000000\tshadow_rays=0\n",
            "kernels").stdout
        self.assertIn("| c | add_samples | 2 | 4.000 | 25 % of a copy |", text)
        self.assertIn("| 10.000 | 500 lane instructions a segment at most |", text)

    def test_several_samples_a_launch_are_compared_with_one(self):
        row = "@bench\tscene=cornell\trow=launch\tmethod=default\tnee=off\tsize=8x8\tpasses=9\tmost_samples={}\t" \
              "ms_per_pass={}\tpaths_per_s=1\tsegments_per_s=1\n"
        text = tables_of(RUN + row.format(1, 4) + row.format(16, 3), "launches").stdout
        self.assertIn("| 8x8 | default | 16 | 3.000 | 0.75 |", text)

    def test_variants_are_compared_with_the_default_build_of_their_scene(self):
        step = "@begin\tstep=variant-{}-bench\tlimit=60\tcommand=cuda_bench\n"
        row = "@bench\tscene={}\trow=method\tmethod=default\tnee=off\tsize=8x8\tpasses=9\tms_per_pass={}\t" \
              "paths_per_s=1\tsegments_per_s=1\n"
        text = tables_of(RUN + step.format("other") + row.format("cornell", 2) + row.format("coats", 30) +
                         step.format("none") + row.format("cornell", 4) + row.format("coats", 40), "variants").stdout
        self.assertIn("| other | cornell | 8x8 | default | 2.000 | 0.50 |", text)
        self.assertIn("| other | coats | 8x8 | default | 30.000 | 0.75 |", text)

    def test_cases_that_differ_are_listed(self):
        text = tables_of(RUN + "@compare\tcase=door default\tresult=differs\tfilm_values=3\tfilm_share=0.25\t"
                         "film_largest=1e-07\ttable_values=0\ttable_share=0\ttable_largest=0\tcounters=equal\t"
                         "cpu_seconds=0\tcuda_seconds=0\tsettings=scene=Door\n", "parity").stdout
        self.assertIn("1 cases, 1 differ", text)
        self.assertIn("| door default | 0.25 | 1e-07 | 0 | 0 | equal | scene=Door |", text)

    def test_counters_of_the_profiler_are_read(self):
        text = tables_of(
            RUN + "@begin\tstep=profile-default\tlimit=60\tcommand=ncu\n==PROF== Connected\n"
            '"ID","Kernel Name","Metric Name","Metric Unit","Metric Value"\n'
            '"0","trace_paths","sm__warps_active.avg.pct_of_peak_sustained_active","%","43.5"\n'
            '"0","trace_paths","smsp__inst_executed.sum","inst","1,234"\n', "profile").stdout
        self.assertIn("| `sm__warps_active.avg.pct_of_peak_sustained_active` | 43.5 % |", text)
        self.assertIn("| `smsp__inst_executed.sum` | 1,234 inst |", text)

    def test_shares_of_the_peaks_are_those_of_the_longest_launch(self):
        head = '"ID","Kernel Name","Metric Name","Metric Unit","Metric Value"\n'
        row = '"{}","void pl::cuda::<unnamed>::run_step<&pl::f>(View)","{}","{}","{}"\n'
        text = tables_of(
            RUN + "@begin\tstep=ceilings\tlimit=60\tcommand=ncu\n" + head +
            row.format(0, "gpu__time_duration.sum", "ns", "900") +
            row.format(0, "sm__throughput.avg.pct_of_peak_sustained_elapsed", "%", "1.5") +
            row.format(1, "gpu__time_duration.sum", "ns", "1,200") +
            row.format(1, "sm__throughput.avg.pct_of_peak_sustained_elapsed", "%", "2.5"), "ceilings").stdout
        self.assertIn("| run_step | 1,200 ns | 2.5 % | not measured |", text)

    def test_broken_results_are_refused(self):
        broken = tables_of(RUN + "@bench\tscene\n")
        self.assertEqual(broken.returncode, 3)
        self.assertIn("stage-b.log:2: expected key=value", broken.stderr)
        self.assertEqual(run(HERE / "nowhere").returncode, 3)
        self.assertEqual(run(EXAMPLES, "nonsense").returncode, 2)


if __name__ == "__main__":
    if sys.argv[1:] == ["--write"]:
        (EXAMPLES / "tables.md").write_text(run(EXAMPLES).stdout)
    else:
        unittest.main()
