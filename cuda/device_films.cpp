#include "cuda/device_films.h"

#include <cstring>

#include "cuda/runtime/launch.h"

namespace pl::cuda {

void DeviceFilms::reset(FilmSlot slot, int width, int height, const Stream& stream) {
    const std::size_t pixels = film_pixels(width, height);
    require_film_memory(width, height, pixels);  // on the host are only pictures of it
    auto& film = films_.at(slot);
    if (film.pixels.size() != pixels) {
        film = {};  // frees the old memory before allocating the new
        film.pixels = DeviceArray<FilmPixel>(pixels);
    }
    film.width = width;
    film.height = height;
    film.pixels.clear(stream);
}

void DeviceFilms::read_pixels(FilmSlot slot, std::uint32_t first, std::span<FilmPixel> pixels,
                              const Stream& stream) const {
    copy_to_host(pixels.data(), films_.existing(slot).pixels.data() + first, pixels.size_bytes(), stream);
    stream.wait("reading the pixels of a film");
}

void DeviceFilms::write_pixels(FilmSlot slot, std::uint32_t first, std::span<const FilmPixel> pixels,
                               const Stream& stream) {
    copy_to_device(films_.existing(slot).pixels.data() + first, pixels.data(), pixels.size_bytes(), stream);
    stream.wait("writing the pixels of a film");
}

FilmReading DeviceFilms::read(FilmSlot slot, const Stream& stream) const { return read(slot, 0, stream); }

FilmReading DeviceFilms::read_halves(FilmSlot slot, const Stream& stream) const { return read(slot, 2, stream); }

/// Downloads the whole film, 64 bytes per pixel: called only on user requests, so speed does not matter.
std::vector<std::uint32_t> DeviceFilms::invalid_samples(FilmSlot slot, const Stream& stream) const {
    auto& film = films_.existing(slot);
    std::vector<FilmPixel> pixels;
    film.pixels.download(pixels, stream);
    stream.wait("reading the invalid samples of a film");
    std::vector<std::uint32_t> counts;
    for (const FilmPixel& pixel : pixels) counts.push_back(pixel.invalid);
    return counts;
}

FilmReading DeviceFilms::read(FilmSlot slot, std::uint32_t halves, const Stream& stream) const {
    auto& film = films_.existing(slot);
    const auto pixels = static_cast<std::uint32_t>(film.pixels.size());
    const std::size_t values = std::size_t{pixels} * (1 + halves);
    if (means_.size() < values) means_ = DeviceArray<Vec3f>(values);
    if (totals_.size() == 0) totals_ = DeviceArray<FilmTotals>(1);
    const std::size_t bytes = values * sizeof(Vec3f);
    if (staging_.bytes() < bytes + sizeof(FilmTotals)) staging_ = PinnedMemory(bytes + sizeof(FilmTotals));

    totals_.clear(stream);
    const auto picture = [&](std::size_t i) { return Span<Vec3f>{means_.data() + i * pixels, pixels}; };
    launch(kReadFilm, one_thread_each(pixels), stream, "read_film", film.view(), picture(0), totals_.data());
    if (halves > 0)
        launch(kReadHalves, one_thread_each(pixels), stream, "read_halves", film.view(), picture(1), picture(2),
               &totals_.data()->second_weight);
    auto* staged = static_cast<std::byte*>(staging_.data());
    copy_to_host(staged, means_.data(), bytes, stream);
    copy_to_host(staged + bytes, totals_.data(), sizeof(FilmTotals), stream);
    stream.wait("reading a film");

    FilmTotals totals;
    std::memcpy(&totals, staged + bytes, sizeof totals);
    const auto* means = reinterpret_cast<const Vec3f*>(staged);
    FilmReading reading{.width = film.width,
                        .height = film.height,
                        .mean = {means, means + pixels},
                        .weight = totals.weight,
                        .invalid = totals.invalid};
    for (std::size_t half = 0; half < halves; ++half) {
        const auto* first = means + (half + 1) * pixels;
        reading.halves.mean[half].assign(first, first + pixels);
    }
    if (halves > 0) reading.halves.weights = {totals.weight - totals.second_weight, totals.second_weight};
    return reading;
}

DisplayFrame DeviceFilms::show(FilmSlot slot, const FrameStyle& style, const Stream& stream) {
    auto& film = films_.existing(slot);
    return frames_.start(film.view(), style, stream);
}

float DeviceFilms::largest_value(FilmSlot slot, const Stream& stream) {
    auto& film = films_.existing(slot);
    if (largest_.size() == 0) largest_ = DeviceArray<std::uint32_t>(1);
    if (staging_.bytes() < sizeof(float)) staging_ = PinnedMemory(sizeof(float));
    largest_.clear(stream);
    launch(kLargestValue, one_thread_each(static_cast<std::uint32_t>(film.pixels.size())), stream, "largest_value",
           film.view(), largest_.data());
    copy_to_host(staging_.data(), largest_.data(), sizeof(float), stream);
    stream.wait("looking for a film's largest value");
    float largest = 0.0f;
    std::memcpy(&largest, staging_.data(), sizeof largest);
    return largest;
}

}  // namespace pl::cuda
