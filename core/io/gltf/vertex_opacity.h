// Opacities of the vertices of glTF primitives, which multiply those of materials.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/io/gltf/gltf_file.h"
#include "core/io/gltf/surfaces.h"

namespace pl {

/// Those of the vertices of a primitive, in [0, 1].
struct OpacityRange {
    float least = 1.0f;
    float most = 1.0f;
};

/// The renderer knows one opacity for each material: primitives whose vertices have the same one get a copy of their material.
class VertexOpacities {
public:
    VertexOpacities(GltfFile& file, std::vector<GltfSurface>& surfaces, SceneDescription& scene)
        : file_(file), surfaces_(surfaces), scene_(scene) {}

    /// The surface of a primitive at `at` whose vertices have these opacities. Adds it, with its material, if there is none such. Opacities
    /// that cannot be shown are noted.
    std::uint32_t surface_with(std::uint32_t surface, const OpacityRange& range, const std::string& at);

private:
    std::uint32_t scaled(std::uint32_t surface, float opacity);
    std::string free_name(const std::string& name, float opacity);

    GltfFile& file_;
    std::vector<GltfSurface>& surfaces_;
    SceneDescription& scene_;
    std::map<std::pair<std::uint32_t, float>, std::uint32_t> known_;  ///< by surface and opacity
    std::set<std::string> names_;                                     ///< of all materials
};

}  // namespace pl
