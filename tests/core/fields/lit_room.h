// A scene with lit and unlit sides of surfaces.
#pragma once

#include "tests/support/scenes/shapes.h"

namespace pl::test {

/// A room with one wall that glows, and a free block that is lit from outside only.
inline SceneDescription lit_room() {
    SceneDescription scene;
    scene.materials = {gray(), gray()};
    scene.materials[1].emission = Vec3f{1.0f};
    add_box(scene, {-2, -1, -1}, {2, 1, 1}, true);
    scene.triangles[0].material = scene.triangles[1].material = 1;
    add_box(scene, {-0.5f, -0.6f, -0.3f}, {0.1f, 0.2f, 0.3f}, false);
    return scene;
}

}  // namespace pl::test
