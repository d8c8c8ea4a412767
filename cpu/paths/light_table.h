// The emissive triangles of a scene as LightLanes read them: made once per scene.
#pragma once

#include <bit>
#include <vector>

#include "cpu/base/lane_kernels.h"

namespace pl {

/// `learned`: see LightTreeRows.
inline LightTreeRows rows_of(const LightTree& tree, const float* learned) {
    return {tree.nodes.data, tree.of_light.data, tree.clusters.data, tree.clusters.count, learned};
}

class LightTable {
public:
    LightTable() = default;
    explicit LightTable(const SceneView& scene) {
        records_.reserve(scene.lights.count);
        triangles_ = scene.direct_triangles();
        emitters_.resize((triangles_ + kWordBits - 1) / kWordBits);
        for (const Light& light : scene.lights) {
            records_.push_back(record_of(scene, light));
            emitters_[light.primitive / kWordBits].bits |= std::uint64_t{1} << (light.primitive % kWordBits);
        }
        for (std::size_t i = 1; i < emitters_.size(); ++i)
            emitters_[i].before = emitters_[i - 1].before + std::popcount(emitters_[i - 1].bits);
    }

    bool empty() const { return records_.empty(); }
    /// Whether a primitive, which may be kNoPrimitive, is a light, and its number then: see pl::light_of(). In memory that the caches
    /// hold, since all hits are asked.
    bool is_light(std::uint32_t primitive) const {
        return primitive < triangles_ &&
               ((emitters_[primitive / kWordBits].bits >> (primitive % kWordBits)) & 1u) != 0;
    }
    std::uint32_t light_of(std::uint32_t primitive) const {
        const Emitters& word = emitters_[primitive / kWordBits];
        const std::uint64_t below = word.bits & ((std::uint64_t{1} << (primitive % kWordBits)) - 1);
        return static_cast<std::uint32_t>(word.before + std::popcount(below));
    }
    LightRows rows(float power) const {
        return {records_.data(), static_cast<std::uint32_t>(records_.size()), power};
    }

private:
    static constexpr std::uint32_t kWordBits = 64;

    /// kWordBits triangles: a bit for each that is a light, and the number of lights before them.
    struct Emitters {
        std::uint64_t bits = 0;
        std::int32_t before = 0;
    };

    static LightRecord record_of(const SceneView& scene, const Light& light) {
        const Triangle& triangle = scene.triangles[light.primitive];
        const TrianglePlane& plane = scene.planes[light.primitive];
        const Material& material = scene.materials[triangle.material];
        return {.corners = {scene.positions[triangle.v0], scene.positions[triangle.v1], scene.positions[triangle.v2]},
                .normal = plane.normal,
                .position_error = plane.position_error,
                .emission = emitted_radiance(material, true),
                .back_emission = emitted_radiance(material, false),
                .primitive = light.primitive,
                .cumulative_probability = light.cumulative_probability};
    }

    std::vector<LightRecord> records_;
    std::vector<Emitters> emitters_;
    std::uint32_t triangles_ = 0;  ///< triangles of instances emit nothing
};

}  // namespace pl
