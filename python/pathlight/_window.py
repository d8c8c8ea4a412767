"""The window of the program: the module has none, so that it needs no display where it is installed."""

import os
import shlex
import shutil
import subprocess
import tempfile

from . import _pathlight

ERRORS = {2: _pathlight.UsageError, 3: _pathlight.InputError, 4: _pathlight.UnavailableError}  # by exit code


# Session.view()
def open_window(session, **options):
    program = os.environ.get("PATHLIGHT_PROGRAM") or shutil.which("pathlight")
    if not program:
        raise _pathlight.UnavailableError("view: no program pathlight on the PATH: PATHLIGHT_PROGRAM names it")
    with tempfile.TemporaryDirectory() as folder:
        words = shlex.split(session._view_command(folder, **options))
        ended = subprocess.run([program, *words[1:]], stderr=subprocess.PIPE, text=True)
    if ended.returncode != 0:
        raise ERRORS.get(ended.returncode, _pathlight.WorkError)(ended.stderr.strip() or f"view: exit code {ended.returncode}")
