#include "cuda/kernels/kernels.h"
#include "cuda/kernels/lane.cuh"
#include "cuda/runtime/launch.h"

namespace pl::cuda {
namespace {

/// Separate from the tracing kernels, which thereby need no double-precision arithmetic (slow on most devices), and
/// so that neighboring threads write neighboring pixels.
__global__ void __launch_bounds__(kThreadsPerBlock)
    add_samples(const __grid_constant__ FilmView film, const __grid_constant__ LaunchSamples samples) {
    const std::uint32_t i = thread_number();
    VarianceSums sums;
    if (i < samples.radiance.count)
        (void)add_sample(film, samples.first + i, samples.radiance[i], samples.pass, samples.measure, sums);
    if (!samples.measure.is_any) return;
    VarianceSums::each(samples.counters->variance, sums,
                       [](std::uint64_t& total, std::uint64_t sum) { add_up(total, sum); });
}

__global__ void __launch_bounds__(kThreadsPerBlock)
    set_samples(const __grid_constant__ FilmView film, const __grid_constant__ LaunchSamples samples) {
    const std::uint32_t i = thread_number();
    if (i < samples.radiance.count) (void)replace_sample(film, samples.first + i, samples.radiance[i], samples.pass);
}

__global__ void __launch_bounds__(kThreadsPerBlock)
    read_film(const __grid_constant__ FilmView film, Span<Vec3f> means, FilmTotals* totals) {
    const std::uint32_t i = thread_number();
    FilmTotals own;
    if (i < film.pixels.count) {
        const FilmPixel& pixel = film.pixels[i];
        means[i] = mean_or_nan(pixel);
        own = {pixel.weight, pixel.invalid};
    }
    add_up(totals->weight, own.weight);
    add_up(totals->invalid, own.invalid);
}

__global__ void __launch_bounds__(kThreadsPerBlock)
    read_halves(const __grid_constant__ FilmView film, Span<Vec3f> first, Span<Vec3f> second,
                std::uint64_t* second_weight) {
    const std::uint32_t i = thread_number();
    std::uint64_t own = 0;
    if (i < film.pixels.count) {
        const FilmPixel& pixel = film.pixels[i];
        first[i] = half_mean(pixel, false);
        second[i] = half_mean(pixel, true);
        own = pixel.second_weight;
    }
    add_up(*second_weight, own);
}

__global__ void __launch_bounds__(kThreadsPerBlock)
    show_film(const __grid_constant__ FilmView film, const __grid_constant__ FrameStyle style,
              const __grid_constant__ ToneCodes codes, Span<std::uint32_t> pixels) {
    const std::uint32_t i = thread_number();
    if (i < pixels.count) pixels[i] = frame_pixel(mean_or_nan(film.pixels[i]), style, codes);
}

__global__ void __launch_bounds__(kThreadsPerBlock)
    largest_value(const __grid_constant__ FilmView film, std::uint32_t* bits) {
    const std::uint32_t i = thread_number();
    raise_to(*bits, i < film.pixels.count ? std::bit_cast<std::uint32_t>(range_value(film.pixels[i])) : 0u);
}

}  // namespace

constinit const AddSamplesKernel kAddSamples = add_samples;
constinit const AddSamplesKernel kSetSamples = set_samples;
constinit const ReadFilmKernel kReadFilm = read_film;
constinit const ReadHalvesKernel kReadHalves = read_halves;
constinit const ShowFilmKernel kShowFilm = show_film;
constinit const LargestValueKernel kLargestValue = largest_value;

}  // namespace pl::cuda
