"""The window of the program: the module has none, so that it needs no display where it is installed."""

import os
import shlex
import shutil
import subprocess
import tempfile

from . import InputError, UnavailableError, UsageError, WorkError

ERRORS = {2: UsageError, 3: InputError, 4: UnavailableError}  # by exit code


# Session.view()
def open_window(session, **options):
    program = os.environ.get("PATHLIGHT_PROGRAM") or shutil.which("pathlight")
    if not program:
        raise UnavailableError("view: no program pathlight on the PATH: PATHLIGHT_PROGRAM names it")
    with tempfile.TemporaryDirectory() as folder:
        words = shlex.split(session._view_command(folder, **options))
        ended = subprocess.run([program, *words[1:]], stderr=subprocess.PIPE, text=True)
    if ended.returncode != 0:
        raise ERRORS.get(ended.returncode, WorkError)(ended.stderr.strip() or f"view: exit code {ended.returncode}")
