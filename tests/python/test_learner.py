"""Bring your own learner: called at each update, checked, and never a bias."""

import numpy as np
import pytest

import pathlight
from numpy_table import NumpyTable

OPTIONS = dict(method="reinforcement", guiding="always", width=48, height=32, threads=2)


class Own:
    """Returns what `answer` makes of the samples, and keeps these."""

    def __init__(self, answer, returns="probabilities"):
        self.answer, self.returns, self.calls = answer, returns, []

    def update(self, samples):
        self.calls.append(samples)
        return self.answer(samples)


def test_the_samples_of_an_update(door):
    learner = Own(lambda s: s.radiance)
    session = pathlight.Session(door, learner=learner, volumes=100, bins=64, **OPTIONS)
    session.render(spp=4)
    assert len(learner.calls) >= 4
    for samples in learner.calls:
        assert samples.sums.shape == samples.counts.shape == samples.radiance.shape == samples.visits.shape == (100, 64)
        assert samples.sums.dtype == np.int64 and samples.counts.dtype == np.uint32
        assert samples.positions.shape == samples.normals.shape == (100, 3)
        assert samples.floor == pytest.approx(0.1)
        assert (samples.sums[samples.counts == 0] == 0).all()
    # Counts of all updates are the visits of the field.
    assert sum(s.counts.astype(int).sum() for s in learner.calls) == session.field.visits.sum()
    assert (learner.calls[1].visits == learner.calls[0].counts).all()


@pytest.mark.parametrize("volumes", [None, 200])
def test_a_learner_that_does_what_the_table_does_gives_its_bits(door, volumes):
    films = []
    for learner in (None, NumpyTable()):
        session = pathlight.Session(door, learner=learner, volumes=volumes, **OPTIONS)
        session.render(spp=20)  # beyond the first refinements
        films.append(session.film())
        field = session.field
    assert films[0].tobytes() == films[1].tobytes()
    assert len(field) > 0


def test_probabilities_are_normalized_and_keep_the_floor(door):
    def peak(samples):
        weights = np.zeros(samples.radiance.shape)
        weights[:, 7] = 1e30
        return weights

    session = pathlight.Session(door, learner=Own(peak), volumes=50, bins=64, **OPTIONS)
    session.render(spp=2)
    probabilities = session.field.probabilities
    assert np.allclose(probabilities[:, 7], 0.9 + 0.1 / 64, atol=1e-3)
    assert (probabilities > 0.1 / 64 * 0.99).all()


def test_radiance_is_taken_in_place_of_the_table_s(door):
    session = pathlight.Session(
        door, learner=Own(lambda s: np.full(s.radiance.shape, 3.5), returns="radiance"), volumes=50, bins=64, **OPTIONS
    )
    session.render(spp=2)
    assert (session.field.radiance == 3.5).all()


def nan_somewhere(samples):
    answer = np.ones(samples.radiance.shape)
    answer[3, 17] = np.nan
    return answer


def fail(samples):
    raise ZeroDivisionError("in the learner")


@pytest.mark.parametrize(
    "answer, error, text",
    [
        (nan_somewhere, pathlight.InputError, "probabilities of volume 3, cell 17: expected a finite number of at least 0, got nan"),
        (lambda s: -np.ones(s.radiance.shape), pathlight.InputError, "volume 0, cell 0: expected .* got -1"),
        (lambda s: np.full(s.radiance.shape, np.inf), pathlight.InputError, "got inf"),
        (lambda s: np.full(s.radiance.shape, 1e300), pathlight.InputError, "got inf"),
        (lambda s: s.radiance[:-1], pathlight.InputError, r"expected an array of shape \(50, 64\), got \(49, 64\)"),
        (lambda s: s.radiance.ravel(), pathlight.InputError, r"got \(3200,\)"),
        (lambda s: None, pathlight.InputError, "expected an array of shape"),
        (lambda s: "much", ValueError, "much"),
        (fail, ZeroDivisionError, "in the learner"),
    ],
)
@pytest.mark.filterwarnings("ignore:overflow")
def test_what_is_wrong_is_told_and_harms_no_film(door, answer, error, text):
    own = pathlight.Session(door, volumes=50, bins=64, **OPTIONS)
    session = pathlight.Session(door, learner=Own(answer), volumes=50, bins=64, **OPTIONS)
    for spp in (1, 2):
        with pytest.raises(error, match=text):
            session.render(spp=spp)
        own.render(spp=spp)
        assert session.passes == spp
        # The table's own probabilities stand.
        assert session.film().tobytes() == own.film().tobytes()


