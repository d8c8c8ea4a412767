#include "cpu/passes/film_store.h"

#include <algorithm>

#include "cpu/base/parallel_for.h"

namespace pl {
namespace {

/// Pixels per chunk when clearing or reading a film.
constexpr std::uint32_t kPixelChunk = 1u << 14;

}  // namespace

void FilmStore::reset(FilmSlot slot, int width, int height, int threads) {
    const std::size_t pixels = film_pixels(width, height);
    auto& film = films_.at(slot);
    require_film_memory(width, height, film.pixels.size());
    if (film.pixels.size() != pixels) film = {};  // frees the old memory before allocating the new
    film.width = width;
    film.height = height;
    film.pixels.resize(pixels);
    ChunkQueue queue(0, static_cast<std::uint32_t>(film.pixels.size()), kPixelChunk);
    parallel_for(threads, queue, [&](IndexRange range) {
        std::fill(film.pixels.begin() + range.begin, film.pixels.begin() + range.end, FilmPixel{});
    });
}

FilmReading FilmStore::read(FilmSlot slot, int threads) const { return read<false>(slot, threads); }

FilmReading FilmStore::read_halves(FilmSlot slot, int threads) const { return read<true>(slot, threads); }

std::vector<std::uint32_t> FilmStore::invalid_samples(FilmSlot slot) const {
    std::vector<std::uint32_t> counts;
    for (const FilmPixel& pixel : films_.existing(slot).pixels) counts.push_back(pixel.invalid);
    return counts;
}

void FilmStore::read_pixels(FilmSlot slot, std::uint32_t first, std::span<FilmPixel> pixels) const {
    std::copy_n(films_.existing(slot).pixels.begin() + first, pixels.size(), pixels.begin());
}

void FilmStore::write_pixels(FilmSlot slot, std::uint32_t first, std::span<const FilmPixel> pixels) {
    std::ranges::copy(pixels, films_.existing(slot).pixels.begin() + first);
}

/// Computes all pictures in one traversal of the film, which exceeds the cache.
template <bool kHalves>
FilmReading FilmStore::read(FilmSlot slot, int threads) const {
    const auto& film = films_.existing(slot);
    FilmReading reading{.width = film.width, .height = film.height, .mean = {}, .weight = 0, .invalid = 0};
    reading.mean.resize(film.pixels.size());
    std::vector<Vec3f>& first = reading.halves.mean[0];
    std::vector<Vec3f>& second = reading.halves.mean[1];
    if constexpr (kHalves) {
        first.resize(film.pixels.size());
        second.resize(film.pixels.size());
    }
    std::atomic<std::uint64_t> weight{0};
    std::atomic<std::uint64_t> second_weight{0};
    std::atomic<std::uint64_t> invalid{0};
    ChunkQueue queue(0, static_cast<std::uint32_t>(film.pixels.size()), kPixelChunk);
    parallel_for(threads, queue, [&](IndexRange range) {
        std::uint64_t chunk_weight = 0;
        std::uint64_t chunk_second_weight = 0;
        std::uint64_t chunk_invalid = 0;
        for (std::uint32_t i = range.begin; i < range.end; ++i) {
            const FilmPixel& pixel = film.pixels[i];
            reading.mean[i] = mean_or_nan(pixel);
            if constexpr (kHalves) {
                first[i] = half_mean(pixel, false);
                second[i] = half_mean(pixel, true);
                chunk_second_weight += pixel.second_weight;
            }
            chunk_weight += pixel.weight;
            chunk_invalid += pixel.invalid;
        }
        weight += chunk_weight;
        second_weight += chunk_second_weight;
        invalid += chunk_invalid;
    });
    reading.weight = weight;
    reading.invalid = invalid;
    if constexpr (kHalves) reading.halves.weights = {weight - second_weight, second_weight};
    return reading;
}

DisplayFrame FilmStore::show(FilmSlot slot, const FrameStyle& style, int threads) {
    const auto& film = films_.existing(slot);
    if (table_.curve() != style.curve) table_ = ToneTable(style.curve);
    const auto pixels = std::make_shared<std::vector<std::uint32_t>>(film.pixels.size());
    ChunkQueue queue(0, static_cast<std::uint32_t>(film.pixels.size()), kPixelChunk);
    parallel_for(threads, queue, [&](IndexRange range) {
        for (std::uint32_t i = range.begin; i < range.end; ++i)
            (*pixels)[i] = frame_pixel(mean_or_nan(film.pixels[i]), style, table_.view());
    });
    return {film.width, film.height, [pixels] { return pixels->data(); }};
}

float FilmStore::largest_value(FilmSlot slot, int threads) {
    const auto& film = films_.existing(slot);
    std::atomic<float> largest{0.0f};
    ChunkQueue queue(0, static_cast<std::uint32_t>(film.pixels.size()), kPixelChunk);
    parallel_for(threads, queue, [&](IndexRange range) {
        float own = 0.0f;
        for (std::uint32_t i = range.begin; i < range.end; ++i) own = max_of(own, range_value(film.pixels[i]));
        float seen = largest;
        while (seen < own && !largest.compare_exchange_weak(seen, own)) continue;
    });
    return largest;
}

}  // namespace pl
