// The emissive triangles of a scene as LightLanes read them: made once per scene.
#pragma once

#include <vector>

#include "cpu/lane_kernels.h"

namespace pl {

class LightTable {
public:
    LightTable() = default;
    explicit LightTable(const SceneView& scene) {
        records_.reserve(scene.lights.count);
        for (std::uint32_t light = 0; light < scene.lights.count; ++light)
            records_.push_back(record_of(scene, scene.lights[light]));
    }

    bool empty() const { return records_.empty(); }
    LightRows rows(float power) const {
        return {records_.data(), static_cast<std::uint32_t>(records_.size()), power};
    }

private:
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
};

}  // namespace pl
