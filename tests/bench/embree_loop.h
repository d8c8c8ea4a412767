// The peer of the benchmark: path tracing as one would write it with Embree's single-ray query, one path after the
// other. Same estimator, same random numbers, same film as the back end; the queries are Embree's fastest.
#pragma once

#include <memory>

#include "core/session/backend.h"

namespace pl::test {
class EmbreeScene;
}

namespace pl::benchmarks {

/// Traces one sample for every pixel of its own film per call.
class EmbreeLoop {
public:
    EmbreeLoop(const HostScene& scene, int width, int height, int threads);
    ~EmbreeLoop();

    PassCounters run_pass(const Camera& camera, const PathSettings& settings, std::uint32_t sample);

    /// Mean over pixels and channels of the film.
    double mean() const;

private:
    std::unique_ptr<test::EmbreeScene> embree_;
    SceneView scene_;
    HostArray<FilmPixel> pixels_;
    std::uint32_t width_;
    std::uint32_t height_;
    int threads_;
};

}  // namespace pl::benchmarks
