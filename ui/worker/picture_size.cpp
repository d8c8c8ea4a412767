#include "ui/worker/picture_size.h"

#include <algorithm>

namespace pl::ui {

void MotionResolution::observe(int divider, double seconds) {
    if (!(seconds > 0.0)) return;
    // A pass takes time in proportion to its pixels.
    const auto predicted = [&](int other) {
        const double ratio = static_cast<double>(divider) / other;
        return seconds * ratio * ratio;
    };
    if (predicted(divider_) > kTargetSeconds * (1.0 + kDeadBand)) {
        while (divider_ < kMaxDivider && predicted(divider_) > kTargetSeconds) divider_ *= 2;
    } else {
        while (divider_ > 1 && predicted(divider_ / 2) < kTargetSeconds * (1.0 - kDeadBand)) divider_ /= 2;
    }
}

int MotionResolution::divider_for(int width, int height) const {
    int divider = divider_;
    while (divider > 1 && std::max(width, height) / divider < kMinLongSide) divider /= 2;
    return divider;
}

void PictureSize::resize(int width, int height) {
    width_ = width;
    height_ = height;
    divider_ = 0;
}

bool PictureSize::apply(Session& session, bool is_coarse, Session* second) {
    const int divider = is_coarse ? motion_.divider_for(width_, height_) : 1;
    if (divider == divider_) return false;
    divider_ = divider;
    const EditSize size{divided(width_, divider), divided(height_, divider)};
    if (session.settings().width == size.width && session.settings().height == size.height) return false;
    session.apply(size);
    if (second != nullptr) second->apply(size);
    return true;
}

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
