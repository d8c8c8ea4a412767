#include "ui/worker/recorder.h"

#include <fmt/format.h>

#include "core/fields/field_choices.h"
#include "core/measure/picture_identity.h"
#include "core/session/choices.h"

namespace pl::ui {
std::string details_of(const RenderSettings& settings, MethodId method) {
    const RenderSettings standard;
    std::string text;
    const auto add = [&](bool is_other, const std::string& part) {
        if (is_other) text += (text.empty() ? "" : ", ") + part;
    };
    const MethodInfo& info = info_of(method);
    const FieldSettings& field = settings.field;
    const FieldSettings& usual = standard.field;
    const MixtureSettings& mixture = settings.mixture;
    if (info.learns) add(field.representation != usual.representation, std::string(label_of(field.representation)));
    if (info.uses_field) {
        add(field.volumes != usual.volumes, fmt::format("{} volumes", field.volumes));
        add(field.bins != usual.bins, fmt::format("{} bins", field.bins));
        add(field.budget_megabytes != usual.budget_megabytes, fmt::format("{:g} MB", field.budget_megabytes));
        add(field.uniform_floor != usual.uniform_floor, fmt::format("floor {:g}", field.uniform_floor));
        add(mixture.learned == 0 || mixture.bsdf_fraction != standard.mixture.bsdf_fraction,
            fmt::format("BSDF share {}{:g}", mixture.learned != 0 ? "from " : "", mixture.bsdf_fraction));
        add(mixture.learned_lights == 0, "lights not learned");
        add(settings.guiding != standard.guiding, fmt::format("guiding {}", name_of(settings.guiding)));
    }
    if (info.precomputes)
        add(field.precompute_samples != usual.precompute_samples, fmt::format("{} probes", field.precompute_samples));
    if (info.learns) {
        add(field.refine_share == 0.0f, "not refined");
        add(field.refine_share != usual.refine_share && field.refine_share != 0.0f,
            fmt::format("refined by {:g}", field.refine_share));
        add(field.rate != usual.rate, fmt::format("rate {}", name_of(field.rate)));
        add(field.learning.target != usual.learning.target, std::string(label_of(field.learning.target)));
        add(field.learning.light != usual.learning.light,
            fmt::format("learns {} light", name_of(field.learning.light)));
    }
    add(settings.roulette != standard.roulette, fmt::format("roulette {}", name_of(settings.roulette)));
    return text;
}

std::string method_text(const RenderSettings& settings, MethodId method) {
    const std::string details = details_of(settings, method);
    return std::string(info_of(method).label) + (details.empty() ? "" : " (" + details + ")");
}

Recorder::Recorder()
    : runs_(kPictureBytes,
            [](const Session& session, FilmSlot slot) { return details_of(session.settings(), slot.method); }) {}

/// Hashing a scene takes its time: only when all films were emptied.
bool Recorder::observe(const Session& session, FilmSlot slot, bool is_last) {
    const FilmOrigin origin = session.film_origin(slot);
    if (origin.number != 0 && (picture_ == 0 || origin.generation != generation_)) {
        generation_ = origin.generation;
        picture_ = picture_key(session.scene_hash(), session.settings());
    }
    return runs_.observe(session, slot, is_last);
}

void Recorder::set_reference(std::shared_ptr<const LiveReference> reference) {
    reference_ = std::move(reference);
    runs_.set_reference(reference_);
}

}  // namespace pl::ui
