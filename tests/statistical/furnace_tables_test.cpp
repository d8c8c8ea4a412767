// The learned field of a furnace: e/(1-rho) in every cell of every table.
#include <algorithm>

#include "tests/support/catch.hpp"
#include "tests/support/scenes/closed_scenes.h"
#include "tests/support/session/sessions.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr float kRho = 0.5f;
constexpr float kEmission = 0.5f;

RenderSettings furnace_settings(Estimator estimator, const SceneDescription& scene) {
    RenderSettings settings = settings_for(scene, estimator, 32, 32);
    settings.field.volumes = 12;
    settings.field.bins = 16;
    return settings;
}

HostTables learned_tables(Session& session) {
    return tables_of(session.backend_access().download_field(session.settings().method));
}

/// Tables of the furnace that are precomputed by 24^2 paths per cell.
HostTables precomputed_tables(bool next_event) {
    const SceneDescription scene = furnace_scene(kEmission, kRho);
    RenderSettings settings = furnace_settings({MethodId::Precomputed, next_event}, scene);
    settings.field.precompute_samples = 24 * 24;
    Session session = make_session(scene, settings);
    render_passes(session, 1);
    return learned_tables(session);
}

/// The share of the old mean that remains where this share of the visits is new.
double kept_share(double share, LearningRate rate) {
    return rate == LearningRate::SampleMean ? 1.0 - share : std::pow(1.0 - share, 4.0);
}

/// Follows a table through its updates and bounds the distance of each cell from the fixed point. Targets
/// are e + rho V of some volume, so a cell that starts with error E and takes the share s of new targets is left with
/// at most (1-s) E + s rho max V-error; V averages the cells that were visited. The bound needs nothing of the table
/// but its visits.
class ErrorBound {
public:
    explicit ErrorBound(const HostTables& tables)
        : volumes_(tables.mean_radiance.size()), cells_(tables.radiance.size() / volumes_),
          error_(tables.radiance.size(), 1.0), visits_(tables.visits) {}

    void publish(const HostTables& tables, LearningRate rate) {
        const double target_error = kRho * worst_mean_;
        for (std::size_t i = 0; i < error_.size(); ++i) {
            const double now = tables.visits[i];
            const double share = now > 0.0 ? (now - visits_[i]) / now : 0.0;
            const double kept = share > 0.0 ? kept_share(share, rate) : 1.0;
            error_[i] = kept * error_[i] + (1.0 - kept) * target_error;
        }
        visits_ = tables.visits;
        worst_mean_ = 0.0;
        for (std::size_t v = 0; v < volumes_; ++v) worst_mean_ = std::max(worst_mean_, mean_error(v));
    }

    double operator[](std::size_t cell) const { return error_[cell]; }
    double worst_mean() const { return worst_mean_; }

private:
    /// A volume without samples has mean 0: an error of 1.
    double mean_error(std::size_t volume) const {
        Moments visited;
        for (std::size_t i = volume * cells_; i < (volume + 1) * cells_; ++i)
            if (visits_[i] > 0) visited.add(error_[i]);
        return visited.count() > 0 ? visited.mean() : 1.0;
    }

    std::size_t volumes_;
    std::size_t cells_;
    std::vector<double> error_;
    LargeArray<std::uint32_t> visits_;
    double worst_mean_ = 1.0;
};

/// Rounding of the learned radiance, in units of the fixed point 1: the target (4 operations), its fixed-point step, the
/// mean and the update (6), and the sum over 16 cells in V; errors come back multiplied by rho: 1/(1-rho) = 2.
constexpr double kTableRounding = 2.0 * (4 + 1 + 6 + 16) * static_cast<double>(kRoundoff);

}  // namespace

