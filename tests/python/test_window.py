"""session.view(): the program's window on the scene, the settings and the learned field of a session."""

import shlex
import subprocess

import pytest

import pathlight
from test_scene import arrays

SMALL = dict(width=48, height=32, method="reinforcement", guiding="always", nee=False, volumes=40, bins=64)
CHECKS = """
0 wait learned >= 65
0 wait shown_spp >= 1
0 expect scene ~ {scene}
0 expect method == reinforcement
0 expect nee == no
1 quit
"""


@pytest.fixture
def window(monkeypatch, program, tmp_path):
    """A program that has a window, which opens without a display."""
    monkeypatch.setenv("PATHLIGHT_PROGRAM", program)
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    script = tmp_path / "quit.script"
    script.write_text("0 quit\n")
    if subprocess.run([program, "view", "--size=16x16", "--software", "--script", script]).returncode == 4:
        pytest.skip("this program has no window")


def test_the_window_opens_and_is_closed(window, door, tmp_path):
    script = tmp_path / "look.script"
    for scene, name in ((door, "door"), (arrays(), "scene.json")):
        script.write_text(CHECKS.format(scene=name))
        session = pathlight.Session(scene, **SMALL)
        session.render(spp=64)
        assert session.view(script=script, software=True, window=(640, 480)) is None
        assert session.passes == 64


def test_errors_of_the_window_are_exceptions(window, door, tmp_path):
    session = pathlight.Session(door, **SMALL)
    with pytest.raises(pathlight.UsageError, match="--sript"):
        session.view(sript="a")
    script = tmp_path / "wrong.script"
    script.write_text("0 expect method == default\n0 quit\n")
    with pytest.raises(pathlight.WorkError, match="method"):
        session.view(script=script, software=True)


def test_without_the_program_there_is_no_window(door, monkeypatch):
    monkeypatch.delenv("PATHLIGHT_PROGRAM", raising=False)
    monkeypatch.setenv("PATH", "/nowhere")
    with pytest.raises(pathlight.UnavailableError, match="PATHLIGHT_PROGRAM"):
        pathlight.Session(door, **SMALL).view()


@pytest.mark.parametrize("is_from_arrays", [False, True])
def test_the_window_continues_from_what_the_session_has_learned(program, tmp_path, is_from_arrays):
    scene = arrays() if is_from_arrays else pathlight.Scene("door", parameters={"opening": 30})
    session = pathlight.Session(scene, seed=5, **SMALL)
    session.render(spp=3)
    words = shlex.split(session._view_command(tmp_path))
    assert words[:2] == ["pathlight", "view"] and ("opening=30" in " ".join(words)) != is_from_arrays
    # The same words for a picture: passes after a loaded field have the bits of the session's own continuation from it.
    picture = tmp_path / "film.pfm"
    subprocess.run([program, "render", *words[2:], "-o", picture, "--spp=2", "-q"], check=True)
    session.field.save(tmp_path / "copy.field")
    assert (tmp_path / "copy.field").read_bytes() == (tmp_path / "learned.field").read_bytes()
    again = pathlight.Session(scene, seed=5, load_field=tmp_path / "copy.field", **SMALL)
    again.render(spp=2)
    again.save(tmp_path / "again.pfm")
    assert picture.read_bytes() == (tmp_path / "again.pfm").read_bytes()
