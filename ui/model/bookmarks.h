// Cameras that are kept, and flights along them.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/io/image.h"
#include "core/scene/camera_path.h"
#include "ui/model/files.h"
#include "ui/model/viewed_scene.h"

namespace pl::ui {

/// Cameras of the open scene that the user keeps, with small pictures, in a folder from one start to the next; at first those that
/// its file lists. In their order they are a camera path.
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

// The path through the bookmarks, played in the window, and written as a sequence of pictures.

/// Plays the path live.
class CameraFlight {
public:
    CameraFlight(const CameraBookmarks& bookmarks, CameraMotion& camera, Messages& messages)
        : bookmarks_(bookmarks), camera_(camera), messages_(messages) {}

    bool is_flying() const { return path_.has_value(); }
    /// Begins at the first bookmark, or stops.
    void toggle();
    void stop() { path_.reset(); }
    /// Once per frame of the window, with its clock. Stops at the end, and when something else moves the camera.
    void update(double seconds);

    float& seconds_per_camera() { return seconds_per_camera_; }

private:
    const CameraBookmarks& bookmarks_;
    CameraMotion& camera_;
    Messages& messages_;
    std::optional<CameraPath> path_;
    std::optional<double> start_;
    std::uint64_t generation_ = 0;  ///< of its last camera
    float seconds_per_camera_ = 2.0f;
};

/// Writes the path frame by frame, and a film of PNG frames: each is rendered in the window, with learning that goes on from one to
/// the next.
class SequenceWriter {
public:
    static constexpr int kFramesPerSecond = 24;  ///< of the film

    struct Options {
        int frames = 48;
        int spp = 64;          ///< of each frame; 0: no limit
        float seconds = 0.0f;  ///< of work for each frame; 0: no limit. The first limit that is met ends a frame
        ImageKind kind = ImageKind::Png;
    };
    struct Written {
        int written = 0;
        int frames = 0;
    };

    SequenceWriter(const ModelServices& services, const CameraBookmarks& bookmarks, CameraMotion& camera,
                   RenderControls& render, PictureFiles& pictures)
        : viewer_(services.options), messages_(services.messages), jobs_(services.jobs), link_(services.link),
          bookmarks_(bookmarks), camera_(camera), render_(render), pictures_(pictures) {}

    Options& options() { return wanted_; }
    /// Says why if it cannot.
    void begin();
    /// The frame under way is lost; those before stay.
    void stop();
    std::optional<Written> progress() const;
    /// Once per frame of the window. Stops when something else moves the camera.
    void update();
    const std::filesystem::path& folder() const { return folder_; }

private:
    void show_frame();
    bool is_frame_done() const;
    std::filesystem::path file() const;
    std::filesystem::path path_file() const;
    SampleLimits limits_of_frame() const;
    void finish();
    std::string command() const;

    const ViewerOptions& viewer_;
    Messages& messages_;
    Jobs& jobs_;
    RenderLink& link_;
    const CameraBookmarks& bookmarks_;
    CameraMotion& camera_;
    RenderControls& render_;
    PictureFiles& pictures_;
    NumberedNames names_;
    Options wanted_;
    Options now_;
    std::optional<CameraPath> path_;
    std::filesystem::path folder_;
    SampleLimits limits_before_;
    int written_ = 0;
    bool is_saving_ = false;
    std::uint64_t generation_ = 0;  ///< of its last camera
};

}  // namespace pl::ui