@pytest.mark.parametrize(
    "options, text",
    [
        (dict(method="default"), "does not learn"),
        (dict(field="lobes"), "expected --field table"),
    ],
)
def test_learners_are_for_tables_that_learn(door, options, text):
    with pytest.raises(pathlight.UsageError, match=text):
        pathlight.Session(door, learner=Own(lambda s: s.radiance), **{**OPTIONS, **options})
    with pytest.raises(pathlight.UsageError, match="'probabilities' or 'radiance'"):
        pathlight.Session(door, learner=Own(lambda s: s.radiance, returns="light"), **OPTIONS)


def test_a_learner_may_not_use_its_session(door):
    session = pathlight.Session(door, learner=Own(lambda s: session.film()), **OPTIONS)
    with pytest.raises(pathlight.UsageError, match="this session is in use"):
        session.render(spp=1)


ADVERSARIES = {
    "zeros": lambda s, r: np.zeros(s.radiance.shape),
    "one cell": lambda s, r: np.eye(s.radiance.shape[1])[r.integers(s.radiance.shape[1], size=len(s.radiance))] * 1e30,
    "darkest": lambda s, r: np.where(s.counts > 0, 0.0, 1.0),
    "noise": lambda s, r: 10.0 ** r.uniform(-30, 30, s.radiance.shape),
    "nan at times": lambda s, r: s.radiance * (np.nan if r.random() < 0.5 else 1.0),
    "wrong shape at times": lambda s, r: s.radiance[r.integers(2) :],
}


SEEDS = 128


def batch_means(scene, seeds, learner, **options):
    """Mean of the film of each seed."""
    means = []
    for seed in seeds:
        session = pathlight.Session(scene, seed=seed, learner=learner(seed), width=32, height=24, threads=1, **options)
        while session.passes < 8:
            try:
                session.render(spp=8)
            except pathlight.InputError:
                pass
        means.append(session.film().mean(dtype=np.float64))
    return np.array(means)


@pytest.fixture(scope="module")
def default_means(door):
    return batch_means(door, range(1001, 1001 + SEEDS), lambda seed: None, method="default", nee=False)


@pytest.mark.parametrize("name", ADVERSARIES)
def test_no_learner_moves_the_mean_of_the_picture(door, default_means, name):
    """Means of films by a learner and by default, without light samples: 128 seeds of each (1 to 128, 1001 to 1128), 768 pixels, 8 samples.
    Welch's statistic within 5: a false alarm has probability 1e-6 for each of six learners (Student's t of 254 degrees). Power: a bias of
    eight standard errors of the difference is found with probability 0.998, and these are below a tenth of the mean.
    """

    def learner(seed):
        random = np.random.default_rng(seed)
        return Own(lambda samples: ADVERSARIES[name](samples, random))

    means = batch_means(
        door, range(1, 1 + SEEDS), learner, method="reinforcement", guiding="always", nee=False, volumes=40, bins=64
    )
    error = np.hypot(means.std(ddof=1), default_means.std(ddof=1)) / np.sqrt(SEEDS)
    difference = means.mean() - default_means.mean()
    print(f"{name}: {difference / error:.2f} standard errors, each {error / default_means.mean():.4f} of the mean")
    assert abs(difference) < 5 * error
    assert 8 * error < 0.1 * default_means.mean()
