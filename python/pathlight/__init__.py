"""Pathlight, a path tracer that learns where light comes from.

    import pathlight

    session = pathlight.Session(pathlight.Scene("cornell"), method="reinforcement")
    session.render(spp=64)
    film = session.film()  # (height, width, 3) float32, linear RGB

"""

import os
import pathlib

from ._pathlight import Field, PathTracer, Samples, Scene, Session, compare, run, scenes
from ._pathlight import version as __version__

# Scenes come with an installed package; beside a build the program's own search finds those of the source.
_assets = pathlib.Path(__file__).parent / "assets"
if _assets.is_dir():
    os.environ.setdefault("PATHLIGHT_ASSETS", str(_assets))


class Error(Exception):
    """Every error of pathlight; str() is the program's message."""


class WorkError(Error, RuntimeError):
    """Failure during the work: a full disk, a lost device."""


class UsageError(Error, ValueError):
    """An option or argument is wrong."""


class InputError(Error, ValueError):
    """A file, an array or the answer of a learner is missing or invalid."""


class UnavailableError(Error, RuntimeError):
    """A back end, a device or the window is missing."""


class ThresholdError(Error, RuntimeError):
    """Another limit was reached before the target error."""


class Learner:
    """Learns in place of the table of a session. Any object with such a method may do so."""

    returns = "probabilities"  # of each volume up to a factor; or "radiance"

    def update(self, samples: Samples):
        """An array (volumes, cells) by the training samples since the last update."""
        raise NotImplementedError(f"{type(self).__name__}.update(samples)")


__all__ = [
    "Error",
    "Field",
    "InputError",
    "Learner",
    "PathTracer",
    "Samples",
    "Scene",
    "Session",
    "ThresholdError",
    "UnavailableError",
    "UsageError",
    "WorkError",
    "compare",
    "run",
    "scenes",
]
