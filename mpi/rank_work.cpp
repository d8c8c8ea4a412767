#include "mpi/rank_work.h"

#include <algorithm>
#include <cstring>

#include "core/base/timer.h"
#include "core/kernel/integrator/lamp_borders.h"
#include "core/scene/pack_scene.h"
#include "mpi/pending.h"

namespace pl {
namespace {

/// What a rank tells of a command.
struct Outcome {
    std::int32_t error_kind = 0;  ///< 0: it has succeeded
    std::array<char, 404> message{};
    PassCounters counters{};
};

/// Rank 0's array to all.
template <class From, class To>
void spread(Communicator& ranks, const From& from, To& to) {
    if (ranks.rank() == 0) {
        From copy = from;
        broadcast_array(ranks, copy);
    } else {
        broadcast_array(ranks, to);
    }
}

/// The scalars of a scene.
struct SceneScalars {
    float light_power = 0.0f;
    Vec3f environment{0.0f};
    std::uint32_t has_holes = 0;
    FarLights far_lights;
    float far_probability = 0.0f;
};

bool is_power_of_two(std::uint32_t n) { return n >= 2 && (n & (n - 1)) == 0; }

/// Whether emission is refined after the samples of a pass, see camera_emission.h.
bool refines_emission(const PassRequest& request, const HostScene& scene) {
    return request.slot.view == View::Beauty && request.use != SampleUse::Trial && has_visible_emission(scene.view());
}

}  // namespace

PassCounters report(Communicator& ranks, const std::optional<Error>& failure, const PassCounters& own) {
    Outcome outcome;
    outcome.counters = own;
    if (failure) {
        outcome.error_kind = static_cast<std::int32_t>(failure->kind());
        std::string_view(failure->what())
            .substr(0, outcome.message.size() - 1)
            .copy(outcome.message.data(), outcome.message.size() - 1);
    }
    const Bytes all = ranks.gather(bytes_of_value(outcome));
    PassCounters total;
    if (ranks.rank() != 0) return total;
    for (int rank = 0; rank < ranks.size(); ++rank) {
        Outcome other;
        std::memcpy(&other, all.data() + static_cast<std::size_t>(rank) * sizeof other, sizeof other);
        total += other.counters;
        if (other.error_kind == 0) continue;
        const std::string message = other.message.data();
        throw Error(static_cast<ErrorKind>(other.error_kind),
                    rank == 0 ? message : ranks.name_of(rank) + ": " + message);
    }
    return total;
}

PassCounters RankWork::lead(RankCommand command, Payload& payload) {
    ranks_.broadcast(bytes_of_value(command));
    return run(command, payload);
}

void RankWork::follow(const RankCommand& command) {
    Payload payload;
    run(command, payload);
}

/// Calls of this rank's back end. A failure is kept for report(), so that all ranks come to the end of the command.
template <class Fn>
void RankWork::locally(Fn&& fn) {
    if (failure_) return;
    try {
        fn();
    } catch (const Error& error) {
        failure_ = error;
    } catch (const std::bad_alloc&) {
        failure_ = Error(ErrorKind::Runtime, "out of memory");
    } catch (const std::exception& error) {
        failure_ = Error(ErrorKind::Runtime, error.what());
    }
}

PassCounters RankWork::run(const RankCommand& command, Payload& payload) {
    failure_.reset();
    switch (command.order) {
    case Order::Scene: take_scene(payload); break;
    case Order::Volumes: take_volumes(payload); break;
    case Order::Field: take_field(command.method, payload); break;
    case Order::ResetFilm: reset_film(command); break;
    case Order::WritePixels: write_pixels(command, payload); break;
    case Order::GatherFilm: gather_film(command.slot); break;
    case Order::Pass: run_pass(command.pass, payload); break;
    case Order::Precompute: precompute(command.probes, command.end_probe, payload); break;
    case Order::Update:
        sum_pending(ranks_, *backend_, command.method);
        locally([&] { backend_->update_field(command.method); });
        break;
    case Order::Collect:
        sum_pending(ranks_, *backend_, command.method);
        if (ranks_.rank() != 0) clear_pending(*backend_, command.method);
        break;
    case Order::End:
    case Order::Call:
    case Order::Open:
    case Order::Close: break;  // of whole back ends: follow_rank_0()
    }
    return report(ranks_, failure_, payload.counters);
}

void RankWork::take_scene(Payload& payload) {
    auto received = std::make_shared<HostScene>();
    const HostScene none;
    const HostScene& sent = payload.scene ? *payload.scene : none;
    SceneScalars scalars{sent.light_power, sent.environment, sent.has_holes, sent.far_lights, sent.far_probability};
    zip(sent, *received, [&](const auto& from, auto& to) { spread(ranks_, from, to); });
    ranks_.broadcast(bytes_of_value(scalars));
    received->light_power = scalars.light_power;
    received->environment = scalars.environment;
    received->has_holes = scalars.has_holes;
    received->far_lights = scalars.far_lights;
    received->far_probability = scalars.far_probability;
    scene_ = payload.scene ? payload.scene : std::move(received);
    locally([&] { backend_->upload_scene(scene_); });
}

void RankWork::take_volumes(Payload& payload) {
    ranks_.broadcast(bytes_of_value(payload.shape));
    HostVolumes received;
    const HostVolumes none;
    zip(payload.volumes ? *payload.volumes : none, received,
        [&](const auto& from, auto& to) { spread(ranks_, from, to); });
    if (!payload.volumes) payload.volumes = std::make_shared<const HostVolumes>(std::move(received));
    probes_ = static_cast<std::uint32_t>(payload.volumes->normals.size()) *
              static_cast<std::uint32_t>(payload.shape.cells.count());
    locally([&] { backend_->upload_volumes(payload.volumes, payload.shape); });
}

/// Its pending sums stay with rank 0: they count once.
void RankWork::take_field(MethodId method, Payload& payload) {
    std::visit(
        [&](auto& arrays) { zip(arrays, arrays, [&](const auto&, auto& array) { broadcast_array(ranks_, array); }); },
        payload.field);
    locally([&] {
        backend_->upload_field(method, std::move(payload.field));
        if (ranks_.rank() != 0) clear_pending(*backend_, method);
    });
}

void RankWork::reset_film(const RankCommand& command) {
    films_[static_cast<std::size_t>(command.slot.index())] = {
        .pixels = static_cast<std::uint32_t>(command.width * command.height), .shares = Shares(ranks_.size())};
    locally([&] { backend_->reset_film(command.slot, command.width, command.height); });
}

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
    film = {.pixels = film.pixels, .shares = Shares(ranks_.size())};
}

