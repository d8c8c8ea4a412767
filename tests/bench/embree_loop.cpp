#include "tests/bench/embree_loop.h"

#include "core/kernel/integrator/trace_path.h"
#include "core/kernel/methods/default.h"
#include "cpu/base/parallel_for.h"
#include "tests/support/peers/embree_scene.h"

namespace pl::benchmarks {
namespace {

template <FeatureSet F>
void trace_pixels(const SceneView& scene, const test::EmbreeScene& queries, const Camera& camera,
                  const PathSettings& settings, std::uint32_t sample, const FilmView& film, IndexRange range,
                  PassCounters& counters) {
    for (std::uint32_t pixel = range.begin; pixel < range.end; ++pixel) {
        auto state = begin_path<F, DefaultMethod>(camera, settings, {film.width, film.height, sample}, pixel);
        trace_path<F>(PathContext<DefaultMethod>{scene, DefaultMethod{}, settings}, queries, state, counters.path);
        accumulate(film, pixel, state.radiance, sample);
        ++counters.paths;
    }
}

}  // namespace

EmbreeLoop::EmbreeLoop(const HostScene& scene, int width, int height, int threads)
    : embree_(std::make_unique<test::EmbreeScene>(scene)), scene_(scene.view()),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
      width_(static_cast<std::uint32_t>(width)), height_(static_cast<std::uint32_t>(height)), threads_(threads) {}

EmbreeLoop::~EmbreeLoop() = default;

PassCounters EmbreeLoop::run_pass(const Camera& camera, const PathSettings& settings, std::uint32_t sample) {
    constexpr std::uint32_t kChunk = 256;
    constexpr FeatureSet kPlain{};
    constexpr FeatureSet kLights = FeatureSet{}.with(Feature::NextEventEstimation);
    const FilmView film{view_of(pixels_), width_, height_};
    ChunkQueue queue(0, film.pixels.count, kChunk);
    std::vector<PassCounters> counters(static_cast<std::size_t>(threads_));
    run_on_threads(threads_, [&](int thread) {
        PassCounters own;
        for (IndexRange range = queue.claim(); !range.empty(); range = queue.claim()) {
            const auto trace = settings.next_event != 0 ? trace_pixels<kLights> : trace_pixels<kPlain>;
            trace(scene_, *embree_, camera, settings, sample, film, range, own);
        }
        counters[static_cast<std::size_t>(thread)] = own;
    });
    PassCounters total;
    for (const PassCounters& one : counters) total += one;
    return total;
}

double EmbreeLoop::mean() const {
    double sum = 0.0;
    for (const FilmPixel& pixel : pixels_) {
        const Vec3f mean = mean_radiance(pixel);
        sum += (static_cast<double>(mean.x) + mean.y + mean.z) / 3.0;
    }
    return sum / static_cast<double>(pixels_.size());
}

}  // namespace pl::benchmarks
