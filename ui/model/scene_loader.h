// Loads scenes on the helper thread: one at a time, and of the requests made meanwhile only the newest.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "ui/model/services.h"

namespace pl::ui {

/// Reasons for loading a scene, which decide about the parts of the window that stay.
enum class LoadReason {
    Open,    ///< another scene
    Reload,  ///< the files again: the camera stays
    Knobs,   ///< other values of knobs: camera and edited materials stay
    Change,  ///< a file has changed: camera, knobs and edited materials stay
};

struct LoadOrder {
    SceneRequest scene;
    LoadReason reason = LoadReason::Open;
    std::string changed{};  ///< the file, for LoadReason::Change
};

class SceneLoader {
public:
    /// Called on the window's thread. `scene` is null if it cannot be loaded; `failure` says why.
    using Finish = std::function<void(const LoadOrder& order, std::shared_ptr<const SceneDescription> scene,
                                      const std::string& failure)>;

    SceneLoader(const ModelServices& services, Finish finish)
        : options_(services.options), jobs_(services.jobs), finish_(std::move(finish)) {}

    /// Replaces an order that waits. One that is being loaded is finished first, and dropped for another scene.
    void load(LoadOrder order);
    /// The newest order that is not finished; null without one.
    const LoadOrder* newest() const;

private:
    void start(LoadOrder order);
    void end(std::shared_ptr<const SceneDescription> scene, const std::string& failure);

    const ViewerOptions& options_;
    Jobs& jobs_;
    Finish finish_;
    std::optional<LoadOrder> running_;
    std::optional<LoadOrder> waiting_;
};

}  // namespace pl::ui