void RankWork::gather_film(FilmSlot slot) {
    Film& film = films_[static_cast<std::size_t>(slot.index())];
    if (film.is_gathered) return;
    film.is_gathered = true;
    std::vector<FilmPixel> pixels;
    for (int rank = 1; rank < ranks_.size(); ++rank)
        for (const PixelRange& range : film.shares.shares_of(rank)) {
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

void RankWork::run_pass(const PassRequest& request, Payload& payload) {
    Film& film = films_[static_cast<std::size_t>(request.slot.index())];
    const std::uint32_t count = request.subset.count(film.pixels);
    PixelRange numbers{request.first_pixel, std::min(request.end_pixel, count)};
    film.shares.cover(numbers.end == count ? film.pixels : numbers.end * request.subset.step);
    film.seconds.resize(film.shares.blocks());
    film.is_gathered = false;
    const bool is_whole = request.first_pixel == 0 && request.subset.step == 1 && numbers.end == count;
    if (is_whole && is_power_of_two(request.passes)) balance(request.slot, film);
    if (scene_ && refines_emission(request, *scene_)) {
        if (is_power_of_two(request.passes - 1)) share_emission(request.slot, film);
        if (request.passes == kMarkingPass && request.first_pixel == 0 && !numbers.empty()) {
            mark_borders(request, film, payload);
            ++numbers.begin;
        }
    }
    bool is_first = true;
    for (std::size_t block = 0; block < film.shares.blocks(); ++block) {
        const PixelRange part =
            common_part(numbers, numbers_within(request.subset, film.shares.block(block), film.pixels));
        if (part.empty()) continue;
        if (!is_first && !goes_on(payload.stop)) break;
        is_first = false;
        run_block(request, film, block, part, payload);
    }
}

void RankWork::run_block(const PassRequest& request, Film& film, std::size_t block, PixelRange numbers,
                         Payload& payload) {
    const PixelRange own = film.shares.share(block, ranks_.rank());
    const PixelRange part = common_part(numbers, numbers_within(request.subset, own, film.pixels));
    if (part.empty()) return;
    const Stopwatch watch;
    PassRequest local = request;
    local.first_pixel = part.begin;
    local.end_pixel = part.end;
    local.most_passes = 1;
    local.stop = nullptr;
    locally([&] { payload.counters += backend_->run_pass(local); });
    film.seconds[block] = watch.seconds();
}

/// Probes are numbered through all volumes and cost much the same everywhere.
void RankWork::precompute(const PrecomputeRequest& request, std::uint32_t end_probe, Payload& payload) {
    Shares shares(ranks_.size());
    shares.cover(std::min(end_probe, probes_));
    bool is_first = true;
    for (std::size_t block = 0; block < shares.blocks(); ++block) {
        const PixelRange rest{request.first_probe, probes_};
        if (common_part(rest, shares.block(block)).empty()) continue;
        if (!is_first && !goes_on(payload.stop)) break;
        is_first = false;
        const PixelRange part = common_part(rest, shares.share(block, ranks_.rank()));
        if (part.empty()) continue;
        PrecomputeRequest local = request;
        local.first_probe = part.begin;
        local.stop = nullptr;
        locally([&] { payload.counters += backend_->precompute_part(local, part.end); });
    }
}

/// Whether rank 0 has no reason to stop.
bool RankWork::goes_on(const StopFlag* stop) {
    std::uint32_t word = stop != nullptr && *stop ? 0 : 1;
    ranks_.broadcast(bytes_of_value(word));
    return word != 0;
}

/// New shares by the times of the last pass; the pixels move with them. The many short blocks of a first pass are joined.
void RankWork::balance(FilmSlot slot, Film& film) {
    Shares next(ranks_.size());
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
            for (const PixelRange& range : mine.shares_of(own))
                for (const PixelRange& wanted : others.shares_of(other)) {
                    const PixelRange part = common_part(range, wanted);
                    if (part.empty()) continue;
                    pixels.resize(part.count());
                    fn(other, part);
                }
        }
    };
    each_part(from, to, [&](int other, PixelRange part) {
        locally([&] { backend_->read_pixels(slot, part.begin, pixels); });
        ranks_.send(other, std::as_bytes(std::span(pixels)));
    });
    each_part(to, from, [&](int other, PixelRange part) {
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
    for (const PixelRange& range : film.shares.shares_of(ranks_.rank())) {
        pixels.resize(range.count());
        locally([&] {
            backend_->read_pixels(request.slot, range.begin, pixels);
            for (std::uint32_t i = 0; i < range.count(); ++i)
                if (marks[range.begin + i] != 0 && pixels[i].emission.varies == 0)
                    pixels[i].emission.varies = EmissionSeen::kBorderMarked;
            backend_->write_pixels(request.slot, range.begin, pixels);
        });
    }
}

/// The emission that all pixels have seen, to all ranks: pixels are compared with their neighbors, see look_for_emission().
void RankWork::share_emission(FilmSlot slot, const Film& film) {
    std::vector<FilmPixel> pixels(film.pixels);
    locally([&] { backend_->read_pixels(slot, 0, pixels); });
    std::vector<EmissionSeen> own;
    for (const PixelRange& range : film.shares.shares_of(ranks_.rank()))
        for (std::uint32_t i = range.begin; i < range.end; ++i) own.push_back(pixels[i].emission);
    const std::vector<Bytes> all = ranks_.exchange(std::as_bytes(std::span(own)));
    for (int rank = 0; rank < ranks_.size(); ++rank) {
        if (rank == ranks_.rank()) continue;
        const std::byte* next = all[static_cast<std::size_t>(rank)].data();
        for (const PixelRange& range : film.shares.shares_of(rank))
            for (std::uint32_t i = range.begin; i < range.end; ++i, next += sizeof(EmissionSeen))
                std::memcpy(&pixels[i].emission, next, sizeof(EmissionSeen));
    }
    locally([&] { backend_->write_pixels(slot, 0, pixels); });
}

}  // namespace pl
