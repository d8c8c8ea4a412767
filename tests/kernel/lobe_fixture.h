// Surfaces that do more than Lambert's law, one at a time.
#pragma once

#include "core/kernel/shading/bsdf.h"
#include "core/scene/directional_albedo.h"
#include "tests/kernel/shapes.h"

namespace pl::test {

/// A horizontal surface at the origin with one kind of lobes.
class LobeSurface {
public:
    /// `albedo` is that of what is guided, see pack_scene().
    explicit LobeSurface(const SurfaceLobes& lobes, Vec3f albedo = Vec3f{0.0f}) : lobes_(lobes), albedo_(albedo) {
        switch (lobes.kind) {
        case SurfaceKind::Diffuse: break;
        case SurfaceKind::Conductor: table_ = lossless_albedo(); break;
        case SurfaceKind::Plastic: table_ = coat_albedo(lobes.ior); break;
        case SurfaceKind::Dielectric: {
            table_ = glass_albedo(lobes.ior);
            const std::vector<float> inside = glass_albedo(1.0f / lobes.ior);
            table_.insert(table_.end(), inside.begin(), inside.end());
            break;
        }
        }
    }

    static SurfacePoint point(bool front = true) {
        SurfacePoint point;
        point.front = front;
        return point;
    }
    LayeredBsdf from(Vec3f wo, bool front = true) const {
        return {point(front), wo, albedo_, lobes_, {table_.data(), static_cast<std::uint32_t>(table_.size())}};
    }

private:
    SurfaceLobes lobes_;
    Vec3f albedo_;
    std::vector<float> table_;
};

/// Unit direction in the xz plane.
inline Vec3f tilted(float cos_theta) { return {std::sqrt(1.0f - cos_theta * cos_theta), 0.0f, cos_theta}; }

}  // namespace pl::test
