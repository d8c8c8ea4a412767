#include "ui/model/scene_loader.h"

#include <exception>
#include <utility>

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
    jobs_.push([this, request = running_->scene]() -> JobThread::Report {
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

}  // namespace pl::ui
