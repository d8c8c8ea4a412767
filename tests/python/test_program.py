"""Subcommands of the program as dictionaries, and the metrics of two films."""

import numpy as np
import pytest

import pathlight

SMALL = dict(width=24, height=16, threads=2)


def of_kind(events, kind):
    return [event for event in events if event["event"] == kind]


def test_a_path_as_a_dictionary():
    (path,) = of_kind(pathlight.run("trace", "door", pixel=(12, 8), sample=1, nee=False, **SMALL), "path")
    assert path["vertices"]


def test_a_bench_has_events_and_files(tmp_path):
    events = pathlight.run(
        "bench", "door", method=("default", "reinforcement"), spp=2, seeds=1, reference_spp=4, output=tmp_path, backend="cpu", **SMALL
    )
    assert events and (tmp_path / "results.json").is_file()


def test_switches_have_no_value(tmp_path):
    words = dict(pixel=(12, 8), spp=2, truth=True, truth_samples=32, output=tmp_path / "volume.json")
    events = pathlight.run("inspect", "door", **words, **SMALL)
    assert of_kind(events, "truth") and of_kind(events, "done")


def test_the_window_is_opened_by_a_session():
    with pytest.raises(pathlight.UsageError, match=r"Session.view\(\) opens the window"):
        pathlight.run("view", "door")


@pytest.mark.parametrize("words", [("bench",), ("paint", "door"), ("info", "dor"), ("help",)])
def test_errors_are_exceptions(words):
    with pytest.raises(pathlight.Error):
        pathlight.run(*words)


def test_metrics_of_two_films():
    reference = np.full((4, 6, 3), 2, np.float32)
    metrics = pathlight.compare(reference + 1, reference)
    assert metrics["mse"] == pytest.approx(1) and metrics["relmse"] == pytest.approx(1 / 4.01)
    with pytest.raises(pathlight.InputError, match="got 6 x 3"):
        pathlight.compare(reference, reference[:-1])
