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

__all__ = [
    "Error",
    "Field",
    "InputError",
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
