"""Paths by batches: their vertices as arrays, and directions by a sampler of one's own."""

import gc
import sys
import weakref

import numpy as np
import pytest

import pathlight

SIZE = dict(width=32, height=24)


class Cosine:
    """Samples the cosine as Lambert's BSDF does, by frames of its own."""

    def sample(self, vertices):
        u, v = vertices["uniforms"].T
        n = vertices["normal"].astype(float)
        helper = np.where(np.abs(n[:, :1]) > 0.9, [[0.0, 1.0, 0.0]], [[1.0, 0.0, 0.0]])
        s = np.cross(helper, n)
        s /= np.linalg.norm(s, axis=1, keepdims=True)
        t = np.cross(n, s)
        r, angle = np.sqrt(u)[:, None], (2 * np.pi * v)[:, None]
        wi = r * np.cos(angle) * s + r * np.sin(angle) * t + np.sqrt(np.maximum(1 - u, 1e-6))[:, None] * n
        return wi / np.linalg.norm(wi, axis=1, keepdims=True)

    def pdf(self, vertices, directions):
        return np.maximum((vertices["normal"] * directions).sum(axis=1), 0) / np.pi


def test_vertices_and_film_are_those_of_default(door):
    tracer = pathlight.PathTracer(door, nee=True, seed=7, **SIZE)
    vertices = tracer.trace()
    assert vertices.dtype.names == (
        "pixel", "sample", "depth", "position", "normal", "outgoing", "albedo", "uniforms", "throughput", "direction", "pdf",
        "incident",
    )
    first = vertices[vertices["depth"] == 0]
    assert (first["throughput"] == 1).all() and (np.diff(first["pixel"].astype(int)) > 0).all()
    assert (vertices["uniforms"] >= 0).all() and (vertices["uniforms"] < 1).all()
    for name in ("normal", "outgoing"):
        assert np.allclose(np.linalg.norm(vertices[name], axis=1), 1, atol=1e-5)
    goes_on = vertices["pdf"] > 0
    assert np.allclose(np.linalg.norm(vertices["direction"][goes_on], axis=1), 1, atol=1e-5)
    assert (vertices["direction"][~goes_on] == 0).all() and (vertices["incident"][~goes_on] == 0).all()
    assert vertices["depth"].max() < 64 and (vertices["sample"] == 0).all()

    session = pathlight.Session(door, method="default", nee=True, seed=7, threads=2, **SIZE)
    session.render(spp=1)
    assert session.film().tobytes() == tracer.film().tobytes()
    assert tracer.passes == 1 and tracer.invalid_samples == 0
    assert (tracer.trace()["sample"] == 1).all()


@pytest.mark.parametrize("nee", [False, True])
def test_a_sampler_of_the_cosine_gives_the_picture_of_the_bsdf(door, nee):
    """64 samples each, seed 1; their means agree within 4.5 standard errors (7e-6) and are known to 5 %."""
    films = []
    for sampler, fraction in ((None, 1.0), (Cosine(), 0.3)):
        tracer = pathlight.PathTracer(door, sampler, nee=nee, bsdf_fraction=fraction, **SIZE)
        for _ in range(64):
            tracer.trace()
        films.append(tracer.film().astype(float).mean(axis=2))
    (a, b), pixels = (film.mean() for film in films), films[0].size
    # The spread of a pixel's error by the difference of the films, whose expectations are equal.
    error = (films[0] - films[1]).std() / np.sqrt(pixels)
    assert error < 0.05 * a
    assert abs(a - b) < 4.5 * error


class Wrong(Cosine):
    def __init__(self, method, change):
        self.method, self.change = method, change

    def sample(self, vertices):
        wi = super().sample(vertices)
        return self.change(wi) if self.method == "sample" else wi

    def pdf(self, vertices, directions):
        pdf = super().pdf(vertices, directions)
        return self.change(pdf) if self.method == "pdf" else pdf


def at(value):
    def change(values):
        values = np.array(values)
        values[17] = value
        return values

    return change


@pytest.mark.parametrize(
    "method, change, message",
    [
        ("sample", at(np.nan), r"sampler.sample, vertex 17 at \(.*\): expected a unit vector, got \(nan"),
        ("sample", at(2.0), "vertex 17 .*expected a unit vector"),
        ("sample", lambda wi: wi[:, :2], r"sampler.sample: expected an array of shape \(\d+, 3\), got"),
        ("pdf", at(np.nan), r"sampler.pdf, vertex 17 at \(.*\): expected a finite density, not negative, got nan"),
        ("pdf", at(-1.0), "not negative, got -1"),
        ("pdf", at(np.inf), "expected a finite density"),
        ("pdf", lambda pdf: pdf[:5], r"sampler.pdf: expected an array of shape \(\d+,\), got \(5,\)"),
        ("pdf", lambda pdf: 0 * pdf, "expected a density above 0 of the direction that it sampled, got 0"),
    ],
)
def test_wrong_answers_are_refused_and_the_film_stays(door, method, change, message):
    tracer = pathlight.PathTracer(door, Wrong(method, change), **SIZE)
    with pytest.raises(pathlight.InputError, match=message):
        tracer.trace()
    assert tracer.passes == 0 and (tracer.film() == 0).all()


def test_a_sampler_may_not_use_its_tracer(door):
    class Asking(Cosine):
        def sample(self, vertices):
            return self.tracer.film()

    sampler = Asking()
    sampler.tracer = pathlight.PathTracer(door, sampler, **SIZE)
    with pytest.raises(pathlight.UsageError, match="this tracer is in use"):
        sampler.tracer.trace()


def test_arguments(door):
    with pytest.raises(pathlight.UsageError, match="methods sample"):
        pathlight.PathTracer(door, object())
    with pytest.raises(pathlight.UsageError, match="got <class"):
        pathlight.PathTracer(door, Cosine)
    with pytest.raises(pathlight.UsageError, match="bsdf_fraction: expected 0 to 1, got 2"):
        pathlight.PathTracer(door, Cosine(), bsdf_fraction=2)
    with pytest.raises(pathlight.UsageError, match="got 0x5"):
        pathlight.PathTracer(door, width=0, height=5)


def test_an_exception_of_a_sampler_comes_through_and_nothing_leaks(door):
    class Failing(Cosine):
        def sample(self, vertices):
            raise ZeroDivisionError("in the sampler")

    sampler = Failing()
    tracer = pathlight.PathTracer(door, sampler, **SIZE)
    sampler.tracer = tracer  # a cycle
    with pytest.raises(ZeroDivisionError, match="in the sampler"):
        tracer.trace()
    gone = weakref.ref(sampler)
    del sampler, tracer
    sys.last_value = None
    gc.collect()
    assert gone() is None
