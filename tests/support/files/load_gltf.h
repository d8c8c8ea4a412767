// Scenes of glTF files that tests make.
#pragma once

#include <string>

#include "core/io/load_scene.h"
#include "tests/support/files/gltf_maker.h"
#include "tests/support/files/input_error.h"
#include "tests/support/files/temporary_folder.h"

namespace pl::test {

/// Read from s.gltf, which may hold the bytes of a .glb.
inline SceneDescription load_gltf(const std::string& bytes, const LoadSettings& asked = {}) {
    const TemporaryFolder folder;
    return load_scene(folder.write("s.gltf", bytes).string(), "", asked);
}
inline SceneDescription load_gltf(const GltfMaker& file, const LoadSettings& asked = {}) {
    return load_gltf(file.text(), asked);
}

/// The message by which it is refused.
inline std::string gltf_refusal(const std::string& bytes, const LoadSettings& asked = {}) {
    return input_error([&] { load_gltf(bytes, asked); });
}
inline std::string gltf_refusal(const GltfMaker& file, const LoadSettings& asked = {}) {
    return gltf_refusal(file.text(), asked);
}

}  // namespace pl::test
