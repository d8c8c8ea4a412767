"""Every notebook runs, in small."""

import json
import pathlib

import pytest


matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("Agg")

FOLDER = pathlib.Path(__file__).parents[2] / "docs" / "notebooks"
SMALL = {
    "reinforcement.ipynb": "size, passes, long_run = 24, (1, 2), 4",
    "unbiased.ipynb": "pictures, size, spp, film_seeds = 50, 16, 1, 3",
    "network.ipynb": "size, spp, seeds, reference_spp = 16, 2, 2, 4",
    "compare.ipynb": "size, seeds, passes, reference_spp = 16, 2, (1, 2), 4",
}


def test_all_notebooks_are_known():
    assert {path.name for path in FOLDER.glob("*.ipynb")} == set(SMALL)


@pytest.mark.parametrize("name", SMALL)
def test_a_notebook_runs(name):
    if name == "network.ipynb":
        pytest.importorskip("torch")
    cells = json.loads((FOLDER / name).read_text())["cells"]
    sources = ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]
    names = SMALL[name].split(" = ")[0]
    assert sources[0].startswith(names + " = ")  # the sizes alone
    values = {}
    for source in [SMALL[name], *sources[1:]]:
        exec(compile(source, name, "exec"), values)
    matplotlib.pyplot.close("all")
    assert (FOLDER / name).stat().st_size < 450_000
