import os
import pathlib
import shutil

import pytest

import pathlight


@pytest.fixture(scope="session")
def door():
    """Light comes through a gap: guiding pays."""
    return pathlight.Scene("door")


@pytest.fixture(scope="session")
def program():
    """The program of the same build, or an installed one, to compare with."""
    found = os.environ.get("PATHLIGHT_PROGRAM") or shutil.which("pathlight")
    if not found or not pathlib.Path(found).is_file():
        pytest.skip("no program pathlight: PATHLIGHT_PROGRAM names it")
    return found
