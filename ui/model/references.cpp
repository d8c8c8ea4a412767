#include "ui/model/references.h"

#include <fmt/format.h>

#include "core/bench/reference_store.h"
#include "core/measure/picture_identity.h"

namespace pl::ui {
namespace {

/// Samples in each half: more than a picture in a window reaches. Rendering may be stopped earlier.
constexpr std::uint32_t kStoredReferenceSpp = 4096;

std::shared_ptr<const StoredReference> to_viewer(const bench::Reference& reference, std::uint64_t picture,
                                                 const RenderSettings& settings) {
    if (!reference.has_samples()) return nullptr;
    const auto& [first, second] = reference.halves;
    auto stored = std::make_shared<StoredReference>();
    stored->halves = {.picture = picture,
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
                                                             std::uint64_t picture, const RenderSettings& settings) {
    const auto found = bench::ReferenceStore(folder).find({.picture_hash = picture_hash(picture),
                                                           .scene_hash = "",  // of messages that are not told here
                                                           .width = settings.width,
                                                           .height = settings.height,
                                                           .max_depth = settings.max_depth});
    return found ? to_viewer(*found, picture, settings) : nullptr;
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
    return to_viewer(outcome.reference, picture_key(session.scene_hash(), settings), settings);
}

References::References(const ModelServices& services, const RenderControls& render, const ViewedScene& scene)
    : options_(services.options), messages_(services.messages), jobs_(services.jobs), link_(services.link),
      render_(render), scene_(scene) {}

const ReferencePicture* References::current() const {
    return reference_ && reference_->picture == link_.status().picture ? &*reference_ : nullptr;
}

std::optional<ReferenceJob::Progress> References::progress() const {
    return job_ ? std::optional(job_->progress()) : std::nullopt;
}

void References::update() {
    look_up();
    take_result();
}

/// Once for every new picture in the window.
void References::look_up() {
    const std::uint64_t picture = link_.status().picture;
    if (picture == 0 || picture == looked_up_) return;
    looked_up_ = picture;
    if (current() != nullptr) return;
    jobs_.push([this, picture, settings = render_.settings()]() -> Jobs::Report {
        const auto found = find_stored_reference(options_.reference_dir, picture, settings);
        if (!found) return {};
        return [this, found] { adopt(found); };
    });
}

/// A reference of another picture is kept until that picture is in the window again; errors are never measured
/// against it.
void References::adopt(const std::shared_ptr<const StoredReference>& found) {
    const LiveReference& halves = found->halves;
    const std::vector<Vec3f> mean = weighted_mean(halves.first, found->spp[0], halves.second, found->spp[1]);
    reference_ = ReferencePicture{
        .picture = halves.picture,
        .pixels = std::make_shared<const HalfPicture>(half_picture(halves.width, halves.height, mean)),
        .label = fmt::format("reference  {} + {} spp", found->spp[0], found->spp[1]),
        .noise_relmse = found->noise_relmse};
    link_.worker().set_reference({found, &found->halves});
    messages_.say(MessageLevel::Info,
                  fmt::format("{}, its noise as relMSE is {:.2g}", reference_->label, found->noise_relmse));
}

void References::make() {
    if (job_) return;
    if (link_.status().picture == 0) {
        messages_.say(MessageLevel::Info, "a reference needs a camera at rest: wait for the first pass");
        return;
    }
    link_.end_turns(render_.method());
    job_ = std::make_unique<ReferenceJob>([this, scene = scene_.rendered(),
                                           settings = render_.settings()](const JobMonitor& monitor) {
        return make_stored_reference(options_.reference_dir, scene, settings, options_.make_side_backend, monitor);
    });
    link_.hold(RenderLink::Hold::Reference, true);
    messages_.say(MessageLevel::Info, "rendering the reference: Esc ends it and keeps its samples");
}

void References::stop() {
    if (job_) job_->stop();
}

void References::take_result() {
    if (!job_) return;
    const auto result = job_->take_result();
    if (!result) return;
    job_.reset();
    link_.hold(RenderLink::Hold::Reference, false);
    if (!result->failure.empty())
        messages_.say(MessageLevel::Error, "the reference could not be rendered: " + result->failure);
    else if (result->value)
        adopt(result->value);
    else
        messages_.say(MessageLevel::Info, "the reference was ended before both halves had samples");
}

}  // namespace pl::ui
