// A bench: accuracy against time, for methods x back ends x scenes x seeds. Makes missing references and the runs
// missing in its folder.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/bench/bench_plan.h"
#include "core/bench/bench_results.h"

namespace pl::bench {

// Making one run of a bench, wherever it is made.

struct FinishedRun {
    BenchRun run;
    std::vector<LinearImage> pictures{};  ///< of the points of the first seed's run; else none
};

/// Makes a run from the beginning; empty if `stop` is raised before its end. `on_work` is called after each piece of work and may
/// be empty. Commit and host of the run are the caller's to set. The plan's scene needs its reference.
std::optional<FinishedRun> make_run(const BenchPlan& plan, const PlannedRun& planned, const StopFlag* stop,
                                    const std::function<void(const Session&, FilmSlot)>& on_work);

// The whole bench.

struct BenchSettings {
    BenchPlan plan;
    std::filesystem::path folder;
    std::filesystem::path
        reference_folder;  ///< has to hold every reference; empty: the bench's own folder, references made as needed
    std::uint32_t reference_spp = 4096;  ///< samples per pixel in each half of a reference that is made
    std::string command;                 ///< that repeats the bench
    std::string commit;                  ///< of this program
};

/// Takes each finished run, in any order.
using OnFinishedRun = std::function<void(FinishedRun)>;

/// Watches a bench; all members may be empty.
struct BenchObserver {
    const StopFlag* stop = nullptr;
    std::function<void(const std::string&)> tell{};    ///< what is left to do and how long it takes: before it begins
    std::function<void(const ProgressState&)> show{};  ///< after each piece of work
    std::function<void(const BenchRun&)> on_run{};     ///< after each finished run
    /// Makes runs elsewhere, several at a time; empty: one after the other, here. Returns false if it was stopped.
    std::function<bool(const BenchPlan&, const std::vector<PlannedRun>&, const OnFinishedRun&)> deal{};
};

class Bench {
public:
    /// Throws Error(Input) if a reference folder is given and lacks one.
    Bench(BenchSettings settings, BenchObserver observer);

    /// Continues after the folder's earlier runs. When stopped, the results hold the finished runs, and are
    /// incomplete. Throws Error(Usage) if the folder holds a bench of another plan.
    BenchResults run();

private:
    void find_references();
    void take_references();
    std::string forecast() const;
    bool make_references();
    Json references_json() const;
    void save_reference_pictures() const;
    std::vector<PlannedRun> remaining_runs() const;
    bool make_runs();
    bool make_runs_here(const std::vector<PlannedRun>& runs);
    void keep(FinishedRun finished) const;
    bool is_stopped() const { return observer_.stop != nullptr && *observer_.stop; }

    BenchSettings settings_;
    BenchObserver observer_;
    BenchFolder folder_;
};

}  // namespace pl::bench
