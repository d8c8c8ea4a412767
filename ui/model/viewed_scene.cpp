#include "ui/model/viewed_scene.h"

#include <exception>
#include <filesystem>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/scene/instances.h"
#include "core/scene/pack_scene.h"
#include "core/scene/validate.h"

namespace pl::ui {

const LoadOrder* SceneLoader::newest() const {
    if (waiting_) return &*waiting_;
    return running_ ? &*running_ : nullptr;
}

void SceneLoader::load(LoadOrder order) {
    if (running_)
        waiting_ = std::move(order);
    else
        start(std::move(order));
}

void SceneLoader::start(LoadOrder order) {
    running_ = std::move(order);
    jobs_.push([this, request = running_->scene]() -> Jobs::Report {
        std::shared_ptr<const SceneDescription> scene;
        std::string failure;
        try {
            scene = options_.load_scene(request);
        } catch (const std::exception& error) {
            failure = error.what();
        }
        return [this, scene, failure] { end(scene, failure); };
    });
}

void SceneLoader::end(std::shared_ptr<const SceneDescription> scene, const std::string& failure) {
    const LoadOrder ended = *std::exchange(running_, std::nullopt);
    const bool is_stale = waiting_ && waiting_->reason == LoadReason::Open;
    if (waiting_) start(*std::exchange(waiting_, std::nullopt));
    if (!is_stale) finish_(ended, std::move(scene), failure);
}

void EditedMaterials::open(std::shared_ptr<const SceneDescription> file) {
    file_ = std::move(file);
    now_ = file_->materials;
}

void EditedMaterials::reopen(std::shared_ptr<const SceneDescription> file) {
    const std::vector<MaterialDescription> before = now_;
    std::vector<std::uint32_t> edited;
    for (std::uint32_t i = 0; i < now_.size(); ++i)
        if (is_edited(i)) edited.push_back(i);
    open(std::move(file));
    for (const std::uint32_t i : edited) {
        if (i >= now_.size() || now_[i].name != before[i].name) continue;
        try {
            set(i, before[i]);
        } catch (const Error&) {
            continue;  // a texture of the edited material is gone
        }
    }
}

std::vector<std::string> EditedMaterials::edited_names() const {
    std::vector<std::string> names;
    for (std::uint32_t i = 0; i < now_.size(); ++i)
        if (is_edited(i)) names.push_back(shown_name(now_[i], i));
    return names;
}

std::vector<MaterialDescription> EditedMaterials::named() const {
    std::vector<MaterialDescription> named;
    std::set<std::string> names;
    for (const MaterialDescription& material : now_)
        if (!material.name.empty() && names.insert(material.name).second) named.push_back(material);
    return named;
}

bool EditedMaterials::are_edits_named() const {
    std::set<std::string> names;
    for (std::uint32_t i = 0; i < now_.size(); ++i) {
        const bool is_named = !now_[i].name.empty() && names.insert(now_[i].name).second;
        if (!is_named && is_edited(i)) return false;
    }
    return true;
}

void EditedMaterials::set(std::uint32_t index, const MaterialDescription& material) {
    validate_material(material, index, *file_);
    now_[index] = material;
}

std::string shown_name(const MaterialDescription& material, std::uint32_t index) {
    return material.name.empty() ? fmt::format("material {}", index) : material.name;
}

namespace {

/// Means the same in every working directory.
std::string lasting(const std::string& name) {
    const std::filesystem::path path(name);
    return path.has_extension() ? std::filesystem::absolute(path).lexically_normal().string() : name;
}

/// All files that decide the scene.
std::vector<std::filesystem::path> files_of(const SceneDescription& scene) {
    std::vector<std::filesystem::path> files = scene.files;
    for (const TextureDescription& texture : scene.textures) files.push_back(texture.source);
    if (!scene.environment_map.source.empty()) files.push_back(scene.environment_map.source);
    return files;
}

}  // namespace

ViewedScene::ViewedScene(const ModelServices& services, CameraMotion& camera, Selection& selection,
                         std::shared_ptr<const SceneDescription> scene)
    : messages_(services.messages), link_(services.link), camera_(camera), selection_(selection),
      name_(services.options.scene_name), materials_(scene), knobs_(scene->knobs),
      loader_(services, [this](const LoadOrder& order, std::shared_ptr<const SceneDescription> loaded,
                               const std::string& failure) { finish(order, std::move(loaded), failure); }) {
    recent_.add(lasting(name_));
    watch_.watch(files_of(*scene));
}

std::string ViewedScene::lasting_name() const { return lasting(name_); }

void ViewedScene::update() {
    const auto changed = watch_.take_change();
    if (changed && !is_opening()) load({{name_, turned(knobs_)}, LoadReason::Change, changed->filename().string()});
}

void ViewedScene::remember(const std::vector<std::string>& recent) {
    recent_.set(recent);
    recent_.add(lasting(name_));
}

KnobValues ViewedScene::turned(const std::vector<KnobDescription>& knobs) {
    KnobValues values;
    for (const KnobDescription& knob : knobs)
        if (knob.value != knob.default_value) values.emplace_back(knob.name, knob.value);
    return values;
}

void ViewedScene::reload() {
    if (!is_opening()) load({{name_, turned(knobs_)}, LoadReason::Reload});
}

void ViewedScene::open(const std::string& name) { load({{name, {}}, LoadReason::Open}); }

void ViewedScene::set_knob(std::size_t index, float value) {
    if (is_opening() || index >= knobs_.size() || knobs_[index].value == value) return;
    knobs_[index].value = value;
    load_knobs();
}

void ViewedScene::reset_knobs() {
    if (is_opening() || turned(knobs_).empty()) return;
    for (KnobDescription& knob : knobs_) knob.value = knob.default_value;
    load_knobs();
}

bool ViewedScene::is_opening() const {
    const LoadOrder* order = loader_.newest();
    return order != nullptr && order->reason == LoadReason::Open;
}

void ViewedScene::load(LoadOrder order) {
    if (order.reason == LoadReason::Open || order.reason == LoadReason::Reload)
        messages_.note(MessageLevel::Info, "loading " + order.scene.name);
    loader_.load(std::move(order));
}

void ViewedScene::finish(const LoadOrder& order, std::shared_ptr<const SceneDescription> scene,
                         const std::string& failure) {
    if (scene == nullptr)
        messages_.say(MessageLevel::Error,
                      order.changed.empty()
                          ? failure
                          : fmt::format("{} has changed, but the old scene stays: {}", order.changed, failure));
    else if (order.reason == LoadReason::Knobs || order.reason == LoadReason::Change)
        adopt_again(order, std::move(scene));
    else
        adopt(order, std::move(scene));
    // Newer values of the user are on their way otherwise.
    if (loader_.newest() == nullptr) knobs_ = materials_.file()->knobs;
}

void ViewedScene::adopt(const LoadOrder& order, std::shared_ptr<const SceneDescription> scene) {
    if (order.reason == LoadReason::Open) {
        selection_.deselect();
        selection_.pins().clear();
        selection_.drop_material();
    }
    materials_.open(scene);
    watch_.watch(files_of(*scene));
    name_ = order.scene.name;
    recent_.add(lasting(name_));
    camera_.open(scene->camera, bounds_of(*scene).diagonal(), order.reason == LoadReason::Reload);
    for (const std::string& warning : scene->warnings) messages_.say(MessageLevel::Warning, warning);
    messages_.say(MessageLevel::Info, fmt::format("opened {}: {} triangles", name_, shown_triangles(*scene)));
    link_.worker().submit_together({EditScene{std::move(scene)}, EditCamera{camera_.camera()}});
}

void ViewedScene::adopt_again(const LoadOrder& order, std::shared_ptr<const SceneDescription> scene) {
    materials_.reopen(scene);
    watch_.watch(files_of(*scene));
    if (!order.changed.empty()) {
        for (const std::string& warning : scene->warnings) messages_.say(MessageLevel::Warning, warning);
        messages_.say(MessageLevel::Info, fmt::format("{} has changed: loaded again", order.changed));
    }
    camera_.open(scene->camera, bounds_of(*scene).diagonal(), true);
    camera_.touch();
    std::vector<WorkerEdit> edits{EditScene{std::move(scene)}};
    for (std::uint32_t i = 0; i < materials_.now().size(); ++i)
        if (materials_.is_edited(i)) edits.push_back(EditMaterial{i, materials_.now()[i]});
    edits.push_back(EditCamera{camera_.camera()});
    link_.worker().submit_together(std::move(edits));
}

std::optional<std::uint32_t> ViewedScene::selected_material() const {
    const auto index = selection_.material();
    return index && *index < materials_.now().size() ? index : std::nullopt;
}

void ViewedScene::select_material(std::uint32_t index) {
    if (index < materials_.now().size()) selection_.select_material(index);
}

void ViewedScene::set_material(std::uint32_t index, const MaterialDescription& material) {
    if (index >= materials_.now().size()) return;
    const MaterialDescription before = materials_.now()[index];
    if (material == before) return;
    try {
        materials_.set(index, material);
    } catch (const Error& error) {
        messages_.say(MessageLevel::Error, error.what());
        return;
    }
    camera_.touch();
    link_.worker().submit(EditMaterial{index, material});
}

void ViewedScene::restore_material(std::uint32_t index) {
    if (index < materials_.now().size()) set_material(index, materials_.in_file(index));
}

void ViewedScene::restore_materials() {
    for (std::uint32_t i = 0; i < materials_.now().size(); ++i) restore_material(i);
}

}  // namespace pl::ui
