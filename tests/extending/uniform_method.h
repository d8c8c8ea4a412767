// A method that samples directions uniformly over the hemisphere: the example of docs/extending.md.
#pragma once

#include "core/kernel/methods/default.h"

namespace pl::test {

struct UniformMethod : DefaultMethod {
    using DefaultMethod::pdf_sa;
    using DefaultMethod::sample_direction;

    static constexpr float kPdf = 0.5f * kInvPi;  // per steradian

    PL_HD DirectionSample sample_direction(const Vertex&, const SurfacePoint& surface,
                                           const ScatterUniforms& numbers) const {
        const float z = numbers.u.y;
        const float radius = std::sqrt(max_of(0.0f, 1.0f - z * z));
        const float angle = 2.0f * kPi * numbers.u.z;
        const Vec3f local{radius * std::cos(angle), radius * std::sin(angle), z};
        const Vec3f wi = make_frame(surface.shading_normal).to_world(local);
        return {wi, kPdf, lambert_pdf_sa(surface, wi)};
    }
    PL_HD float pdf_sa(const Vertex&, const SurfacePoint& surface, Vec3f wi) const {
        return glm::dot(wi, surface.shading_normal) > 0.0f ? kPdf : 0.0f;
    }
};
static_assert(Method<UniformMethod>);

struct Uniform {
    static constexpr MethodInfo kInfo{.name = "uniform", .label = "Uniform", .summary = "Uniform directions."};
};

}  // namespace pl::test
