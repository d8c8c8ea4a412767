// The path through the bookmarks, played in the window, and written as a sequence of pictures.
#pragma once

#include <filesystem>
#include <optional>

#include "ui/model/camera_bookmarks.h"
#include "ui/model/picture_files.h"

namespace pl::ui {

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

/// Writes the path frame by frame: each is rendered in the window, with learning that goes on from one to the next.
class SequenceWriter {
public:
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
        : viewer_(services.options), messages_(services.messages), link_(services.link), bookmarks_(bookmarks),
          camera_(camera), render_(render), pictures_(pictures) {}

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
