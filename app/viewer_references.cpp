#include "app/viewer_references.h"

#include "app/make_backend.h"
#include "app/measure/make_reference.h"
#include "core/measure/picture_identity.h"

namespace pl {
namespace {

/// In each half; with next-event estimation more than a viewer's pictures come near to. It can be ended before.
constexpr std::uint32_t kViewerReferenceSpp = 4096;

std::shared_ptr<const StoredReference> to_viewer(const Reference& reference, const SceneDescription& scene,
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

/// What decides the noise of a reference, and not what it shows.
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

std::shared_ptr<const StoredReference> find_viewer_reference(const std::filesystem::path& folder,
                                                             const SceneDescription& scene,
                                                             const RenderSettings& settings) {
    const auto found = ReferenceStore(folder).find(content_of(scene, settings));
    return found ? to_viewer(*found, scene, settings) : nullptr;
}

std::shared_ptr<const StoredReference> make_viewer_reference(const std::filesystem::path& folder,
                                                             const std::string& scene_name,
                                                             const std::shared_ptr<const SceneDescription>& scene,
                                                             const RenderSettings& settings, int threads,
                                                             const JobMonitor& monitor) {
    Session session(make_backend("cpu", threads), scene, reference_settings(settings));
    const ReferenceOutcome outcome =
        make_reference(session,
                       {.scene = scene_name,
                        .spp = kViewerReferenceSpp,
                        .seconds = {},
                        .in_both_halves = true,
                        .stopped = monitor.stopped,
                        .show = [&](const ProgressState& state) { monitor.progress(state.share, state.detail); }},
                       ReferenceStore(folder));
    return to_viewer(outcome.reference, *scene, settings);
}

}  // namespace pl