// Targets of all light in a furnace have no noise given the tables, so there is nothing statistical here: every cell has to
// be within its derived bound. Seed 1, 1024 paths per pass: the forgetful rate has to bring all bounds below 0.1 % in
// 150 passes; the rate 1/(1+visits), whose error falls like visits^-(1-rho), below 3 % in 800.
TEST_CASE("Reinforcement learns e/(1-rho) in every cell of the furnace") {
    for (const LearningRate rate : {LearningRate::Forgetful, LearningRate::SampleMean})
        for (const bool next_event : {false, true}) {
            const SceneDescription scene = furnace_scene(kEmission, kRho);
            RenderSettings settings = furnace_settings({MethodId::Reinforcement, next_event}, scene);
            settings.field.rate = rate;
            settings.field.learning.light = LearnedLight::All;
            const std::uint32_t passes = rate == LearningRate::SampleMean ? 800 : 150;
            const double wanted = rate == LearningRate::SampleMean ? 0.03 : 0.001;
            INFO("rate " << static_cast<int>(rate) << ", next-event estimation " << next_event);
            Session session = make_session(scene, settings);
            session.find_volume_at(Vec3f{0.0f}, Vec3f{0.0f, 1.0f, 0.0f});  // places the volumes
            render_passes(session, 1);
            HostTables tables = learned_tables(session);
            HostTables empty = tables;
            std::fill(empty.visits.begin(), empty.visits.end(), 0u);
            ErrorBound bound(empty);
            bound.publish(tables, rate);
            for (std::uint32_t pass = 1; pass < passes; ++pass) {
                session.apply(EditRestart{});  // tables are always updated after the first pass of a picture
                render_passes(session, 1);
                tables = learned_tables(session);
                bound.publish(tables, rate);
            }
            double worst_bound = 0.0;
            double worst_excess = 0.0;
            for (std::size_t i = 0; i < tables.radiance.size(); ++i) {
                const double low = 1.0 - static_cast<double>(tables.radiance[i]);
                worst_bound = std::max(worst_bound, bound[i]);
                worst_excess = std::max({worst_excess, low - bound[i], -low});
            }
            CHECK(worst_excess <= kTableRounding);
            CHECK(worst_bound <= wanted);
            for (const float mean : tables.mean_radiance)
                CHECK(static_cast<double>(mean) == Approx(1.0).margin(bound.worst_mean() + kTableRounding));
        }
}

// Precomputation is a path per stratum. The furnace makes all cells samples of the same random number, so the spread
// of the cells is the standard error of each of them: rule S1 per cell (24^2 paths of coefficient of variation 0.4,
// resolves 15 %) and for the mean of all of them (192 cells, resolves 1 %). Seed 1.
TEST_CASE("Precomputation fills e/(1-rho) into every cell of the furnace") {
    const HostTables tables = precomputed_tables(false);
    Moments cells;
    for (const float radiance : tables.radiance) cells.add(static_cast<double>(radiance));
    CHECK(mean_equals(cells, {1.0}, 0.01));
    const double error = std::sqrt(cells.variance());
    CHECK(error <= resolving_error(0.15));
    for (std::size_t i = 0; i < tables.radiance.size(); ++i) {
        CHECK(std::fabs(static_cast<double>(tables.radiance[i]) - 1.0) <= kZAlpha * error);
        CHECK(tables.visits[i] == 24 * 24);
    }
}

// Of the emission, light samples have their share: every cell lies between the reflected light alone and all light.
TEST_CASE("Precomputation leaves to light samples what they bring") {
    Moments cells;
    const HostTables tables = precomputed_tables(true);
    for (const float radiance : tables.radiance) cells.add(static_cast<double>(radiance));
    CHECK(cells.mean() < 1.0 - 0.2 * static_cast<double>(kEmission));
    CHECK(cells.mean() > 1.0 - 0.8 * static_cast<double>(kEmission));
}

// Expected Sarsa of indirect light keeps the two parts of the irradiance apart: by scattered directions and by light samples.
// 400 passes of 1024 paths, seed 1; with the margins of the noisy targets below.
TEST_CASE("Learned indirect light and light samples are together e/(1-rho) in every volume of the furnace") {
    const SceneDescription scene = furnace_scene(kEmission, kRho);
    Session session = make_session(scene, furnace_settings({MethodId::Reinforcement, true}, scene));
    render_passes(session, 400);
    const HostTables tables = learned_tables(session);
    Moments means;
    for (std::size_t volume = 0; volume < tables.mean_radiance.size(); ++volume) {
        const float mean = tables.mean_radiance[volume] + tables.direct[volume];
        CHECK(static_cast<double>(mean) == Approx(1.0).margin(0.03));
        CHECK(tables.direct[volume] > 0.1f * kEmission);
        means.add(static_cast<double>(mean));
    }
    CHECK(means.mean() == Approx(1.0).margin(0.01));
}

// Sarsa and whole paths learn the same from noisy targets: 400 passes of 1024 paths, seed 1. Each table's mean has to be
// within 3 % of e/(1-rho) = 1, and their mean within 1 %.
TEST_CASE("The other targets learn e/(1-rho) in the furnace, too") {
    for (const LearningTarget target : {LearningTarget::Sarsa, LearningTarget::MonteCarlo})
        for (const bool next_event : {false, true}) {
            INFO("target " << static_cast<int>(target) << ", next-event estimation " << next_event);
            const SceneDescription scene = furnace_scene(kEmission, kRho);
            RenderSettings settings = furnace_settings({MethodId::Reinforcement, next_event}, scene);
            settings.field.learning = {target, LearnedLight::All};
            Session session = make_session(scene, settings);
            render_passes(session, 400);
            const HostTables tables = learned_tables(session);
            Moments means;
            for (const float mean : tables.mean_radiance) {
                CHECK(static_cast<double>(mean) == Approx(1.0).margin(0.03));
                means.add(static_cast<double>(mean));
            }
            CHECK(means.mean() == Approx(1.0).margin(0.01));
        }
}
