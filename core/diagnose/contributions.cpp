#include "core/diagnose/contributions.h"

namespace pl::diagnose {
namespace {

FoundBy found_by(Technique technique) {
    switch (technique) {
    case Technique::Bsdf: return FoundBy::Bsdf;
    case Technique::Field: return FoundBy::Field;
    case Technique::Delta: return FoundBy::Delta;
    }
    return FoundBy::Bsdf;
}

/// The technique of the direction that leads to a vertex.
FoundBy arrival_at(const PathRecord& path, std::uint32_t index) {
    return index == 0 ? FoundBy::Camera : found_by(path.vertices[index - 1].scattered->technique);
}

}  // namespace

const std::array<FoundByInfo, kFoundByCount>& all_found_by() {
    static constexpr std::array<FoundByInfo, kFoundByCount> kAll{{
        {FoundBy::Camera, "seen", "seen directly"},
        {FoundBy::LightSampling, "light", "light samples"},
        {FoundBy::Bsdf, "bsdf", "BSDF sampling"},
        {FoundBy::Field, "field", "guided sampling"},
        {FoundBy::Delta, "delta", "delta lobes"},
    }};
    return kAll;
}

std::vector<Contribution> contributions_of(const PathRecord& path) {
    std::vector<Contribution> all;
    const auto add = [&](Contribution contribution, Vec3f radiance) {
        contribution.light = static_cast<double>(luminance(radiance));
        if (contribution.light != 0.0) all.push_back(contribution);
    };
    for (std::uint32_t i = 0; i < path.vertices.size(); ++i) {
        const VertexRecord& vertex = path.vertices[i];
        if (!is_black(vertex.emission.contribution))
            add({.found_by = arrival_at(path, i), .bounces = i, .is_distant = vertex.is_escape},
                vertex.emission.contribution);
        if (vertex.light)
            add({.found_by = FoundBy::LightSampling,
                 .bounces = i + 1,
                 .is_distant = !vertex.light->position.has_value()},
                vertex.light->contribution);
    }
    return all;
}

}  // namespace pl::diagnose
