#include "mpi/rank_work.h"

#include <algorithm>
#include <cstring>

#include "core/base/timer.h"
#include "core/kernel/integrator/lamp_borders.h"
#include "core/scene/pack_scene.h"
#include "mpi/pending.h"

namespace pl {
namespace {

/// The result of a command on one rank.
struct Outcome {
    std::int32_t error_kind = 0;  ///< 0: it has succeeded
    std::array<char, 508> message{};
    PassCounters counters{};
};

bool is_power_of_two(std::uint32_t n) { return n >= 2 && (n & (n - 1)) == 0; }

/// Whether emission is refined after the samples of a pass, see camera_emission.h.
bool refines_emission(const PassRequest& request, const HostScene& scene) {
    return request.slot.view == View::Beauty && has_visible_emission(scene.view());
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
    case Order::Precompute: precompute(command.probes, payload); break;
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
    SceneScalars scalars = sent;
    zip(sent, *received, [&](const auto& from, auto& to) { broadcast_array(ranks_, from, to); });
    ranks_.broadcast(bytes_of_value(scalars));
    static_cast<SceneScalars&>(*received) = scalars;
    scene_ = payload.scene ? payload.scene : std::move(received);
    locally([&] { backend_->upload_scene(scene_); });
}

void RankWork::take_volumes(Payload& payload) {
    ranks_.broadcast(bytes_of_value(payload.shape));
    HostVolumes received;
    const HostVolumes none;
    zip(payload.volumes ? *payload.volumes : none, received,
        [&](const auto& from, auto& to) { broadcast_array(ranks_, from, to); });
    if (!payload.volumes) payload.volumes = std::make_shared<const HostVolumes>(std::move(received));
    probes_ = static_cast<std::uint32_t>(payload.volumes->normals.size()) *
              static_cast<std::uint32_t>(payload.shape.cells.count());
    locally([&] { backend_->upload_volumes(payload.volumes, payload.shape); });
}

/// Its pending sums stay with rank 0: they count once.
void RankWork::take_field(MethodId method, Payload& payload) {
    Representation representation = representation_of(payload.field);
    ranks_.broadcast(bytes_of_value(representation));
    if (ranks_.rank() != 0) clear_to(payload.field, representation);
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
        .pixels = static_cast<std::uint32_t>(command.width * command.height), .shares = no_shares()};
    locally([&] { backend_->reset_film(command.slot, command.width, command.height); });
}

void RankWork::run_pass(const PassRequest& request, Payload& payload) {
    Film& film = films_[static_cast<std::size_t>(request.slot.index())];
    IndexRange pixels{request.first_pixel, std::min(request.end_pixel, film.pixels)};
    film.shares.cover(pixels.end);
    film.seconds.resize(film.shares.blocks());
    film.is_gathered = false;
    const bool is_whole = pixels == IndexRange{0, film.pixels};
    if (is_whole && is_power_of_two(request.passes)) balance(request.slot, film);
    if (scene_ && refines_emission(request, *scene_)) {
        const std::uint32_t looks = request.emission_context({}).looks();
        if (is_power_of_two(looks - 1)) share_emission(request.slot, film);
        if (looks == kMarkingLook && request.first_pixel == 0 && !pixels.empty()) {
            mark_borders(request, film, payload);
            ++pixels.begin;
        }
    }
    bool is_first = true;
    for (std::size_t block = 0; block < film.shares.blocks(); ++block) {
        const IndexRange part = common_part(pixels, film.shares.block(block));
        if (part.empty()) continue;
        if (!is_first && !goes_on(payload.stop)) break;
        is_first = false;
        run_block(request, film, block, part, payload);
    }
}

void RankWork::run_block(const PassRequest& request, Film& film, std::size_t block, IndexRange pixels,
                         Payload& payload) {
    const IndexRange part = common_part(pixels, film.shares.share(block, ranks_.rank()));
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
void RankWork::precompute(const PrecomputeRequest& request, Payload& payload) {
    Shares shares = no_shares();
    const IndexRange wanted{request.first_probe, std::min(request.end_probe, probes_)};
    shares.cover(wanted.end);
    bool is_first = true;
    for (std::size_t block = 0; block < shares.blocks(); ++block) {
        if (common_part(wanted, shares.block(block)).empty()) continue;
        if (!is_first && !goes_on(payload.stop)) break;
        is_first = false;
        const IndexRange part = common_part(wanted, shares.share(block, ranks_.rank()));
        if (part.empty()) continue;
        PrecomputeRequest local = request;
        local.first_probe = part.begin;
        local.end_probe = part.end;
        local.stop = nullptr;
        locally([&] { payload.counters += backend_->precompute(local); });
    }
}

/// Whether rank 0 has no reason to stop.
bool RankWork::goes_on(const StopFlag* stop) {
    std::uint32_t word = stop != nullptr && *stop ? 0 : 1;
    ranks_.broadcast(bytes_of_value(word));
    return word != 0;
}

}  // namespace pl
