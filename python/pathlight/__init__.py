"""Pathlight, a path tracer that learns where light comes from.

    import pathlight

    session = pathlight.Session(pathlight.Scene("cornell"), method="reinforcement")
    session.render(spp=64)
    film = session.film()  # (height, width, 3) float32, linear RGB

"""

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
from ._plots import plot_hemisphere

Field.plot = plot_hemisphere

__all__ = [
    "Error",
    "Field",
    "InputError",
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
