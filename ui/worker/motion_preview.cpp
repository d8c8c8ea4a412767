#include "ui/worker/motion_preview.h"

namespace pl::ui {
namespace {

/// The method whose map can be shown without rendering more for it: one that has learned from a pass, or that is complete.
std::optional<MethodId> learned_method(const Session& session) {
    for (const MethodInfo& method : all_methods()) {
        const auto field = session.field_status(method.id);
        if (field && field->passes > 0 && field->precomputed_share >= 1.0) return method.id;
    }
    return std::nullopt;
}

/// Whether emptying the fields would lose nothing.
bool has_learned_nothing(const Session& session) {
    for (const MethodInfo& method : all_methods()) {
        const auto field = session.field_status(method.id);
        if (field && (field->records > 0 || field->passes > 0)) return false;
    }
    return true;
}

}  // namespace

const char* name_of(Preview preview) {
    switch (preview) {
    case Preview::None: return "none";
    case Preview::LightSamples: return "light samples";
    case Preview::RadianceMap: return "radiance map";
    }
    return "";
}

Preview MotionPreview::choose(const Session& session, FilmSlot film, Preview now) {
    const bool samples_lights = session.settings().next_event && now != Preview::LightSamples;
    if (film.view != View::Beauty || info_of(film.method).uses_field || samples_lights) return Preview::None;
    if (learned_method(session)) return Preview::RadianceMap;
    return has_learned_nothing(session) ? Preview::LightSamples : Preview::None;
}

bool MotionPreview::apply(Session& session, Preview wanted) {
    if (wanted == now_) return false;
    if (now_ == Preview::LightSamples) session.apply(own_);
    const bool is_emptied = now_ == Preview::LightSamples || wanted == Preview::LightSamples;
    now_ = Preview::None;
    if (wanted == Preview::LightSamples) {
        const RenderSettings& settings = session.settings();
        own_ = {settings.max_depth, settings.next_event, settings.roulette, settings.guiding};
        EditEstimator edit = own_;
        edit.next_event = true;
        session.apply(edit);
    }
    now_ = wanted;
    return is_emptied;
}

FilmSlot MotionPreview::slot(const Session& session, FilmSlot film) const {
    if (now_ != Preview::RadianceMap) return film;
    // A film of the method that learns would train it further; the baseline's shows the same field.
    const MethodId owner = learned_method(session).value_or(learning_method());
    return {info_of(owner).learns ? baseline_method() : owner, View::RadianceMap};
}

}  // namespace pl::ui
