// Cameras of the open scene that the user keeps, with small pictures, in a folder from one start to the next; at first those that
// its file lists. In their order they are a camera path.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/io/image.h"
#include "core/scene/camera_path.h"
#include "ui/model/viewed_scene.h"

namespace pl::ui {

class CameraBookmarks {
public:
    struct Bookmark {
        CameraDescription camera;
        std::shared_ptr<const ByteImage> picture{};  ///< null if there is none
    };

    CameraBookmarks(const ModelServices& services, const ViewedScene& scene, CameraMotion& camera)
        : messages_(services.messages), jobs_(services.jobs), link_(services.link), scene_(scene), camera_(camera) {}

    /// The folder of the files; empty: bookmarks last as long as the scene is open.
    void set_folder(std::filesystem::path folder);
    /// Once per frame of the window: takes the bookmarks of a scene that was opened.
    void update();

    const std::vector<Bookmark>& list() const { return list_; }
    /// The one that was added or shown last; empty for none.
    std::optional<std::size_t> current() const { return current_; }
    /// The camera of the window, behind the current one, with the picture that is shown.
    void add();
    void show(std::size_t index);
    /// The next bookmark, or the one before, in a circle.
    void step(int steps);
    void remove(std::size_t index);
    /// One place towards the front (-1) or the end (1).
    void move(std::size_t index, int places);

    /// All cameras in their order.
    std::vector<CameraDescription> cameras() const;
    /// Empty with fewer than two bookmarks.
    std::optional<CameraPath> path() const;
    /// The file with the cameras, as load_cameras() reads it; empty without a folder.
    std::filesystem::path file() const;

private:
    std::filesystem::path picture_file(const CameraDescription& camera) const;
    void load();
    void save();

    Messages& messages_;
    Jobs& jobs_;
    RenderLink& link_;
    const ViewedScene& scene_;
    CameraMotion& camera_;
    std::filesystem::path folder_;
    std::string of_;  ///< scene of the list
    std::vector<Bookmark> list_;
    std::optional<std::size_t> current_;
};

/// A picture of kThumbnailWidth x kThumbnailHeight that shows a frame, with black borders if it has another shape. Throws as
/// DisplayFrame::pixels().
ByteImage small_picture(const DisplayFrame& frame);

}  // namespace pl::ui
