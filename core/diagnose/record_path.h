// A path with all its vertices.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/choice.h"
#include "core/kernel/base/math.h"
#include "core/kernel/geometry/ray.h"
#include "core/kernel/guiding/placement_view.h"
#include "core/session/pass_replay.h"

namespace pl::diagnose {

// One path of a picture with all its vertices, as data: for text, files and drawings of paths.

/// The technique by which a path finds light. Scattered directions have one of the last three.
enum class Technique : std::uint32_t {
    Camera,         ///< the camera ray meets it
    LightSampling,  ///< a light sample
    Bsdf,           ///< a direction sampled by the BSDF without its delta lobes
    Field,          ///< a direction sampled by the guiding field
    Delta,          ///< a direction of a delta lobe: mirror reflection or refraction
};

/// The event that ended a path.
enum class PathEnd : std::uint32_t {
    Escaped,        ///< the ray met no surface
    Absorbed,       ///< the surface reflects nothing
    Roulette,       ///< Russian roulette
    DepthLimit,     ///< PathSettings::max_depth
    ZeroDirection,  ///< the sampled direction has f cos = 0
};

}  // namespace pl::diagnose

namespace pl {

template <>
inline constexpr auto kChoices<diagnose::Technique> = std::to_array<ChoiceInfo<diagnose::Technique>>({
    {diagnose::Technique::Camera, "seen", "seen directly"},
    {diagnose::Technique::LightSampling, "light", "light samples"},
    {diagnose::Technique::Bsdf, "bsdf", "BSDF sampling"},
    {diagnose::Technique::Field, "field", "guided sampling"},
    {diagnose::Technique::Delta, "delta", "delta lobes"},
});

template <>
inline constexpr auto kChoices<diagnose::PathEnd> = std::to_array<ChoiceInfo<diagnose::PathEnd>>({
    {diagnose::PathEnd::Escaped, "escaped", "no surface is met"},
    {diagnose::PathEnd::Absorbed, "absorbed", "the surface reflects nothing"},
    {diagnose::PathEnd::Roulette, "roulette", "Russian roulette"},
    {diagnose::PathEnd::DepthLimit, "depth-limit", "the most vertices are reached"},
    {diagnose::PathEnd::ZeroDirection, "zero-direction", "the sampled direction reflects nothing"},
});

}  // namespace pl

namespace pl::diagnose {

inline constexpr std::size_t kTechniqueCount = kChoices<Technique>.size();

/// Emission that a path reached: of a surface or, where the path escaped, of the environment.
struct EmissionRecord {
    Vec3f radiance{0.0f};
    float weight =
        1.0f;  ///< MIS weight; 1 if the vertex before sampled no lights. Of an environment map, not of a constant one
    float light_pdf_sa = 0.0f;  ///< of light sampling at the vertex before, per steradian; 0 without it
    Vec3f contribution{0.0f};   ///< to the radiance of the pixel
};

/// A light sample at a vertex. Densities per steradian.
struct LightSampleRecord {
    Vec3f wi{0.0f};
    std::optional<Vec3f> position{};         ///< on the light; none if it is infinitely far away
    std::uint32_t primitive = kNoPrimitive;  ///< of the light, if it has one
    float pdf_sa = 0.0f;                     ///< of light sampling
    float scatter_pdf_sa = 0.0f;             ///< of scattering into the same direction
    float weight = 0.0f;                     ///< MIS weight
    bool is_visible = false;
    Vec3f unoccluded{0.0f};    ///< contribution if nothing occludes the light
    Vec3f contribution{0.0f};  ///< to the radiance of the pixel
};

/// Russian roulette at a vertex.
struct RouletteRecord {
    float estimate = 1.0f;              ///< contribution estimate, relative to the path's first vertex
    float survival_probability = 1.0f;  ///< 1 before roulette begins
    bool survives = true;
};

/// The direction that a path continues in from a vertex. Densities per steradian, 0 for delta lobes.
struct ScatterRecord {
    Technique technique = Technique::Bsdf;
    Vec3f wi{0.0f};
    float pdf_sa = 0.0f;        ///< of all techniques together: (1 - delta probability) (a p_bsdf + (1 - a) p_field)
    float bsdf_pdf_sa = 0.0f;   ///< p_bsdf
    float field_pdf_sa = 0.0f;  ///< p_field; 0 if no field serves the vertex
    Vec3f bsdf_cos{0.0f};       ///< f |cos theta_i|, 1/sr; 0 for delta lobes
    Vec3f throughput{1.0f};     ///< of the path, this direction included
};

struct VertexRecord {
    bool is_escape = false;  ///< no surface was met: of the members below only wo, throughput and emission are set
    Vec3f origin{0.0f};      ///< of the ray that ends here
    Vec3f wo{0.0f};          ///< unit, towards `origin`
    Vec3f throughput{1.0f};  ///< of the path on arrival
    Vec3f position{0.0f};
    Vec3f geometric_normal{0.0f};  ///< on the side of wo, like the next one
    Vec3f shading_normal{0.0f};
    float distance = 0.0f;  ///< along the ray, scene units
    std::uint32_t primitive = kNoPrimitive;
    std::uint32_t material = 0;
    Vec3f albedo{0.0f};
    float delta_probability = 0.0f;   ///< of choosing among delta lobes alone
    std::int32_t volume = kNoVolume;  ///< that serves the vertex
    float bsdf_fraction = 1.0f;       ///< a, the probability of BSDF sampling; 1 if no field serves the vertex
    EmissionRecord emission{};
    std::optional<LightSampleRecord> light{};  ///< none if no light was sampled, or none that can contribute
    std::optional<RouletteRecord> roulette{};  ///< none where the path ended before
    std::optional<ScatterRecord> scattered{};  ///< none at the last vertex
    /// Target of the training sample that this vertex completes for the direction that led to it: rms() of radiance, see ExpectedSarsa. None
    /// if the pass trains nothing, or by another target.
    std::optional<float> target{};

    /// To the radiance of the pixel, from here alone.
    Vec3f contribution() const { return emission.contribution + (light ? light->contribution : Vec3f{0.0f}); }
};

struct PathRecord {
    std::uint32_t pixel = 0;  ///< row-major
    /// That the path's random numbers are drawn by, see PassSchedule::sample_of().
    std::uint32_t sample = 0;
    bool is_guided = false;
    Vec3f eye{0.0f};             ///< origin of the camera ray
    Vec3f radiance{0.0f};        ///< of the pixel by this path, with the bits of its pass
    std::uint32_t segments = 0;  ///< rays traced, without shadow rays
    std::uint32_t shadow_rays = 0;
    std::vector<VertexRecord>
        vertices{};                   ///< from the camera on: as many scattering events before a vertex as its index
    PathEnd end = PathEnd::Absorbed;  ///< of the last vertex
};

// One path of a past pass, or of the next one, traced again with a record of all its vertices.

/// View of the field of these passes; empty for methods without one. Valid as long as `passes`.
AnyFieldView field_of(PassReplay& passes);

/// Runs the kernel's own steps on the CPU, in any thread. `field` is field_of(passes), `pass` the number of the pass within the
/// picture. The record has the bits of the picture's path if the field is that which the pass sampled from: always if the method
/// does not learn, else for pass PassReplay::samples after Session::advance_to_path().
PathRecord record_path(const PassReplay& passes, const AnyFieldView& field, std::uint32_t pixel, std::uint32_t pass);

}  // namespace pl::diagnose
