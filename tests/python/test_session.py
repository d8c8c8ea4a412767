"""Sessions: the bits of the command line, limits, interruption, threads, and memory."""

import gc
import os
import signal
import subprocess
import sys
import threading
import time
import weakref

import numpy as np
import pytest

import pathlight
from test_scene import arrays

SMALL = dict(width=48, height=32, threads=2)


class Uniform:
    def update(self, samples):
        return np.ones_like(samples.radiance)


def read_pfm(path):
    with open(path, "rb") as file:
        assert file.readline() == b"PF\n"
        width, height = map(int, file.readline().split())
        scale = float(file.readline())
        assert scale < 0
        return np.frombuffer(file.read(), "<f4").reshape(height, width, 3)[::-1]


@pytest.mark.parametrize(
    "options",
    [
        dict(method="default", nee=False, seed=3),
        dict(method="reinforcement", guiding="always", volumes=100, bins=64),
        dict(method="reinforcement", field="sd-tree", nee=False, learn={"passes": 4}),
        dict(method="precomputed", bsdf_fraction=0.3, max_depth=5, camera={"fov_deg": 30}),
    ],
    ids=lambda options: options.get("field", options["method"]),
)
def test_the_same_settings_give_the_bits_of_the_command_line(program, tmp_path, options):
    session = pathlight.Session(pathlight.Scene("door"), **SMALL, **options)
    for spp in (1, 4, 7):  # in pieces
        session.render(spp=spp)
    picture = tmp_path / "film.pfm"
    words = []
    for name, value in {**SMALL, **options}.items():
        if name == "camera":
            name, value = "fov", value["fov_deg"]
        if isinstance(value, dict):
            value = ",".join(f"{key}={item}" for key, item in value.items())
        if isinstance(value, bool):
            value = "on" if value else "off"
        words.append(f"--{name.replace('_', '-')}={value}")
    subprocess.run([program, "render", "door", "-o", picture, "--spp=7", "-q", *words], check=True)
    assert session.film().tobytes() == read_pfm(picture).tobytes()


def test_a_film_is_an_array_of_its_own(door):
    session = pathlight.Session(door, **SMALL)
    assert session.passes == 0 and not session.film().any()
    session.render(spp=2)
    film = session.film()
    assert film.shape == (32, 48, 3) and film.dtype == np.float32 and film.flags.writeable
    kept = film.copy()
    session.render(spp=4)
    assert (film == kept).all() and (session.film() != kept).any()
    even, odd = session.halves()
    assert np.allclose(0.5 * (even + odd), session.film(), rtol=1e-5)
    del session
    assert (film == kept).all()


def test_statistics_are_those_of_the_program(door):
    session = pathlight.Session(door, method="reinforcement", seed=5, **SMALL)
    session.render(spp=3)
    statistics = session.statistics()
    assert statistics["spp"] == 3 and statistics["seed"] == 5 and statistics["ended_by"] == "spp"
    assert statistics["paths"] >= 3 * 48 * 32 and statistics["field"]["records"] > 0
    assert "reinforcement" in repr(session) and session._repr_png_()[1:4] == b"PNG"


def test_limits_end_a_rendering(door):
    session = pathlight.Session(door, **SMALL)
    session.render(seconds=0.2)
    assert session.statistics()["ended_by"] == "time-limit"
    passes = session.passes
    session.render(spp=passes)
    assert session.passes == passes
    session.render(target_error=1e3)
    assert session.statistics()["ended_by"] == "target-error"


@pytest.mark.parametrize("limit", [dict(spp=0), dict(spp=-1), dict(spp=2.5), dict(seconds=-1), dict(seconds=float("nan")), dict(target_error=0)])
def test_limits_that_are_none_are_refused(door, limit):
    """Without end: no picture reaches the error 0, and no time is later than nan."""
    session = pathlight.Session(door, **SMALL)
    with pytest.raises(pathlight.UsageError, match="expected .* got"):
        session.render(**limit)
    assert session.passes == 0


@pytest.mark.parametrize(
    "options, text",
    [
        (dict(metod="default"), "--metod"),
        (dict(method="defalt"), "default"),
        (dict(width=0), "--width"),
        (dict(output="a.png"), "--output: is no option of a session"),
        (dict(spp=4), "--spp: is no option of a session"),
        (dict(define="gap=1"), "Scene(..., parameters"),
        (dict(backend="cuda", field="sd-tree", method="reinforcement"), "cuda"),
        (dict(learner=object()), "update(samples)"),
        (dict(method="reinforcement", learner=Uniform), "update(samples), got <class"),
    ],
)
def test_errors_name_the_option(door, options, text):
    with pytest.raises(pathlight.Error) as caught:
        pathlight.Session(door, **options)
    assert text in str(caught.value)


