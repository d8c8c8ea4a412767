// A glTF file of more triangles than a scene file may have.
#pragma once

#include "tests/support/files/gltf_maker.h"

namespace pl::test {

/// A triangle, and ten thousand instances of a band of 8000 triangles.
inline GltfMaker forest() {
    GltfMaker file;
    file.triangle({{"name", "ground"}});
    std::vector<float> band, moves;
    for (int i = 0; i < 8002; ++i)
        band.insert(band.end(), {0.001f * static_cast<float>(i), static_cast<float>(i % 2), 0.0f});
    for (int i = 0; i < 10000; ++i)
        moves.insert(moves.end(), {static_cast<float>(10 * (i % 100)), 0.0f, static_cast<float>(i / 100)});
    const int mesh = file.mesh({{"attributes", {{"POSITION", file.vec3(band)}}}, {"mode", 5}, {"material", 0}});
    file.node({{"mesh", mesh},
               {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", file.vec3(moves)}}}}}}}});
    return file;
}

}  // namespace pl::test
