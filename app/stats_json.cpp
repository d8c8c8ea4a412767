#include "app/stats_json.h"

#include <cmath>

#include "app/diagnostics_file.h"
#include "app/make_backend.h"
#include "app/option_parsers.h"
#include "core/bench/figures_json.h"
#include "core/scene/default_light.h"
#include "core/scene/needed_effects.h"

namespace pl {
namespace {

/// Mean over all finite pixels.
Json mean_radiance(const Snapshot& snapshot) {
    glm::dvec3 sum(0.0);
    std::size_t count = 0;
    for (const Vec3f& pixel : snapshot.pixels) {
        if (!std::isfinite(pixel.x + pixel.y + pixel.z)) continue;
        sum += glm::dvec3(pixel);
        ++count;
    }
    if (count > 0) sum /= static_cast<double>(count);
    return Json::array({sum.x, sum.y, sum.z});
}

Json target_json(const ErrorTarget* target) {
    if (target == nullptr) return nullptr;
    return {{"relmse", target->target()},
            {"measured", target->measured() ? Json(*target->measured()) : Json(nullptr)},
            {"of", "noise"}};
}

Json network_json(const NetworkStatus& network) {
    return {{"bytes", kNetworkBytes}, {"steps", network.steps}, {"lost", network.is_lost}};
}

Json field_json(const std::optional<FieldStatus>& field) {
    if (!field) return nullptr;
    Json json{{"representation", name_of(field->representation)},
              {"volumes", field->volumes},
              {"added_volumes", field->added_volumes},
              {"bins", field->bins},
              {"bytes", field->bytes},
              {"passes", field->passes},
              {"records", field->records},
              {"lookup_misses", field->lookup_misses}};
    if (field->network) json["network"] = network_json(*field->network);
    return json;
}

Json guiding_json(const std::optional<GuidingStatus>& guiding) {
    if (!guiding) return nullptr;
    Json ratio = nullptr;
    Json interval = nullptr;
    if (guiding->variance_ratio) {
        ratio = *guiding->variance_ratio;
        interval = {*guiding->variance_ratio / guiding->ratio_factor,
                    *guiding->variance_ratio * guiding->ratio_factor};
    }
    return {{"pays", guiding->pays},
            {"variance_ratio", ratio},
            {"variance_ratio_interval", interval},
            {"unguided_passes", guiding->unguided_passes},
            {"guided_share", guiding->guided_share}};
}

void add_counters(Json& stats, const PassCounters& counters) {
    const double paths = static_cast<double>(counters.paths);
    stats["paths"] = counters.paths;
    stats["segments"] = counters.path.segments;
    stats["shadow_rays"] = counters.path.shadow_rays;
    stats["emission_rays"] = counters.path.emission_rays;
    stats["zero_contribution_paths"] = counters.zero_contribution_paths;
    stats["mean_path_length"] = counters.paths == 0 ? 0.0 : static_cast<double>(counters.path.segments) / paths;
    stats["invalid_samples"] = counters.invalid_samples;
    stats["escaped_paths"] = counters.path.escaped;
}

/// Of rank 0.
void add_traffic(Json& stats, const Communicator& ranks) {
    stats["ranks"] = ranks.size();
    stats["messages"] = ranks.traffic().messages;
    stats["bytes_sent"] = ranks.traffic().bytes_sent;
    stats["seconds"]["communicate"] = ranks.traffic().seconds;
}

}  // namespace

Json stats_json(const Session& session, const Snapshot& snapshot, const Options& options, const RunOutcome& outcome,
                const ErrorTarget* target) {
    const RenderSettings& settings = session.settings();
    const BackendInfo backend = session.backend();
    const FeatureSet needed = session.needed_features(snapshot.slot);
    Json stats{{"schema", "pathlight.stats/1"},
               {"version", PL_VERSION},
               {"scene", options.scene},
               {"scene_hash", session.scene_hash()},
               {"light", name_of(light_of(session.scene()))},
               {"method", info_of(settings.method).name},
               {"view", info_of(settings.view).name},
               {"backend", backend.name},
               {"device", backend.device},
               {"threads", backend.threads},
               {"width", snapshot.width},
               {"height", snapshot.height},
               {"spp", snapshot.passes},
               {"seed", settings.seed},
               {"max_depth", settings.max_depth},
               {"nee", settings.next_event},
               {"roulette", name_of(settings.roulette)},
               {"seconds", bench::clocks_json(snapshot.clocks, {{"total", snapshot.clocks.total()}})},
               {"ended_by", name_of(outcome.ended_by)},
               {"target_error", target_json(target)}};
    add_counters(stats, snapshot.counters);
    if (const Communicator* const ranks = shared_ranks()) add_traffic(stats, *ranks);
    stats["diagnostics"] = diagnostics_json(snapshot);
    stats["mean_radiance"] = mean_radiance(snapshot);
    stats["field"] = field_json(snapshot.field);
    stats["guiding"] = guiding_json(snapshot.guiding);
    stats["effects_needed"] = effect_names(needed);
    stats["effects_compiled"] = effect_names(session.served_kernel(snapshot.slot).compiled);
    stats["kernel"] = snapshot.kernel;
    return stats;
}

}  // namespace pl
