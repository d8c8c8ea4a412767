#include "ui/model/stored_reference.h"

#include "core/bench/reference_store.h"
#include "core/measure/picture_identity.h"

namespace pl::ui {
namespace {

/// Samples in each half: more than a picture in a window reaches. Rendering may be stopped earlier.
constexpr std::uint32_t kStoredReferenceSpp = 4096;

std::shared_ptr<const StoredReference> to_viewer(const bench::Reference& reference, const SceneDescription& scene,
                                                 const RenderSettings& settings) {
    if (!reference.has_samples()) return nullptr;
    const auto& [first, second] = reference.halves;
    auto stored = std::make_shared<StoredReference>();
    stored->halves = {.picture = picture_key(scene, settings),
                      .width = settings.width,
                      .height = settings.height,
                      .first = first.image.pixels,
                      .second = second.image.pixels};
    stored->spp = {first.spp, second.spp};
    stored->noise_relmse = reference.noise().relmse;
    return stored;
}

/// Settings that decide the noise of a reference, but not its light, are the same for all.
RenderSettings reference_settings(RenderSettings settings) {
    const RenderSettings standard;
    settings.view = View::Beauty;
    settings.method = MethodId::Default;
    settings.next_event = true;
    settings.seed = standard.seed;
    settings.roulette = standard.roulette;
    return settings;
}

}  // namespace

std::shared_ptr<const StoredReference> find_stored_reference(const std::filesystem::path& folder,
                                                             const SceneDescription& scene,
                                                             const RenderSettings& settings) {
    const auto found = bench::ReferenceStore(folder).find(bench::content_of(scene, settings));
    return found ? to_viewer(*found, scene, settings) : nullptr;
}

std::shared_ptr<const StoredReference> make_stored_reference(const std::filesystem::path& folder,
                                                             const OpenScene& scene, const RenderSettings& settings,
                                                             const BackendFactory& make_backend,
                                                             const JobMonitor& monitor) {
    Session session(make_backend("cpu"), scene.description, reference_settings(settings));
    const bench::ReferenceOutcome outcome = bench::make_reference(
        session,
        {.scene = scene.name,
         .spp = kStoredReferenceSpp,
         .seconds = {},
         .in_both_halves = true,
         .stop = monitor.stop,
         .show = [&](const ProgressState& state) { monitor.progress(state.share, state.detail); }},
        bench::ReferenceStore(folder));
    return to_viewer(outcome.reference, *scene.description, settings);
}

}  // namespace pl::ui
