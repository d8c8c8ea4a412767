#include "ui/model/field_flowers.h"

#include <algorithm>
#include <cmath>

#include "ui/draw/direction_disc.h"

namespace pl::ui {

void LearningTime::send_limit() {
    const std::size_t kept = keeps_ ? static_cast<std::size_t>(megabytes_) << 20 : 0;
    link_.worker().set_history_limit(kept > 0 || !newest_needed_ ? kept : 1);
}

void LearningTime::set_keeps(bool keeps) {
    if (keeps == keeps_) return;
    keeps_ = keeps;
    if (!keeps) {
        show(std::nullopt);
        is_playing_ = false;
    }
    send_limit();
}

void LearningTime::set_megabytes(int megabytes) {
    if (megabytes == megabytes_) return;
    megabytes_ = std::max(megabytes, 1);
    send_limit();
}

void LearningTime::set_newest_needed(bool needed) {
    if (needed == newest_needed_) return;
    newest_needed_ = needed;
    send_limit();
}

/// The shown frame stays the same one while others come and go.
void LearningTime::take_history() {
    const std::shared_ptr<const FieldHistory> history = link_.worker().history();
    if (history == history_) return;
    const FieldKeyFrame* const now = frame();
    history_ = history;
    if (now == nullptr) return;
    const auto same = std::ranges::find(history_->frames, now, [](const auto& kept) { return kept.get(); });
    if (same != history_->frames.end())
        shown_ = static_cast<std::size_t>(same - history_->frames.begin());
    else
        show(std::nullopt);
}

void LearningTime::show(std::optional<std::size_t> frame) {
    if (frame && *frame >= history_->frames.size()) frame.reset();
    if (frame == shown_) return;
    shown_ = frame;
    inspections_.clear();
}

void LearningTime::set_playing(bool playing) {
    is_playing_ = playing;
    direction_ = shown_ ? 1 : -1;
}

/// Positions 0 to n - 1 are key frames, n is the present.
void LearningTime::play(double seconds) {
    const auto last = static_cast<int>(history_->frames.size());
    if (!is_playing_ || last == 0 || seconds - stepped_ < kFrameSeconds) return;
    stepped_ = seconds;
    const int at = shown_ ? static_cast<int>(*shown_) : last;
    if (at + direction_ < 0 || at + direction_ > last) direction_ = -direction_;
    const int next = std::clamp(at + direction_, 0, last);
    show(next < last ? std::optional(static_cast<std::size_t>(next)) : std::nullopt);
}

void LearningTime::update(double seconds) {
    take_history();
    play(seconds);
}

std::shared_ptr<const VolumeInspection> LearningTime::inspection(std::int32_t volume) {
    if (frame() == nullptr || volume < 0 || static_cast<std::size_t>(volume) >= frame()->volumes()) return nullptr;
    auto& inspection = inspections_[volume];
    if (inspection == nullptr) inspection = std::make_shared<const VolumeInspection>(frame()->inspect(volume));
    return inspection;
}

FlowerField make_flowers(const FieldKeyFrame& frame, int step, float diagonal, const StopFlag* stop) {
    const std::size_t least = (frame.volumes() + kMostFlowers - 1) / kMostFlowers;
    const std::size_t every = std::max(static_cast<std::size_t>(std::max(step, 1)), least);
    const int side = frame.side();
    FlowerField field;
    const auto count = static_cast<float>(frame.volumes() / every + 1);
    // About half of the distance between neighbors, and never larger than the shape of the selected volume.
    field.radius = diagonal * std::min(0.04f, 0.7f / std::sqrt(count));
    for (std::size_t volume = 0; volume < frame.volumes() && !(stop != nullptr && *stop); volume += every) {
        const std::vector<float> density = relative_to_cosine(frame.probabilities(static_cast<std::int32_t>(volume)));
        FlowerField::Flower flower{.position = frame.position(volume), .normal = frame.normal(volume)};
        field.fine_side = std::min(FlowerField::kFine, side);
        field.coarse_side = std::min(FlowerField::kCoarse, side);
        flower.fine = coarser_cells(density, side, field.fine_side);
        flower.coarse = coarser_cells(density, side, field.coarse_side);
        field.flowers.push_back(std::move(flower));
    }
    return field;
}

void FieldFlowers::set_shown(bool shown) {
    is_shown_ = shown;
    time_.set_newest_needed(shown);
    if (shown) return;
    job_.reset();
    begun_.reset();
    flowers_.reset();
    meshes_ = {};
}

/// The shown key frame, for the present the newest.
std::shared_ptr<const FieldKeyFrame> FieldFlowers::wanted() const {
    const auto& frames = time_.history()->frames;
    if (frames.empty()) return nullptr;
    return time_.shown() ? frames[*time_.shown()] : frames.back();
}

void FieldFlowers::update() {
    if (!is_shown_) return;
    if (job_) {
        auto result = job_->take_result();
        if (!result) return;
        job_.reset();
        flowers_ = result->value->key.flowers;
        meshes_ = {*result->value, {}};
        if (meshes_[0].key.scene != nullptr) ++times_made_;
    }
    const std::shared_ptr<const FieldKeyFrame> next = wanted();
    if (next == nullptr) flowers_.reset();
    if (next == nullptr || link_.frame() == nullptr || (next == begun_ && step_ == begun_step_)) return;
    begun_ = next;
    begun_step_ = step_;
    job_ = std::make_unique<BackgroundJob<Made>>([next, step = step_, diagonal = link_.frame()->facts.diagonal,
                                                  seen_from = meshes_[0].key](const JobMonitor& monitor) {
        MeshKey key = seen_from;
        key.flowers = std::make_shared<const FlowerField>(make_flowers(*next, step, diagonal, monitor.stop));
        return std::make_shared<const Mesh>(make_mesh(std::move(key)));
    });
}

Projection FieldFlowers::MeshKey::projection() const {
    CameraDescription description;
    description.eye = camera[0];
    description.target = camera[1];
    description.up = camera[2];
    description.fov_deg = view[0];
    return {description, static_cast<int>(view[1]), static_cast<int>(view[2]), {view[3], view[4], view[5], view[6]}};
}

FieldFlowers::Mesh FieldFlowers::make_mesh(MeshKey key) {
    Mesh mesh{.key = std::move(key)};
    if (mesh.key.flowers != nullptr && mesh.key.scene != nullptr)
        mesh.triangles = std::make_shared<const ScreenMesh>(
            flower_mesh(*mesh.key.flowers, mesh.key.scene->view(), mesh.key.projection(), mesh.counts));
    return mesh;
}

std::shared_ptr<const ScreenMesh> FieldFlowers::mesh(const PublishedFrame& frame, const Rect& image) {
    const CameraDescription& camera = frame.snapshot.camera;
    const auto width = static_cast<float>(frame.snapshot.width);
    const auto height = static_cast<float>(frame.snapshot.height);
    MeshKey key{.flowers = flowers_,
                .scene = frame.scene,
                .camera = {camera.eye, camera.target, camera.up},
                .view = {camera.fov_deg, width, height, image.x, image.y, image.width, image.height}};
    for (const Mesh& mesh : meshes_)
        if (key == mesh.key) return mesh.triangles;
    if (flowers_ != nullptr) ++times_made_;
    meshes_[1] = std::move(meshes_[0]);
    meshes_[0] = make_mesh(std::move(key));
    return meshes_[0].triangles;
}

}  // namespace pl::ui
