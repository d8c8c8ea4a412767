#include "ui/worker/recorder.h"

#include <fmt/format.h>

#include "core/measure/picture_identity.h"
#include "core/session/choices.h"

namespace pl::ui {
namespace {

/// Changed settings that distinguish runs of a method on the same picture.
std::string details_of(const Session& session, FilmSlot slot) {
    const RenderSettings& settings = session.settings();
    const RenderSettings standard;
    std::string text;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
    if (settings.roulette != standard.roulette) add(fmt::format("roulette {}", name_of(settings.roulette)));
    if (!info_of(slot.method).uses_field) return text;
    if (settings.guiding != standard.guiding) add(fmt::format("guiding {}", name_of(settings.guiding)));
    FieldSettings field = settings.field;
    if (field.volumes != standard.field.volumes) add(fmt::format("{} volumes", field.volumes));
    if (field.bins != standard.field.bins) add(fmt::format("{} bins", field.bins));
    if (field.refine_share != standard.field.refine_share)
        add(field.refine_share == 0.0f ? "not refined" : fmt::format("refined by {:g}", field.refine_share));
    field.refine_share = standard.field.refine_share;
    field.volumes = standard.field.volumes;
    field.bins = standard.field.bins;
    if (!(field == standard.field) || !(settings.mixture == standard.mixture)) add("other learning");
    return text;
}

}  // namespace

Recorder::Recorder() : runs_(kPictureBytes, details_of) {}

/// Hashing a scene takes its time: only when all films were emptied.
bool Recorder::observe(const Session& session, FilmSlot slot) {
    const FilmOrigin origin = session.film_origin(slot);
    if (origin.number != 0 && (picture_ == 0 || origin.generation != generation_)) {
        generation_ = origin.generation;
        picture_ = picture_key(session.scene(), session.settings());
    }
    return runs_.observe(session, slot);
}

void Recorder::set_reference(std::shared_ptr<const LiveReference> reference) {
    reference_ = std::move(reference);
    runs_.set_reference(reference_);
}

}  // namespace pl::ui
