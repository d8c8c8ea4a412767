// One material of an MTL file as written, before its interpretation by mtl.h.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "core/kernel/shading/surface_lobes.h"

namespace pl {

/// Of -s and -o: texture coordinates times `scale` plus `offset` are coordinates in the image, as in Blender.
struct UvScale {
    glm::vec2 scale{1.0f};
    glm::vec2 offset{0.0f};

    friend bool operator==(const UvScale&, const UvScale&) = default;
};

/// A `map_` statement.
struct MtlMap {
    std::string name{};  ///< of the image file; empty: no image
    bool clamps = false;
    float strength = 1.0f;  ///< of -bm: factor of the slopes of normals
    UvScale uvs{};
    int line = 0;

    explicit operator bool() const { return !name.empty(); }
};

/// Checked values: colors at least 0, reflectances at most 1, numbers finite and in the ranges below.
struct MtlEntry {
    std::string name;
    int line = 0;
    std::optional<glm::vec3> kd, ke, ks, tf;
    std::optional<float> ns;          ///< at least 0
    std::optional<float> ni;          ///< within [kLeastIor, kMostIor]
    std::optional<float> d;           ///< in [0, 1]
    std::optional<float> tr;          ///< in [0, 1]; read_mtl() has made `d` of it
    std::optional<float> pr, pm, pc;  ///< in [0, 1]
    std::optional<int> illum;
    MtlMap map_kd, map_ke, map_pr, map_ns, map_d;
    MtlMap norm, bump;  ///< normals; normals or heights
    bool two_sided = false;
    std::optional<SurfaceKind> surface;       ///< Pl_surface
    std::optional<float> roughness, own_ior;  ///< Pl_roughness, Pl_ior
};

// Arguments of `map_Kd` and other map statements: options, then the name of an image.

struct ParsedMap {
    MtlMap map;                            ///< empty if there is no name
    std::vector<std::string> unsupported;  ///< options with values that would change the picture
};

/// The name is the rest after the options, with blanks or in quotes.
ParsedMap parse_map(std::string_view arguments);

}  // namespace pl
