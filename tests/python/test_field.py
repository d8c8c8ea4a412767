"""The learned field as arrays, its densities and samples."""

import numpy as np
import pytest

import pathlight

REPRESENTATIONS = ["table", "sd-tree", "lobes", "neural"]


def learned(door, **options):
    session = pathlight.Session(
        door, method="reinforcement", guiding="always", nee=False, width=64, height=48, volumes=40, bins=64, **options
    )
    session.render(spp=8)
    return session.field


@pytest.mark.parametrize("name", REPRESENTATIONS)
def test_arrays_of_a_field(door, name):
    field = learned(door, field=name)
    volumes = len(field)
    assert field.positions.shape == field.normals.shape == (volumes, 3)
    assert field.radiance.shape == field.probabilities.shape == field.visits.shape == (volumes, 64)
    assert field.visits.sum() > 0 and (field.mean_radiance >= 0).all()
    assert np.allclose(np.linalg.norm(field.normals, axis=1), 1, atol=1e-5)
    sums = field.probabilities.sum(axis=1)
    if name == "table":
        assert np.allclose(sums, 1, atol=1e-5)
    # A cell of others has the density at 16 of its points, and their directions below the horizon are in none.
    assert (sums > 0).all() and (sums < 1.3).all()
    assert ((field.bsdf_fraction >= 0.1) & (field.bsdf_fraction <= 0.9)).all()
    assert ((field.directions * field.normals[:, None]).sum(axis=2) > 0).all()


@pytest.mark.parametrize("name", REPRESENTATIONS)
def test_samples_have_their_densities(door, name):
    field = learned(door, field=name)
    random = np.random.default_rng(1)
    count = 4096
    volume = int(field.mean_radiance.argmax())
    positions = np.repeat(field.positions[volume : volume + 1], count, axis=0)
    normals = np.repeat(field.normals[volume : volume + 1], count, axis=0)
    directions, densities = field.sample(positions, normals, random.random((count, 2), np.float32))
    assert np.allclose(np.linalg.norm(directions, axis=1), 1, atol=1e-4)
    assert np.allclose(densities, field.pdf(positions, normals, directions), rtol=1e-4)
    # The mean of cos / (pi density) over samples is the integral of the cosine over pi: 1 where the density is above 0 on the whole
    # hemisphere. With seed 1: 4096 samples, bound of 5 standard errors, alarm probability 6e-7 for each representation.
    values = np.maximum((directions * normals).sum(axis=1), 0) / (np.pi * np.maximum(densities, 1e-9))
    assert abs(values.mean() - 1) < 5 * values.std() / np.sqrt(count) + 0.01


def test_places_without_volumes_are_nan(door):
    field = learned(door)
    nowhere = np.array([[1e4, 1e4, 1e4]], np.float32)
    up = np.array([[0, 0.6, 0.8]], np.float32)
    assert field.pdf(nowhere, up, up).shape == (1,)
    with pytest.raises(pathlight.InputError, match="directions"):
        field.pdf(nowhere, up, np.zeros((2, 3), np.float32))


def test_what_is_not_learned_has_no_field(door):
    session = pathlight.Session(door, width=8, height=8)
    session.render(spp=1)
    with pytest.raises(pathlight.UsageError):
        session.field


def test_the_plot_of_a_hemisphere_shows_every_cell_where_it_lies(door):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    field = learned(door)
    volume = int(field.visits.sum(axis=1).argmax())
    disc = field.plot(volume, values="probabilities").images[0].get_array()
    inside = disc.compressed() if np.ma.isMaskedArray(disc) else disc[np.isfinite(disc)]
    assert set(inside) == set(field.probabilities[volume])
    # Cells have equal areas on the disc; nearest middles are cells up to their borders.
    assert inside.mean() == pytest.approx(field.probabilities[volume].mean(), rel=0.1)
