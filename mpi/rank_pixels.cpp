// The part of RankWork by which pixels go from rank to rank: films that are read or put back, shares that change, and what
// pixels have seen of lamps.
#include <algorithm>
#include <cstring>

#include "mpi/rank_work.h"

namespace pl {

/// Every rank gets the whole film, which has been gathered, so that any may render on from it.
void RankWork::write_pixels(const RankCommand& command, Payload& payload) {
    Film& film = films_[static_cast<std::size_t>(command.slot.index())];
    std::vector<FilmPixel> pixels(film.pixels);
    if (ranks_.rank() == 0)
        locally([&] {
            backend_->write_pixels(command.slot, command.first, payload.pixels);
            backend_->read_pixels(command.slot, 0, pixels);
        });
    ranks_.broadcast(std::as_writable_bytes(std::span(pixels)));
    if (ranks_.rank() != 0) locally([&] { backend_->write_pixels(command.slot, 0, pixels); });
    film = {.pixels = film.pixels, .shares = no_shares()};
}

void RankWork::gather_film(FilmSlot slot) {
    Film& film = films_[static_cast<std::size_t>(slot.index())];
    if (film.is_gathered) return;
    film.is_gathered = true;
    std::vector<FilmPixel> pixels;
    for (int rank = 1; rank < ranks_.size(); ++rank)
        for (const IndexRange& range : film.shares.shares_of(rank)) {
            pixels.resize(range.count());
            if (ranks_.rank() == rank) {
                locally([&] { backend_->read_pixels(slot, range.begin, pixels); });
                ranks_.send(0, std::as_bytes(std::span(pixels)));
            } else if (ranks_.rank() == 0) {
                ranks_.receive(rank, std::as_writable_bytes(std::span(pixels)));
                locally([&] { backend_->write_pixels(slot, range.begin, pixels); });
            }
        }
}

/// New shares by the times of the last pass; the pixels move with them. The many short blocks of a first pass are joined.
void RankWork::balance(FilmSlot slot, Film& film) {
    Shares next = no_shares();
    next.cover(film.pixels);
    if (next.blocks() == film.shares.blocks()) next = film.shares.balanced(seconds_of_all(film));
    if (next == film.shares) return;
    move_pixels(slot, film.shares, next);
    film.shares = std::move(next);
    film.seconds.assign(film.shares.blocks(), 0.0);
}

/// Of the last pass. [block][rank]
std::vector<double> RankWork::seconds_of_all(const Film& film) {
    const std::vector<Bytes> all = ranks_.exchange(std::as_bytes(std::span(film.seconds)));
    std::vector<double> seconds(film.seconds.size() * all.size());
    for (std::size_t rank = 0; rank < all.size(); ++rank)
        for (std::size_t block = 0; block < film.seconds.size(); ++block)
            std::memcpy(&seconds[block * all.size() + rank], all[rank].data() + block * sizeof(double),
                        sizeof(double));
    return seconds;
}

void RankWork::move_pixels(FilmSlot slot, const Shares& from, const Shares& to) {
    const int own = ranks_.rank();
    std::vector<FilmPixel> pixels;
    // In ascending order on both sides.
    const auto each_part = [&](const Shares& mine, const Shares& others, auto&& fn) {
        for (int other = 0; other < ranks_.size(); ++other) {
            if (other == own) continue;
            for (const IndexRange& range : mine.shares_of(own))
                for (const IndexRange& wanted : others.shares_of(other)) {
                    const IndexRange part = common_part(range, wanted);
                    if (part.empty()) continue;
                    pixels.resize(part.count());
                    fn(other, part);
                }
        }
    };
    each_part(from, to, [&](int other, IndexRange part) {
        locally([&] { backend_->read_pixels(slot, part.begin, pixels); });
        ranks_.send(other, std::as_bytes(std::span(pixels)));
    });
    each_part(to, from, [&](int other, IndexRange part) {
        ranks_.receive(other, std::as_writable_bytes(std::span(pixels)));
        locally([&] { backend_->write_pixels(slot, part.begin, pixels); });
    });
}

/// Borders of lamps are marked in the whole film by the back end that renders its first pixel: rank 0's, whose marks go to all.
void RankWork::mark_borders(const PassRequest& request, Film& film, Payload& payload) {
    std::vector<std::uint8_t> marks(film.pixels);
    std::vector<FilmPixel> pixels;
    if (ranks_.rank() == 0) {
        run_block(request, film, 0, {0, 1}, payload);
        pixels.resize(film.pixels);
        locally([&] { backend_->read_pixels(request.slot, 0, pixels); });
        std::ranges::transform(pixels, marks.begin(), [](const FilmPixel& pixel) {
            return static_cast<std::uint8_t>(pixel.emission.varies == EmissionSeen::kBorderMarked ? 1 : 0);
        });
    }
    ranks_.broadcast(std::as_writable_bytes(std::span(marks)));
    if (ranks_.rank() == 0) return;
    // Of a first pass in parts, whose marks are of the first look, only the first one is shared out by now.
    pixels.resize(film.pixels);
    locally([&] {
        backend_->read_pixels(request.slot, 0, pixels);
        for (std::size_t i = 0; i < pixels.size(); ++i)
            if (marks[i] != 0 && pixels[i].emission.varies == 0)
                pixels[i].emission.varies = EmissionSeen::kBorderMarked;
        backend_->write_pixels(request.slot, 0, pixels);
    });
}

/// The emission that all pixels have seen, to all ranks: pixels are compared with their neighbors, see look_for_emission().
void RankWork::share_emission(FilmSlot slot, const Film& film) {
    std::vector<FilmPixel> pixels(film.pixels);
    locally([&] { backend_->read_pixels(slot, 0, pixels); });
    std::vector<EmissionSeen> own;
    for (const IndexRange& range : film.shares.shares_of(ranks_.rank()))
        for (std::uint32_t i = range.begin; i < range.end; ++i) own.push_back(pixels[i].emission);
    const std::vector<Bytes> all = ranks_.exchange(std::as_bytes(std::span(own)));
    for (int rank = 0; rank < ranks_.size(); ++rank) {
        if (rank == ranks_.rank()) continue;
        const std::byte* next = all[static_cast<std::size_t>(rank)].data();
        for (const IndexRange& range : film.shares.shares_of(rank))
            for (std::uint32_t i = range.begin; i < range.end; ++i, next += sizeof(EmissionSeen))
                std::memcpy(&pixels[i].emission, next, sizeof(EmissionSeen));
    }
    locally([&] { backend_->write_pixels(slot, 0, pixels); });
}

}  // namespace pl
