#include "app/measure/effect_costs.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/interrupt.h"
#include "app/make_backend.h"
#include "core/io/files.h"
#include "core/measure/statistics.h"
#include "core/scene/needed_effects.h"

namespace pl {
namespace {

/// Passes of one turn: short, so that turns of different kernels see the same machine.
constexpr std::uint32_t kPassesPerTurn = 4;

/// One kernel at work.
struct Candidate {
    FeatureSet set;
    Session session;
    std::vector<double> seconds{};  ///< of each turn, charged

    double turn() {
        const FilmSlot slot = slot_of(session.settings());
        const double before = session.clocks(slot).render;
        const std::uint32_t target = session.passes(slot) + kPassesPerTurn;
        while (session.passes(slot) < target) session.advance(slot);
        return session.clocks(slot).render - before;
    }
};

struct Cost {
    BenchCell cell;
    std::string kernel;
    std::vector<std::string> effects;  ///< that this kernel can do
    Interval ratio;                    ///< of its time to that of the kernel that the scene needs
    double nanoseconds = 0.0;          ///< per segment, of the fastest turn
};

std::string effects_text(const Cost& cost) {
    return cost.effects.empty() ? "none" : fmt::format("{}", fmt::join(cost.effects, ", "));
}

class EffectCosts {
public:
    EffectCosts(const BenchPlan& plan, int threads, Console& console)
        : plan_(plan), threads_(threads), console_(console) {}

    /// False if interrupted.
    bool measure() {
        for (std::size_t scene = 0; scene < plan_.scenes.size(); ++scene)
            for (const std::string& backend : plan_.backend_names)
                for (const MethodId method : plan_.methods)
                    if (!measure_cell({.scene = scene, .method = method, .backend = backend})) return false;
        return true;
    }
    const std::vector<Cost>& costs() const { return costs_; }

private:
    bool measure_cell(const PlannedRun& cell) {
        std::vector<Candidate> candidates = candidates_for(cell);
        for (Candidate& candidate : candidates) candidate.turn();  // warm-up, and what has to come first
        for (int round = 0; round < plan_.seeds; ++round)
            for (std::size_t i = 0; i < candidates.size(); ++i) {
                if (interrupt_.raised()) return false;
                // Each round begins with another one.
                Candidate& candidate = candidates[(i + static_cast<std::size_t>(round)) % candidates.size()];
                candidate.seconds.push_back(candidate.turn());
            }
        for (const Candidate& candidate : candidates) add_cost(cell, candidate, candidates.front());
        return true;
    }

    /// The needed kernel first.
    std::vector<Candidate> candidates_for(const PlannedRun& cell) const {
        const BenchScene& scene = plan_.scenes[cell.scene];
        RenderSettings settings = scene.options.render;
        settings.method = cell.method;
        settings.forced_effects = {};
        // Each has a back end, and so pictures and tables, of its own.
        const auto make = [&] { return Session(make_backend(cell.backend, threads_), scene.loaded.scene, settings); };
        std::vector<Candidate> candidates;
        candidates.push_back({.set = {}, .session = make()});
        const FilmSlot slot = slot_of(settings);
        const FeatureSet needed = candidates.front().session.needed_features(slot);
        candidates.front().set = candidates.front().session.served_kernel(slot).compiled;
        for (const FeatureSet set : kCompiledSets) {
            if (!set.covers(needed) || set == candidates.front().set) continue;
            settings.forced_effects = set;
            Candidate larger{.set = set, .session = make()};
            // Some kernels exist for fewer sets.
            if (larger.session.served_kernel(slot).compiled == set) candidates.push_back(std::move(larger));
        }
        return candidates;
    }

    void add_cost(const PlannedRun& cell, const Candidate& candidate, const Candidate& needed) {
        std::vector<double> ratios;
        for (std::size_t i = 0; i < candidate.seconds.size(); ++i)
            ratios.push_back(candidate.seconds[i] / needed.seconds[i]);
        const Snapshot end = candidate.session.summary(slot_of(candidate.session.settings()));
        const double segments_per_turn =
            static_cast<double>(end.counters.path.segments) / static_cast<double>(candidate.seconds.size() + 1);
        const double fastest = *std::min_element(candidate.seconds.begin(), candidate.seconds.end());
        costs_.push_back({.cell = plan_.cell_of(cell),
                          .kernel = candidate.session.served_kernel(slot_of(candidate.session.settings())).name,
                          .effects = effect_names(candidate.set),
                          .ratio = geometric_interval(ratios),
                          .nanoseconds = 1e9 * fastest / segments_per_turn});
        const Cost& cost = costs_.back();
        console_.result(fmt::format("{:<36} {:<8} {:.3f} [{:.3f}, {:.3f}] {:6.0f} ns  {}\n", cost.cell.title(),
                                    &candidate == &needed ? "needed" : "larger", cost.ratio.value, cost.ratio.low,
                                    cost.ratio.high, cost.nanoseconds, effects_text(cost)));
    }

    const BenchPlan& plan_;
    int threads_;
    Console& console_;
    InterruptGuard interrupt_;
    std::vector<Cost> costs_;
};

Json costs_json(const std::vector<Cost>& costs) {
    Json rows = Json::array();
    for (const Cost& cost : costs)
        rows.push_back({{"scene", cost.cell.scene},
                        {"method", cost.cell.method},
                        {"backend", cost.cell.backend},
                        {"kernel", cost.kernel},
                        {"effects", cost.effects},
                        {"ratio", {{"value", cost.ratio.value}, {"low", cost.ratio.low}, {"high", cost.ratio.high}}},
                        {"ns_per_segment", cost.nanoseconds}});
    return {{"schema", "pathlight.effects/1"}, {"confidence", kConfidence}, {"costs", rows}};
}

std::string costs_table(const std::vector<Cost>& costs) {
    std::string text = "| scene, method, back end | kernel can do | time over needed kernel | ns per segment |\n"
                       "| --- | --- | --- | --- |\n";
    for (const Cost& cost : costs)
        text += fmt::format("| {} | {} | {:.3f} [{:.3f}, {:.3f}] | {:.0f} |\n", cost.cell.title(), effects_text(cost),
                            cost.ratio.value, cost.ratio.low, cost.ratio.high, cost.nanoseconds);
    return text;
}

}  // namespace

int measure_effect_costs(const BenchPlan& plan, int threads, const std::filesystem::path& folder, Console& console) {
    EffectCosts costs(plan, threads, console);
    if (!costs.measure()) {
        console.log().warning("interrupted: nothing was written");
        return kExitInterrupted;
    }
    std::filesystem::create_directories(folder);
    write_file_atomic(folder / "effects.json", costs_json(costs.costs()).dump(2) + "\n");
    write_text_file_atomic(folder / "effects.md", costs_table(costs.costs()));
    console.event("done", {{"output", folder.string()}, {"costs", costs.costs().size()}});
    console.remark(fmt::format("{}: effects.json, effects.md\n", folder.string()));
    return 0;
}

}  // namespace pl
