"""Pathlight, a path tracer that learns where light comes from.

    import pathlight

    session = pathlight.Session(pathlight.Scene("cornell"), method="reinforcement")
    session.render(spp=64)
    film = session.film()  # (height, width, 3) float32, linear RGB

"""

import os
import pathlib

from ._pathlight import (
    Error,
    Field,
    InputError,
    PathTracer,
    Samples,
    Scene,
    Session,
    ThresholdError,
    UnavailableError,
    UsageError,
    WorkError,
    __version__,
    compare,
    run,
    scenes,
)

# Scenes come with an installed package; beside a build the program's own search finds those of the source.
_assets = pathlib.Path(__file__).parent / "assets"
if _assets.is_dir():
    os.environ.setdefault("PATHLIGHT_ASSETS", str(_assets))


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
