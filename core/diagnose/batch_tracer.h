// Path tracing batch by batch, with all vertices as rows, and directions that a sampler from outside gives for many vertices at once.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/kernel/film/film_view.h"
#include "core/kernel/integrator/path.h"
#include "core/kernel/scene/camera.h"
#include "core/scene/scene_storage.h"

namespace pl::diagnose {

/// A vertex from which a path may be scattered. Directions are unit vectors, away from the surface.
struct PathVertex {
    std::uint32_t pixel = 0;  ///< row-major
    std::uint32_t sample = 0;
    std::uint32_t depth = 0;  ///< vertices of the path before this one
    Vec3f position{0.0f};
    Vec3f normal{0.0f};      ///< shading normal, on the side of `outgoing`
    Vec3f outgoing{0.0f};    ///< towards the vertex before, or the camera
    Vec3f albedo{0.0f};      ///< of the BSDF
    Vec2f uniforms{0.0f};    ///< uniform numbers in [0,1) to sample a direction by
    Vec3f throughput{1.0f};  ///< of the path on arrival
    Vec3f direction{0.0f};   ///< in which the path continues; 0 where it ends
    float pdf = 0.0f;        ///< of `direction` per steradian, of sampler and BSDF together; 0 of delta lobes
    /// The path's estimate of the radiance from `direction`, in which emission has its MIS weight; 0 where the path ends, and in channels
    /// that the path no longer carries.
    Vec3f incident{0.0f};
};

/// Samples directions at vertices. Called by one thread, between the work of a batch; may throw.
struct DirectionSampler {
    std::function<std::vector<Vec3f>(std::span<const PathVertex>)> sample;
    /// Densities of directions, one for each vertex, per steradian.
    std::function<std::vector<float>(std::span<const PathVertex>, std::span<const Vec3f>)> pdf;
    float bsdf_fraction = 0.5f;  ///< probability of sampling the BSDF instead, in [0, 1]
};

/// The film of a pinhole or thin-lens camera by paths of `default`, or by the mixture of a sampler and the BSDF, without further rays for the
/// borders of lamps.
class BatchTracer {
public:
    /// `path` has the seed and the settings of roulette and light samples; its sequences are set by trace().
    BatchTracer(std::shared_ptr<const HostScene> scene, const Camera& camera, int width, int height,
                const PathSettings& path);

    /// Adds a sample to every pixel, with the numbers of the method `default`. Returns the vertices, by depth, then by pixel.
    std::vector<PathVertex> trace();
    /// Adds a sample to every pixel, with directions by a sampler, which may have learned from the passes before: its
    /// random numbers are independent of the numbers of the passes before.
    std::vector<PathVertex> trace(const DirectionSampler& sampler);

    std::span<const FilmPixel> film() const { return film_; }
    int width() const { return width_; }
    int height() const { return height_; }
    std::uint32_t passes() const { return passes_; }

private:
    std::vector<PathVertex> trace_pass(const PathSettings& path, const DirectionSampler* sampler);

    std::shared_ptr<const HostScene> scene_;
    Camera camera_;
    int width_;
    int height_;
    PathSettings path_;
    std::vector<FilmPixel> film_;
    std::uint32_t passes_ = 0;
};

}  // namespace pl::diagnose
