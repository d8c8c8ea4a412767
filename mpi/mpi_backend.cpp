#include "mpi/mpi_backend.h"

#include <array>
#include <atomic>
#include <map>
#include <optional>

#include "mpi/rank_work.h"

namespace pl {
namespace {

/// A rank's back end; its kind is told to rank 0 as the message of an error if it is another one.
std::shared_ptr<ExactBackend> open_backend(Communicator& ranks, const RankBackendFactory& make,
                                           const std::string& name, int threads) {
    std::optional<Error> failure;
    std::shared_ptr<ExactBackend> backend;
    std::array<char, 16> kind{};
    try {
        std::shared_ptr<RenderBackend> made = make(name, threads);
        backend = std::shared_ptr<ExactBackend>(made, &exact(*made));
        backend->settle_when_stopped();
        backend->info().name.copy(kind.data(), kind.size() - 1);
    } catch (const Error& error) {
        failure = error;
    }
    const std::string own = kind.data();
    ranks.broadcast(bytes_of_value(kind));
    if (backend && own != kind.data() && kind[0] != 0)
        failure = Error(ErrorKind::Unavailable, "back end " + own + ": expected " + kind.data() + " as on rank 0");
    report(ranks, failure, {});
    return failure ? nullptr : backend;
}

class MpiBackend final : public ExactBackend {
public:
    MpiBackend(Communicator& ranks, std::shared_ptr<ExactBackend> local, const RankCommand& opened)
        : ranks_(ranks), work_(ranks, std::move(local), opened.share_pixels), number_(opened.backend_number) {}
    ~MpiBackend() override {
        try {
            RankCommand command{.order = Order::Close, .backend_number = number_};
            ranks_.broadcast(bytes_of_value(command));
        } catch (const Error&) {
            // A rank has died: the others notice it themselves.
        }
    }
    MpiBackend(const MpiBackend&) = delete;
    MpiBackend& operator=(const MpiBackend&) = delete;

    BackendInfo info() const override {
        BackendInfo info = local().info();
        info.ranks = ranks_.size();
        return info;
    }

    void upload_scene(std::shared_ptr<const HostScene> scene) override {
        Payload payload{.scene = std::move(scene)};
        lead({.order = Order::Scene}, payload);
    }
    void upload_volumes(std::shared_ptr<const HostVolumes> volumes, const FieldShape& shape) override {
        Payload payload{.volumes = std::move(volumes), .shape = shape};
        lead({.order = Order::Volumes}, payload);
    }
    void upload_field(MethodId method, HostField field) override {
        Payload payload{.field = std::move(field)};
        lead({.order = Order::Field, .method = method}, payload);
    }
    HostField download_field(MethodId method) const override {
        if (has_field(method)) lead({.order = Order::Collect, .method = method});
        return local().download_field(method);
    }
    bool has_field(MethodId method) const override { return local().has_field(method); }
    FieldReport field_report(MethodId method) const override { return local().field_report(method); }
    void change_pending(MethodId method, const std::function<void(PendingSums)>& change) override {
        lead({.order = Order::Collect, .method = method});
        local().change_pending(method, change);
    }

    void reset_film(FilmSlot slot, int width, int height) override {
        film_pixels(width, height);
        lead({.order = Order::ResetFilm, .slot = slot, .width = width, .height = height});
    }
    FilmReading read_film(FilmSlot slot) const override { return gathered(slot).read_film(slot); }
    FilmReading read_halves(FilmSlot slot) const override { return gathered(slot).read_halves(slot); }
    std::vector<std::uint32_t> invalid_samples(FilmSlot slot) const override {
        return gathered(slot).invalid_samples(slot);
    }
    DisplayFrame show_film(FilmSlot slot, const FrameStyle& style) override {
        return gathered(slot).show_film(slot, style);
    }
    float largest_value(FilmSlot slot) override { return gathered(slot).largest_value(slot); }
    void read_pixels(FilmSlot slot, std::uint32_t first, std::span<FilmPixel> pixels) const override {
        gathered(slot).read_pixels(slot, first, pixels);
    }
    /// Ranks get whole films: their state of the others' pixels is not known here.
    void write_pixels(FilmSlot slot, std::uint32_t first, std::span<const FilmPixel> pixels) override {
        gathered(slot);
        Payload payload{.pixels = {pixels.begin(), pixels.end()}};
        lead({.order = Order::WritePixels, .slot = slot, .first = first}, payload);
    }

    PassCounters run_pass(const PassRequest& request) override {
        if (request.stop != nullptr && *request.stop) return {};
        Payload payload{.stop = request.stop};
        RankCommand command{.order = Order::Pass, .slot = request.slot, .pass = request};
        command.pass.stop = nullptr;
        return lead(command, payload);
    }
    PassCounters precompute(const PrecomputeRequest& request) override {
        if (request.stop != nullptr && *request.stop) return {};
        Payload payload{.stop = request.stop};
        RankCommand command{.order = Order::Precompute, .method = request.method, .probes = request};
        command.probes.stop = nullptr;
        return lead(command, payload);
    }
    void update_field(MethodId method) override { lead({.order = Order::Update, .method = method}); }

private:
    ExactBackend& local() const { return work_.backend(); }
    PassCounters lead(RankCommand command, Payload& payload) const {
        command.backend_number = number_;
        return work_.lead(command, payload);
    }
    void lead(const RankCommand& command) const {
        Payload payload;
        lead(command, payload);
    }
    /// The local back end, with the pixels of all ranks.
    ExactBackend& gathered(FilmSlot slot) const {
        lead({.order = Order::GatherFilm, .slot = slot});
        return local();
    }

    Communicator& ranks_;
    mutable RankWork work_;
    std::int32_t number_;
};

}  // namespace

std::unique_ptr<RenderBackend> make_mpi_backend(Communicator& ranks, const RankBackendFactory& make,
                                                const std::string& name, int threads, std::uint32_t share_pixels) {
    static std::atomic<std::int32_t> opened{0};
    RankCommand command{
        .order = Order::Open, .backend_number = ++opened, .threads = threads, .share_pixels = share_pixels};
    name.copy(command.backend_name.data(), command.backend_name.size() - 1);
    ranks.broadcast(bytes_of_value(command));
    return std::make_unique<MpiBackend>(ranks, open_backend(ranks, make, name, threads), command);
}

void follow_rank_0(Communicator& ranks, const RankBackendFactory& make, const std::function<void()>& called) {
    std::map<std::int32_t, RankWork> works;
    for (;;) {
        RankCommand command;
        ranks.broadcast(bytes_of_value(command));
        if (command.order == Order::End) return;
        if (command.order == Order::Call) {
            called();
        } else if (command.order == Order::Close) {
            works.erase(command.backend_number);
        } else if (command.order != Order::Open) {
            works.at(command.backend_number).follow(command);
        } else if (auto backend = open_backend(ranks, make, command.backend_name.data(), command.threads)) {
            works.try_emplace(command.backend_number, ranks, std::move(backend), command.share_pixels);
        }
    }
}

void call_ranks(Communicator& ranks) {
    RankCommand command{.order = Order::Call};
    ranks.broadcast(bytes_of_value(command));
}

void end_ranks(Communicator& ranks) {
    RankCommand command;
    ranks.broadcast(bytes_of_value(command));
}

}  // namespace pl
