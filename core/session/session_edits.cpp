// The part of Session that applies edits.
#include "core/base/error.h"
#include "core/base/timer.h"
#include "core/fields/same_placement.h"
#include "core/scene/pack_scene.h"
#include "core/scene/validate.h"
#include "core/session/session.h"

namespace pl {
namespace {

/// Copies the new values of an edit into the settings; scene and commands have none.
struct Assign {
    RenderSettings& settings;

    void operator()(const EditCamera& edit) const { settings.camera = edit.camera; }
    void operator()(const EditSize& edit) const {
        settings.width = edit.width;
        settings.height = edit.height;
    }
    void operator()(const EditMethod& edit) const { settings.method = edit.method; }
    void operator()(const EditView& edit) const { settings.view = edit.view; }
    void operator()(const EditSeed& edit) const { settings.seed = edit.seed; }
    void operator()(const EditEstimator& edit) const {
        settings.max_depth = edit.max_depth;
        settings.next_event = edit.next_event;
        settings.roulette = edit.roulette;
    }
    void operator()(const EditMixture& edit) const { settings.mixture = edit.mixture; }
    void operator()(const EditField& edit) const { settings.field = edit.field; }
    void operator()(const EditScene& edit) const { settings.camera = edit.scene->camera; }
    void operator()(const EditMaterial&) const {}
    void operator()(const EditEffects& edit) const { settings.forced_effects = edit.forced; }
    void operator()(const EditBackend&) const {}
    void operator()(const EditRestart&) const {}
    void operator()(const EditForget&) const {}
    void operator()(const EditLearned& edit) const { settings.method = edit.field->method; }
};

/// Do the sizes of all arrays agree?
bool fits_together(const LearnedField& field) {
    if (field.volumes == nullptr || field.shape.cells.side < 1) return false;
    const std::size_t volumes = field.volumes->normals.size();
    return field.volumes->sites.size() == volumes && field.volumes->kd_nodes.size() <= volumes &&
           field.refinement.added <= volumes && fits(field.shape, field.field, volumes);
}

}  // namespace

void Session::apply(const SessionEdit& edit) {
    if (const auto* change = std::get_if<EditLearned>(&edit)) import_field(*change->field);
    if (const auto* change = std::get_if<EditBackend>(&edit)) switch_backend(*change);
    if (const auto* change = std::get_if<EditMaterial>(&edit)) change_material(*change);
    const Invalidation clear = invalidated_by(edit);
    std::visit(Assign{settings_}, edit);
    if (const auto* change = std::get_if<EditScene>(&edit)) scene_ = change->scene;
    if (clear.films) clear_films();
    if (clear.tables) clear_tables();
    if (clear.volumes) volumes_.reset();
    if (clear.scene) load_scene();
}

/// All is made ready first, so that nothing has changed if the material is refused or the back end fails.
void Session::change_material(const EditMaterial& edit) {
    if (edit.index >= scene_->materials.size())
        throw Error(ErrorKind::Usage, "material " + std::to_string(edit.index) + " does not exist: expected 0 to " +
                                          std::to_string(scene_->materials.size()) + " (exclusive)");
    validate_material(edit.material, *scene_);
    auto scene = std::make_shared<SceneDescription>(*scene_);
    scene->materials[edit.index] = edit.material;
    auto packed = std::make_shared<const HostScene>(repack_materials(*scene, *packed_));
    backend_->upload_scene(packed);
    if (!same_placement(*packed_, *packed)) volumes_.reset();
    scene_ = std::move(scene);
    packed_ = std::move(packed);
    enclosure_.reset();
    if (volumes_) shape_ = make_field_shape(*packed_, settings_.field);  // lights may be brighter
}

void Session::clear_films() {
    ++film_generation_;
    is_closed_.reset();
    films_.fill(FilmState{});
    for (ParkedBackend& parked : parked_) parked.films.fill(FilmState{});
}

/// The new back end is made ready first, so that nothing has changed if it fails; but it is forgotten then, because nobody
/// knows what it still holds.
void Session::switch_backend(const EditBackend& edit) {
    if (edit.backend == backend_) return;
    std::vector<std::pair<MethodId, HostField>> learned;
    if (!edit.abandon_old && volumes_)  // without volumes, tables are left over from others
        for (const MethodInfo& method : all_methods())
            if (backend_->has_field(method.id))
                learned.emplace_back(method.id, backend_->download_field(method.id));
    ParkedBackend next = unpark(edit.backend);
    const Stopwatch upload;
    if (next.scene != packed_) next.backend->upload_scene(packed_);
    if (volumes_) next.backend->upload_volumes(volumes_, shape_);
    for (auto& [method, tables] : learned) next.backend->upload_field(method, std::move(tables));
    upload_seconds_ = upload.seconds();
    if (!edit.abandon_old && !edit.forget_old) parked_.push_back({backend_, films_, packed_});
    backend_ = std::move(next.backend);
    films_ = next.films;
}

/// Takes a back end out of those that wait.
Session::ParkedBackend Session::unpark(const std::shared_ptr<RenderBackend>& backend) {
    ParkedBackend result{.backend = backend, .films = {}, .scene = nullptr};
    for (const ParkedBackend& parked : parked_)
        if (parked.backend == backend) result = parked;
    std::erase_if(parked_, [&](const ParkedBackend& parked) { return parked.backend == backend; });
    return result;
}

void Session::clear_tables() {
    fields_.fill(FieldProgress{});
    if (refinement_.added > 0) volumes_.reset();  // what is forgotten decided where these stand
    refinement_ = {};
    if (volumes_) backend_->upload_volumes(volumes_, shape_);
}

void Session::import_field(LearnedField learned) {
    require_learned_in(*scene_, learned);
    if (!info_of(learned.method).uses_field || !fits_together(learned))
        throw Error(ErrorKind::Input, "the field's volumes and tables do not fit together");
    const std::shared_ptr<const HostVolumes> volumes = with_lookup(*learned.volumes, learned.shape.lookup);
    backend_->upload_volumes(volumes, learned.shape);
    backend_->upload_field(learned.method, std::move(learned.field));
    settings_.field = learned.settings;
    shape_ = learned.shape;
    volumes_ = volumes;
    refinement_ = learned.refinement;
    fields_.fill(FieldProgress{});
    fields_[static_cast<std::size_t>(learned.method)] = learned.progress;
    clear_films();
}

}  // namespace pl
