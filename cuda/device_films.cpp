#include "cuda/device_films.h"

#include <cstring>

#include "cuda/runtime/launch.h"

namespace pl::cuda {

void DeviceFilms::reset(FilmSlot slot, int width, int height, const Stream& stream) {
    const std::size_t pixels = film_pixels(width, height);
    auto& film = films_.at(slot);
    if (film.pixels.size() != pixels) {
        film = {};  // the old memory goes before the new one comes
        film.pixels = DeviceArray<FilmPixel>(pixels);
    }
    film.width = width;
    film.height = height;
    film.pixels.clear(stream);
}

FilmReading DeviceFilms::read(FilmSlot slot, const Stream& stream) const {
    auto& film = films_.existing(slot);
    const auto pixels = static_cast<std::uint32_t>(film.pixels.size());
    if (means_.size() < pixels) means_ = DeviceArray<Vec3f>(pixels);
    if (totals_.size() == 0) totals_ = DeviceArray<FilmTotals>(1);
    const std::size_t bytes = pixels * sizeof(Vec3f);
    if (staging_.bytes() < bytes + sizeof(FilmTotals)) staging_ = PinnedMemory(bytes + sizeof(FilmTotals));

    totals_.clear(stream);
    launch(kReadFilm, blocks_for(pixels), stream, "read_film", film.view(), Span<Vec3f>{means_.data(), pixels},
           totals_.data());
    auto* staged = static_cast<std::byte*>(staging_.data());
    copy_to_host(staged, means_.data(), bytes, stream);
    copy_to_host(staged + bytes, totals_.data(), sizeof(FilmTotals), stream);
    stream.wait("reading a film");

    FilmTotals totals;
    std::memcpy(&totals, staged + bytes, sizeof totals);
    const auto* means = reinterpret_cast<const Vec3f*>(staged);
    return {.width = film.width,
            .height = film.height,
            .mean = {means, means + pixels},
            .samples = totals.samples,
            .invalid = totals.invalid};
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
    launch(kLargestValue, blocks_for(static_cast<std::uint32_t>(film.pixels.size())), stream, "largest_value",
           film.view(), largest_.data());
    copy_to_host(staging_.data(), largest_.data(), sizeof(float), stream);
    stream.wait("looking for a film's largest value");
    float largest = 0.0f;
    std::memcpy(&largest, staging_.data(), sizeof largest);
    return largest;
}

}  // namespace pl::cuda
