// The part of Session that applies edits.
#include "core/base/timer.h"
#include "core/fields/same_placement.h"
#include "core/session/session.h"

namespace pl {
namespace {

/// Copies the new values of an edit into the settings; edits of the scene and commands have none.
struct Assign {
    RenderSettings& settings;

    void operator()(const EditCamera& edit) const { settings.camera = edit.camera; }
    void operator()(const EditSize& edit) const {
        settings.width = edit.width;
        settings.height = edit.height;
    }
    void operator()(const EditSeed& edit) const { settings.seed = edit.seed; }
    void operator()(const EditEstimator& edit) const {
        settings.max_depth = edit.max_depth;
        settings.next_event = edit.next_event;
        settings.roulette = edit.roulette;
        settings.guiding = edit.guiding;
    }
    void operator()(const EditMixture& edit) const { settings.mixture = edit.mixture; }
    void operator()(const EditField& edit) const { settings.field = edit.field; }
    void operator()(const EditScene& edit) const { settings.camera = edit.scene->camera; }
    void operator()(const EditMaterial&) const {}
    void operator()(const EditBackend&) const {}
    void operator()(const EditRestart&) const {}
    void operator()(const EditForget&) const {}
    void operator()(const EditLearned&) const {}
    void operator()(const EditLearning&) const {}
    void operator()(const EditForgetVolume&) const {}
};

}  // namespace

void Session::apply(const SessionEdit& edit) {
    if (const auto* change = std::get_if<EditLearned>(&edit)) import_field(*change->field);
    if (const auto* change = std::get_if<EditBackend>(&edit)) switch_backend(*change);
    if (const auto* change = std::get_if<EditMaterial>(&edit)) change_material(*change);
    if (const auto* change = std::get_if<EditLearning>(&edit)) control_learning(*change);
    if (const auto* change = std::get_if<EditForgetVolume>(&edit)) forget_volume(*change);
    const Invalidation clear = invalidated_by(edit);
    std::visit(Assign{settings_}, edit);
    if (clear.films) clear_films();
    if (clear.tables) clear_tables();
    if (clear.volumes) placement_.clear();
    if (clear.scene) replace_scene(std::get<EditScene>(edit));
}

/// Everything is replaced only after the changed scene is complete: a refused material or a failing back end changes
/// nothing.
void Session::change_material(const EditMaterial& edit) {
    SessionScene changed = scene_.with_material(edit.index, edit.material);
    backend_->upload_scene(changed.packed());
    const bool is_same = same_placement(*scene_.packed(), *changed.packed());
    scene_ = std::move(changed);
    placement_.change_materials(*scene_.packed(), settings_.field, is_same);
}

void Session::clear_films() {
    films_.clear();
    scene_.forget_whether_closed();
}

/// The new back end receives everything before it replaces the old one, so that a failure changes nothing. Its parked
/// films are dropped then, because its contents are unknown.
void Session::switch_backend(const EditBackend& edit) {
    if (edit.backend == backend_) return;
    std::vector<std::pair<MethodId, HostField>> learned;
    if (!edit.abandon_old && placement_.is_placed())  // without volumes, tables are left over from others
        for (const MethodInfo& method : all_methods())
            if (backend_->has_field(method.id)) learned.emplace_back(method.id, backend_->download_field(method.id));
    ParkedBackend next = films_.unpark(edit.backend);
    const Stopwatch upload;
    if (next.scene != scene_.packed()) next.backend->upload_scene(scene_.packed());
    if (placement_.is_placed()) next.backend->upload_volumes(placement_.volumes(), placement_.shape());
    for (auto& [method, tables] : learned) next.backend->upload_field(method, std::move(tables));
    upload_seconds_ = upload.seconds();
    if (!edit.abandon_old && !edit.forget_old) films_.park(backend_, scene_.packed());
    backend_ = next.backend;
    films_.resume(next);
}

}  // namespace pl
