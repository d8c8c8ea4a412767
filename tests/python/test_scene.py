"""Scenes: opened by name and file, with parameters, and made of arrays."""

import numpy as np
import pytest

import pathlight


def test_scenes_by_name_and_their_parts():
    assert "cornell" in pathlight.scenes()
    scene = pathlight.Scene("cornell")
    assert scene.camera["eye"] and scene.materials
    assert scene.vertices.dtype == np.float32 and scene.vertices.shape[1] == 3
    assert scene.triangles.max() < len(scene.vertices)


def test_a_parameter_moves_the_scene():
    name, value = next(iter(pathlight.Scene("door").parameters.items()))
    moved = pathlight.Scene("door", parameters={name: 0.5 * value})
    assert moved.parameters[name] == pytest.approx(0.5 * value)


@pytest.mark.parametrize(
    "make, error, text",
    [
        (lambda: pathlight.Scene("cornel"), pathlight.InputError, "cornell"),
        (lambda: pathlight.Scene("missing.obj"), pathlight.InputError, "missing.obj"),
        (lambda: pathlight.Scene("door", parameters={"gap": 1}), pathlight.UsageError, "gap"),
        (lambda: pathlight.Scene("door", up_axis="w"), pathlight.UsageError, "got 'w'"),
    ],
)
def test_errors_have_the_words_of_the_program(make, error, text):
    with pytest.raises(error) as caught:
        make()
    assert text in str(caught.value)
    assert isinstance(caught.value, (pathlight.Error, ValueError))


FLOOR_AND_LAMP = dict(
    vertices=[[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1], [-1, 2, -1], [1, 2, -1], [1, 2, 1], [-1, 2, 1]],
    triangles=[[0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7]],
    materials={"floor": {"albedo": [0.5, 0.5, 0.5]}, "lamp": {"emission": [1, 2, 3]}},
    material_of=[0, 0, 1, 1],
    camera={"eye": [0, 1.9, 0], "target": [0, 0, 0], "up": [0, 0, 1], "fov_deg": 2},
)


def arrays(**changes):
    parts = {**FLOOR_AND_LAMP, **changes}
    return pathlight.Scene.from_arrays(
        np.array(parts["vertices"], np.float32),
        np.array(parts["triangles"], np.uint32),
        materials=parts["materials"],
        material_of=np.array(parts["material_of"], np.uint32),
        camera=parts["camera"],
    )


def test_a_scene_of_arrays_is_lit_by_its_lamp():
    session = pathlight.Session(arrays(), width=8, height=8)
    session.render(spp=64)
    # The floor sees the square lamp at twice its half side: configuration factor 0.2395 of two facing squares at their middles.
    mean = session.film().mean(axis=(0, 1))
    assert mean / np.array([1, 2, 3]) == pytest.approx(0.5 * 0.2395, rel=0.05)


@pytest.mark.parametrize(
    "changes, text",
    [
        ({"triangles": [[0, 1, 9]] * 4}, "9"),
        ({"material_of": [0, 0, 1]}, "material_of"),
        ({"materials": {"floor": {"albdo": [1, 1, 1]}}, "material_of": [0] * 4}, "albedo"),
        ({"camera": {"eye": [0, 0, 0], "target": [0, 0, 0]}}, "camera"),
    ],
)
def test_invalid_arrays_are_refused(changes, text):
    with pytest.raises(pathlight.InputError) as caught:
        arrays(**changes)
    assert text in str(caught.value)