def test_sizes_are_pairs_and_learners_may_change(door):
    """As docs/python.md promises: size=(w, h), a Learner, and session.learner."""

    class Peak(pathlight.Learner):
        def update(self, samples):
            weights = np.zeros(samples.radiance.shape)
            weights[:, 7] = 1
            return weights

    options = dict(method="reinforcement", guiding="always", volumes=50, bins=64, nee=np.bool_(False))
    session = pathlight.Session(door, size=np.array([48, 32]), **options)
    session.render(spp=1)
    assert session.statistics()["nee"] is False
    assert session.learner is None and session.film().shape == (32, 48, 3)
    peaks = (session.field.probabilities[:, 7] > 0.9).sum()
    session.learner = learner = Peak()
    session.render(spp=2)
    assert session.learner is learner and peaks < 5
    assert (session.field.probabilities[:, 7] > 0.9).sum() > 40
    session.learner = None
    session.render(spp=3)
    assert session.learner is None
    session.learner = pathlight.Learner()
    with pytest.raises(NotImplementedError, match="Learner.update"):
        session.render(spp=4)
    with pytest.raises(pathlight.UsageError, match="does not learn"):
        pathlight.Session(door, **SMALL).learner = Peak()


class Bar:
    """Stands in for tqdm's."""

    made = []

    def __init__(self, **options):
        self.options, self.shares, self.n = options, [], 0.0
        Bar.made.append(self)

    def set_description_str(self, text, refresh):
        self.activity = text

    def set_postfix_str(self, text, refresh):
        self.detail = text

    def update(self, more):
        self.n += more
        self.shares.append(self.n)


@pytest.mark.parametrize("tqdm", [Bar, None])
def test_a_bar_tells_how_far_a_rendering_is(door, monkeypatch, tqdm):
    from pathlight import _progress

    monkeypatch.setattr(_progress, "tqdm", tqdm)
    Bar.made = []
    session = pathlight.Session(door, method="reinforcement", **SMALL)
    session.render(seconds=1)
    if tqdm:
        (bar,) = Bar.made
        assert bar.options["total"] == 1 and bar.options["leave"] is False
        assert bar.shares == sorted(bar.shares) and len(bar.shares) >= 2 and bar.shares[-1] == pytest.approx(1)
        assert bar.activity == "rendering" and " spp" in bar.detail
    session.render(spp=session.passes)  # nothing to do, no bar
    assert len(Bar.made) == (tqdm is not None)


def test_a_picture_has_the_command_that_renders_it(program, door, tmp_path):
    scene = pathlight.Scene("door", parameters={"opening": 30})
    session = pathlight.Session(scene, method="reinforcement", seed=4, **SMALL)
    session.render(spp=2)
    session.save(tmp_path / "film.png")
    text = (tmp_path / "film.png").read_bytes()
    command = text[text.index(b"pathlight render") :].split(b"\0")[0]
    assert b"opening=30" in command and b"film.png" in command and b"none.exr" not in command


def test_pictures_are_saved(door, tmp_path):
    session = pathlight.Session(door, **SMALL)
    session.render(spp=1)
    session.save(tmp_path / "film.pfm")
    assert read_pfm(tmp_path / "film.pfm").tobytes() == session.film().tobytes()
    with pytest.raises(pathlight.UsageError):
        session.save(tmp_path / "film.gif")


@pytest.fixture
def interruptible():
    """Ctrl+C as at a terminal: Python leaves it ignored where the shell began it in the background."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def test_an_interruption_ends_a_rendering_which_goes_on_to_the_same_bits(door, interruptible):
    whole = pathlight.Session(door, **SMALL)
    session = pathlight.Session(door, **SMALL)
    threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
    began = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        session.render(seconds=60)
    assert time.monotonic() - began < 30
    spp = session.passes + 1
    session.render(spp=spp)
    whole.render(spp=spp)
    assert session.film().tobytes() == whole.film().tobytes()


def test_other_threads_go_on_and_may_not_use_the_session(door):
    session = pathlight.Session(door, **SMALL)
    work = threading.Thread(target=session.render, kwargs=dict(seconds=1.0))
    work.start()
    steps, refused = 0, 0
    while work.is_alive():
        steps += 1
        try:
            session.film()
        except pathlight.UsageError:
            refused += 1
        time.sleep(0.01)
    work.join()
    assert steps > 10 and refused > 5
    assert session.film().any()


def test_a_thousand_sessions_leave_no_objects():
    """A reference that a session, its field, its learner or its errors kept would leave a thousand blocks or more."""
    scene, learner = arrays(), Uniform()
    options = dict(method="reinforcement", width=8, height=8, volumes=10, bins=16, threads=1)

    def use():
        session = pathlight.Session(scene, learner=learner, **options)
        session.render(spp=1)
        session.film(), session.field.radiance, session.statistics(), session.learner, session._repr_png_()
        for wrong in (lambda: session.halves(), lambda: pathlight.Session(scene, metod="default")):
            with pytest.raises(pathlight.UsageError):
                wrong()

    def blocks():
        gc.collect()
        return sys.getallocatedblocks()

    for _ in range(20):  # caches of Python and NumPy
        use()
    before, references = blocks(), (sys.getrefcount(scene), sys.getrefcount(learner))
    for _ in range(1000):
        use()
    assert (sys.getrefcount(scene), sys.getrefcount(learner)) == references
    assert blocks() - before < 500


def test_sessions_and_learners_are_freed_also_where_they_refer_to_each_other():
    scene = pathlight.Scene("furnace")

    def render():
        learner = Uniform()
        session = pathlight.Session(
            scene, method="reinforcement", learner=learner, width=16, height=16, volumes=50, bins=16, threads=1
        )
        session.render(spp=1)
        session.film(), session.field.radiance, session.statistics()
        learner.session = session
        return weakref.ref(learner)

    kept = [render() for _ in range(10)]
    gc.collect()
    assert not any(learner() for learner in kept)
