"""The package as a whole: its types and its errors."""

import ast
import pathlib
import subprocess
import sys

import pytest

import pathlight


def test_the_stub_has_every_public_name():
    stub = ast.parse((pathlib.Path(pathlight.__file__).parent / "_pathlight.pyi").read_text())
    known = {node.name: node for node in stub.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    for name in pathlight.__all__:
        bound = getattr(pathlight, name)
        if bound.__module__ == "pathlight":
            continue  # written in Python
        assert name in known
        members = {node.name for node in known[name].body if isinstance(node, ast.FunctionDef)}
        assert {member for member in dir(bound) if not member.startswith("_")} <= members or not isinstance(bound, type)


@pytest.mark.parametrize("kind", ["WorkError", "UsageError", "InputError", "UnavailableError", "ThresholdError"])
def test_errors_have_one_base(kind):
    error = getattr(pathlight, kind)
    assert issubclass(error, pathlight.Error) and issubclass(error, (ValueError, RuntimeError))
    assert repr(error) == f"<class 'pathlight.{kind}'>"


def test_the_module_needs_no_window_and_no_job():
    """The program of the same build may have both, and objects in common with the module."""
    loaded = "import pathlight; print(open('/proc/self/maps').read())"
    libraries = subprocess.run([sys.executable, "-c", loaded], stdout=subprocess.PIPE, text=True, check=True).stdout
    assert "_pathlight" in libraries and "libSDL" not in libraries and "libmpi" not in libraries
