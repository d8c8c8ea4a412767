#include "core/bench/effect_costs.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/io/files.h"
#include "core/scene/needed_effects.h"
#include "core/session/session.h"

namespace pl::bench {
namespace {

/// Passes of one turn: few, so that turns of different kernels see the same state of the machine.
constexpr std::uint32_t kPassesPerTurn = 4;

/// A kernel under test.
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

class EffectCosts {
public:
    EffectCosts(const BenchPlan& plan, const BackendFactory& make, const StopFlag* stop,
                const std::function<void(const EffectCost&)>& on_cost)
        : plan_(plan), make_(make), stop_(stop), on_cost_(on_cost) {}

    /// False if stopped.
    bool measure() {
        for (std::size_t scene = 0; scene < plan_.scenes.size(); ++scene)
            for (const std::string& backend : plan_.backend_names)
                for (std::size_t method = 0; method < plan_.methods.size(); ++method)
                    if (!measure_cell({.scene = scene, .method = method, .backend = backend})) return false;
        return true;
    }
    std::vector<EffectCost> take() { return std::move(costs_); }

private:
    bool measure_cell(const PlannedRun& cell) {
        std::vector<Candidate> candidates = candidates_for(cell);
        for (Candidate& candidate : candidates) candidate.turn();  // warm-up, placement, precomputation
        for (int round = 0; round < plan_.seeds; ++round)
            for (std::size_t i = 0; i < candidates.size(); ++i) {
                if (stop_ != nullptr && *stop_) return false;
                // Each round begins with another candidate.
                Candidate& candidate = candidates[(i + static_cast<std::size_t>(round)) % candidates.size()];
                candidate.seconds.push_back(candidate.turn());
            }
        for (const Candidate& candidate : candidates) add_cost(cell, candidate, candidates.front());
        return true;
    }

    /// The needed kernel first.
    std::vector<Candidate> candidates_for(const PlannedRun& cell) const {
        const BenchScene& scene = plan_.scenes[cell.scene];
        RenderSettings settings = plan_.methods[cell.method].settings(scene.settings);
        settings.forced_effects = {};
        // A back end of its own for each, and so pictures and fields of its own.
        const auto make = [&] { return Session(make_(cell.backend), scene.description, settings); };
        std::vector<Candidate> candidates;
        candidates.push_back({.set = {}, .session = make()});
        const FilmSlot slot = slot_of(settings);
        const FeatureSet needed = candidates.front().session.needed_features(slot);
        candidates.front().set = candidates.front().session.served_kernel(slot).compiled;
        for (const FeatureSet set : kCompiledSets) {
            if (!set.covers(needed) || set == candidates.front().set) continue;
            settings.forced_effects = set;
            Candidate larger{.set = set, .session = make()};
            // Some methods are compiled for fewer feature sets.
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
                          .is_needed = &candidate == &needed,
                          .ratio = geometric_interval(ratios),
                          .nanoseconds = 1e9 * fastest / segments_per_turn});
        on_cost_(costs_.back());
    }

    const BenchPlan& plan_;
    const BackendFactory& make_;
    const StopFlag* stop_;
    const std::function<void(const EffectCost&)>& on_cost_;
    std::vector<EffectCost> costs_;
};

Json costs_json(const std::vector<EffectCost>& costs) {
    Json rows = Json::array();
    for (const EffectCost& cost : costs)
        rows.push_back({{"scene", cost.cell.scene},
                        {"method", cost.cell.method},
                        {"backend", cost.cell.backend},
                        {"kernel", cost.kernel},
                        {"effects", cost.effects},
                        {"ratio", {{"value", cost.ratio.value}, {"low", cost.ratio.low}, {"high", cost.ratio.high}}},
                        {"ns_per_segment", cost.nanoseconds}});
    return {{"schema", "pathlight.effects/1"}, {"confidence", kConfidence}, {"costs", rows}};
}

std::string costs_table(const std::vector<EffectCost>& costs) {
    std::string text = "| scene, method, back end | kernel can do | time over needed kernel | ns per segment |\n"
                       "| --- | --- | --- | --- |\n";
    for (const EffectCost& cost : costs)
        text += fmt::format("| {} | {} | {:.3f} [{:.3f}, {:.3f}] | {:.0f} |\n", cost.cell.title(),
                            cost.effects_text(), cost.ratio.value, cost.ratio.low, cost.ratio.high, cost.nanoseconds);
    return text;
}

}  // namespace

std::string EffectCost::effects_text() const {
    return effects.empty() ? "none" : fmt::format("{}", fmt::join(effects, ", "));
}

std::optional<std::vector<EffectCost>> measure_effect_costs(const BenchPlan& plan, const BackendFactory& make,
                                                            const StopFlag* stop,
                                                            const std::function<void(const EffectCost&)>& on_cost) {
    EffectCosts costs(plan, make, stop, on_cost);
    if (!costs.measure()) return std::nullopt;
    return costs.take();
}

void write_effect_costs(const std::filesystem::path& folder, const std::vector<EffectCost>& costs) {
    std::filesystem::create_directories(folder);
    write_file_atomic(folder / "effects.json", costs_json(costs).dump(2) + "\n");
    write_text_file_atomic(folder / "effects.md", costs_table(costs));
}

}  // namespace pl::bench
