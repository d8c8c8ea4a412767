// The arguments of a pass, the source of each thread's paths, and the two kinds of paths: camera paths of a picture, and probes that fill
// the precomputed map before rendering.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>

#include "core/kernel/film/sample_variance.h"
#include "core/kernel/integrator/path.h"
#include "core/kernel/integrator/probe.h"
#include "core/kernel/integrator/steps.h"
#include "core/session/backend.h"
#include "cpu/base/parallel_for.h"
#include "cpu/paths/light_table.h"

namespace pl {

/// Paths per claim. A thread finishes every path that it claims.
inline constexpr std::uint32_t kPathChunk = 256;

/// The start of a path.
struct PathStart {
    std::uint32_t number = 0;
    Vec4f u{0.0f};          ///< of vertex 0
    Vec3f direction{0.0f};  ///< of the camera ray; only if StartKey::pinhole is set
};

/// The arguments of Rng::draw that all paths of a pass have in common at vertex 0.
struct StartKey {
    std::uint64_t seed = 0;
    Stream stream = Stream::Picture;
    Purpose purpose = Purpose::Pixel;
    std::uint32_t sample = 0;
    const Camera* pinhole = nullptr;  ///< of which camera rays are made for all paths of a chunk
    PixelGrid grid{};
};

/// Claims chunks of the shared queue for one thread.
class PathSource {
public:
    PathSource(ChunkQueue& queue, const StartKey& key) : queue_(queue), key_(key) {}

    /// Finds the start of the next path. Returns false at the end of the queue.
    bool next(PathStart& start) {
        if (chunk_.empty() && !claim()) return false;
        const std::uint32_t index = chunk_.begin - first_;
        start.number = chunk_.begin++;
        start.u = uniforms_[index / kGroupSize].get(index % kGroupSize);
        start.direction = directions_[index / kGroupSize].get(index % kGroupSize);
        return true;
    }

private:
    static constexpr std::uint32_t kGroups = group_count(kPathChunk);

    bool claim() {
        chunk_ = queue_.claim();
        if (chunk_.empty()) return false;
        first_ = chunk_.begin;
        for (std::uint32_t i = 0; i < kPathChunk; ++i) {
            counters_[i / kGroupSize].pixel[i % kGroupSize] = first_ + i;
            counters_[i / kGroupSize].sample[i % kGroupSize] = key_.sample;
        }
        kernels_.draw({key_.seed, key_.stream, key_.purpose}, counters_, uniforms_, kGroups);
        if (key_.pinhole != nullptr)
            kernels_.find_camera_directions(*key_.pinhole, key_.grid, counters_, uniforms_, directions_, kGroups);
        return true;
    }

    ChunkQueue& queue_;
    StartKey key_;
    LaneKernels kernels_ = best_lane_kernels();
    IndexRange chunk_;
    std::uint32_t first_ = 0;
    CounterGroup counters_[kGroups];
    UniformGroup uniforms_[kGroups];
    VectorGroup directions_[kGroups];
};

/// Arguments common to all passes.
struct PassSetup {
    SceneView scene;
    const LightTable* lights = nullptr;  ///< of the scene; without them lights are sampled path by path
    PathSettings path;
    IndexRange paths{0, kToTheLast};  ///< numbers of the paths to trace, clamped to the paths of the pass
    const StopFlag* stop = nullptr;
    int threads = 1;
    std::uint32_t batch_paths = 1024;

    /// Chunks of the paths to trace; the pass has `count` paths.
    ChunkQueue chunks(std::uint32_t count) const {
        return ChunkQueue(paths.begin, std::min(paths.end, count), kPathChunk, stop);
    }
};

/// A set of paths numbered from 0: creates their first rays and stores their radiance. start_key() decides their random
/// numbers at vertex 0; finish() returns true if the sample is valid; prefetch() asks for the memory that finish() needs, for
/// PathState::pixel of the path.
template <class W, FeatureSet F, class M>
concept PathWork = requires(const W& work, const PathSettings& path, const PathStart& start,
                            const PathState<F, M>& state, PassCounters& counters) {
    { work.count() } -> std::same_as<std::uint32_t>;
    { work.start_key(path) } -> std::same_as<StartKey>;
    { work.begin(start) } -> std::same_as<PathState<F, M>>;
    { work.prefetch(start.number) } -> std::same_as<void>;
    { work.finish(state, counters) } -> std::same_as<bool>;
};

/// One path per pixel; adds its radiance to a film.
template <FeatureSet F, class M>
struct PictureWork {
    Camera camera;
    std::uint32_t sample = 0;
    FilmView film;
    VarianceMeasure measure{};

    std::uint32_t count() const { return film.pixels.count; }
    StartKey start_key(const PathSettings& path) const {
        return {.seed = path.seed,
                .stream = path.stream,
                .purpose = Purpose::Pixel,
                .sample = sequence_of(sample),
                .pinhole = is_pinhole() ? &camera : nullptr,
                .grid = grid()};
    }
    PathState<F, M> begin(const PathStart& start) const {
        const std::uint32_t pixel = start.number;
        prefetch(pixel);  // films exceed the cache
        if (is_pinhole())
            return begin_path<F, M>(Ray{.origin = camera.eye, .direction = start.direction}, grid(), pixel);
        return begin_path<F, M>(camera, grid(), pixel, start.u);
    }
    void prefetch(std::uint32_t pixel) const { __builtin_prefetch(&film.pixels[pixel], 1); }
    bool finish(const PathState<F, M>& state, PassCounters& counters) const {
        return add_sample(film, state.pixel, state.radiance, sample, measure, counters.variance);
    }

private:
    bool is_pinhole() const { return !F.has(Feature::ThinLens) || !(camera.aperture_radius > 0.0f); }
    PixelGrid grid() const { return {film.width, film.height, sample}; }
};

/// One probe per cell of every volume; adds its radiance to a table.
template <FeatureSet F>
struct ProbeWork {
    TableView field;
    ProbeStratum stratum;

    std::uint32_t count() const { return probe_count(field); }
    StartKey start_key(const PathSettings& path) const {
        return {.seed = path.seed, .stream = path.stream, .purpose = Purpose::Probe, .sample = stratum.index};
    }
    PathState<F, ProbeMethod> begin(const PathStart& start) const {
        return begin_probe<F>(field, start.number, stratum, start.u);
    }
    void prefetch(std::uint32_t /*probe*/) const {}
    bool finish(const PathState<F, ProbeMethod>& state, PassCounters& counters) const {
        finish_probe(field, state, counters.path.method);
        return is_valid_radiance(state.radiance);
    }
};

}  // namespace pl
