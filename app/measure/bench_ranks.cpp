#include "app/measure/bench_ranks.h"

#include <chrono>
#include <future>
#include <optional>
#include <set>
#include <thread>

#include <fmt/format.h>

#include "app/commands.h"
#include "app/measure/bench_options.h"
#include "app/suite.h"
#include "core/base/error.h"
#include "mpi/mpi_backend.h"
#include "mpi/rank_work.h"

namespace pl {
namespace {

using OnWork = std::function<void(const Session&, FilmSlot)>;

/// The message of a rank about a run: it is finished, was stopped, or has failed.
struct Reply {
    std::optional<bench::FinishedRun> finished{};
    std::optional<Error> failure{};
};

std::string message_of(const bench::PlannedRun& run) {
    return Json{{"scene", run.scene},
                {"method", run.method},
                {"backend", run.backend},
                {"seed", run.seed},
                {"warm_up", run.warm_up}}
        .dump();
}

bench::PlannedRun planned_from(const std::string& text) {
    const Json json = parse_json(text);
    return {.scene = json.at("scene"),
            .method = json.at("method"),
            .backend = json.at("backend"),
            .seed = json.at("seed"),
            .warm_up = json.at("warm_up")};
}

void send_reply(Communicator& ranks, const Reply& reply) {
    Json json = Json::object();
    if (reply.failure) json = {{"kind", static_cast<int>(reply.failure->kind())}, {"message", reply.failure->what()}};
    if (reply.finished)
        json = {{"run", bench::run_json(reply.finished->run)}, {"pictures", reply.finished->pictures.size()}};
    send_text(ranks, 0, json.dump());
    if (!reply.finished) return;
    for (const LinearImage& picture : reply.finished->pictures) {
        send_text(ranks, 0, Json{{"width", picture.width}, {"height", picture.height}}.dump());
        ranks.send(0, std::as_bytes(std::span(picture.pixels)));
    }
}

Reply receive_reply(Communicator& ranks, int from) {
    const Json json = parse_json(receive_text(ranks, from));
    if (json.contains("message"))
        return {.failure = Error(static_cast<ErrorKind>(json.at("kind").get<int>()),
                                 ranks.name_of(from) + ": " + json.at("message").get<std::string>())};
    if (!json.contains("run")) return {};
    bench::FinishedRun finished{.run = bench::run_from_json(json.at("run"))};
    for (std::size_t i = 0; i < json.at("pictures").get<std::size_t>(); ++i) {
        const Json size = parse_json(receive_text(ranks, from));
        LinearImage& picture = finished.pictures.emplace_back();
        picture.width = size.at("width");
        picture.height = size.at("height");
        picture.pixels.resize(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
        ranks.receive(from, std::as_writable_bytes(std::span(picture.pixels)));
    }
    return {.finished = std::move(finished)};
}

/// Makes runs on this rank. The first one of each cell is a warm-up, whether it is planned or not: its time counts for nothing.
class RunMaker {
public:
    RunMaker(const bench::BenchPlan& plan, std::string host) : plan_(plan), host_(std::move(host)) {}

    Reply make(const bench::PlannedRun& planned, const StopFlag& stop, const OnWork& on_work) {
        try {
            if (warmed_.insert(plan_.cell_of(planned)).second && !planned.warm_up) {
                bench::PlannedRun warm_up = planned;
                warm_up.warm_up = true;
                make_run(plan_, warm_up, &stop, on_work);
            }
            std::optional<bench::FinishedRun> finished = make_run(plan_, planned, &stop, on_work);
            if (finished) finished->run.host = host_;
            return {.finished = std::move(finished)};
        } catch (const Error& error) {
            return {.failure = error};
        } catch (const std::exception& error) {
            return {.failure = Error(ErrorKind::Runtime, error.what())};
        }
    }

private:
    const bench::BenchPlan& plan_;
    std::string host_;
    std::set<bench::BenchCell> warmed_;
};

/// Rank 0 tells its plan and references to the others.
void share_plan(Communicator& ranks, const bench::BenchPlan& plan) {
    std::string text = plan.json().dump();
    std::vector<char> characters(text.begin(), text.end());
    broadcast_array(ranks, characters);
    std::uint32_t all_agree = 1;
    std::optional<Error> failure;
    try {
        report(ranks, std::nullopt, {});
    } catch (const Error& error) {
        failure = error;
        all_agree = 0;
    }
    ranks.broadcast(bytes_of_value(all_agree));
    if (failure) throw *failure;
    for (const bench::BenchScene& scene : plan.scenes)
        for (const bench::ReferenceHalf& half : scene.reference->halves) {
            std::vector<Vec3f> pixels = half.image.pixels;
            broadcast_array(ranks, pixels);
            std::uint32_t spp = half.spp;
            ranks.broadcast(bytes_of_value(spp));
        }
}

/// Another rank's side. Returns whether all ranks have the plan of rank 0.
bool take_plan(Communicator& ranks, const std::optional<bench::BenchPlan>& plan, std::optional<Error> failure) {
    std::vector<char> characters;
    broadcast_array(ranks, characters);
    if (plan) {
        const Json expected = parse_json({characters.data(), characters.size()});
        const Json own = plan->json();
        const Json differences = Json::diff(expected, own);
        if (!differences.empty()) {
            const std::string where = differences[0].at("path");
            failure = Error(ErrorKind::Input,
                            fmt::format("the bench has another plan here than on rank 0: {} differs", where));
        }
    }
    report(ranks, failure, {});
    std::uint32_t all_agree = 0;
    ranks.broadcast(bytes_of_value(all_agree));
    return all_agree != 0;
}

void take_references(Communicator& ranks, bench::BenchPlan& plan) {
    for (bench::BenchScene& scene : plan.scenes) {
        bench::Reference reference;
        for (bench::ReferenceHalf& half : reference.halves) {
            broadcast_array(ranks, half.image.pixels);
            ranks.broadcast(bytes_of_value(half.spp));
        }
        scene.reference = std::make_shared<const bench::Reference>(std::move(reference));
    }
}

/// Rank 0's side of the deal. Its own runs are made by a second thread, so that the others do not wait for it.
class Dealer {
public:
    Dealer(Communicator& ranks, const bench::BenchPlan& plan, const std::vector<bench::PlannedRun>& runs,
           const StopFlag* stop, const bench::OnFinishedRun& on_finished)
        : ranks_(ranks), runs_(runs), stop_(stop), on_finished_(on_finished), own_maker_(plan, ranks.host()),
          states_(static_cast<std::size_t>(ranks.size())) {}

    ~Dealer() {
        own_stop_ = true;
        if (own_.valid()) own_.wait();
    }
    Dealer(const Dealer&) = delete;
    Dealer& operator=(const Dealer&) = delete;

    bool deal() {
        for (;;) {
            give_out();
            if (is_ending()) dismiss();
            if (std::ranges::none_of(states_, [](const State& state) { return state.busy; })) break;
            if (!collect()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        dismiss();
        if (failure_) throw *failure_;
        return finished_ == runs_.size();
    }

private:
    struct State {
        bool busy = false;
        bool dismissed = false;
    };

    bool is_ending() const { return failure_ || (stop_ != nullptr && *stop_); }

    void give_out() {
        for (int rank = 0; rank < ranks_.size() && !is_ending() && next_ < runs_.size(); ++rank) {
            State& state = states_[static_cast<std::size_t>(rank)];
            if (state.busy) continue;
            state.busy = true;
            const bench::PlannedRun& planned = runs_[next_++];
            if (rank == 0)
                own_ = std::async(std::launch::async,
                                  [this, planned] { return own_maker_.make(planned, own_stop_, {}); });
            else
                send_text(ranks_, rank, message_of(planned));
        }
    }

    /// Returns whether a run has ended.
    bool collect() {
        bool any = false;
        for (int rank = 0; rank < ranks_.size(); ++rank) {
            State& state = states_[static_cast<std::size_t>(rank)];
            if (!state.busy) continue;
            const bool is_there = rank == 0 ? own_.wait_for(std::chrono::seconds(0)) == std::future_status::ready
                                            : ranks_.has_message(rank);
            if (!is_there) continue;
            take(rank == 0 ? own_.get() : receive_reply(ranks_, rank));
            state.busy = false;
            any = true;
        }
        return any;
    }

    void take(Reply reply) {
        if (reply.failure && !failure_) failure_ = reply.failure;
        if (!reply.finished) return;
        ++finished_;
        on_finished_(*std::move(reply.finished));
    }

    /// Ends the runs under way, and tells every rank that there are no more.
    void dismiss() {
        own_stop_ = true;
        for (int rank = 1; rank < ranks_.size(); ++rank) {
            State& state = states_[static_cast<std::size_t>(rank)];
            if (!std::exchange(state.dismissed, true)) send_text(ranks_, rank, "");
        }
    }

    Communicator& ranks_;
    const std::vector<bench::PlannedRun>& runs_;
    const StopFlag* stop_;
    const bench::OnFinishedRun& on_finished_;
    RunMaker own_maker_;
    std::vector<State> states_;
    StopFlag own_stop_{false};
    std::future<Reply> own_;
    std::size_t next_ = 0;
    std::size_t finished_ = 0;
    std::optional<Error> failure_;
};

}  // namespace

bool deal_runs(Communicator& ranks, const bench::BenchPlan& plan, const std::vector<bench::PlannedRun>& runs,
               const StopFlag* stop, const bench::OnFinishedRun& on_finished) {
    call_ranks(ranks);
    share_plan(ranks, plan);
    return Dealer(ranks, plan, runs, stop, on_finished).deal();
}

void serve_bench(Communicator& ranks, const std::vector<std::string>& arguments) {
    std::optional<bench::BenchPlan> plan;
    std::optional<Error> failure;
    try {
        Options quiet;
        quiet.quiet = true;
        Console silent;
        silent.configure(quiet);
        plan = make_bench_plan(expanded(parse_command_line(arguments), silent), silent);
    } catch (const Error& error) {
        failure = error;
    }
    if (!take_plan(ranks, plan, failure)) return;
    take_references(ranks, *plan);
    RunMaker maker(*plan, ranks.host());
    for (;;) {
        const std::string text = receive_text(ranks, 0);
        if (text.empty()) return;
        StopFlag stop{false};
        send_reply(ranks, maker.make(planned_from(text), stop, [&](const Session&, FilmSlot) {
            if (stop || !ranks.has_message(0)) return;
            receive_text(ranks, 0);  // nothing but the end may come within a run
            stop = true;
        }));
        if (stop) return;
    }
}

}  // namespace pl
