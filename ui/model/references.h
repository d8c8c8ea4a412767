// References of the picture in the window: looked up when it changes, and rendered in the background.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "core/session/backend.h"
#include "ui/compare/sides.h"
#include "ui/model/jobs.h"
#include "ui/model/render_controls.h"
#include "ui/model/render_link.h"
#include "ui/model/viewed_scene.h"
#include "ui/viewer.h"

namespace pl::ui {

// References of the picture in the window: found in a folder, and made there.

/// The stored reference of a picture_key(), of these settings; null if there is none with samples in both halves. Throws
/// Error(Input) for files that are damaged or whose content differs from the one in their name.
std::shared_ptr<const StoredReference> find_stored_reference(const std::filesystem::path& folder,
                                                             std::uint64_t picture, const RenderSettings& settings);

/// Continues it on the CPU, by path tracing with next-event estimation, until it is converged or the monitor stops it; with
/// samples in both halves either way.
std::shared_ptr<const StoredReference> make_stored_reference(const std::filesystem::path& folder,
                                                             const OpenScene& scene, const RenderSettings& settings,
                                                             const BackendFactory& make_backend,
                                                             const JobMonitor& monitor);

class References {
public:
    References(const ModelServices& services, const RenderControls& render, const ViewedScene& scene);

    /// Once per frame of the window: looks a reference up for a new picture, takes the one that was rendered.
    void update();

    /// The reference of the picture in the window; null without one.
    const ReferencePicture* current() const;

    /// Renders a reference of the picture, or continues the stored one. Rendering of the picture rests meanwhile.
    void make();
    /// Ends the rendering of the reference; its samples so far are stored and used.
    void stop();
    bool is_making() const { return job_ != nullptr; }
    std::optional<ReferenceJob::Progress> progress() const;

private:
    void look_up();
    void take_result();
    void adopt(const std::shared_ptr<const StoredReference>& found);

    const ViewerOptions& options_;
    Messages& messages_;
    Jobs& jobs_;
    RenderLink& link_;
    const RenderControls& render_;
    const ViewedScene& scene_;
    std::optional<ReferencePicture> reference_;  ///< the newest; may be of another picture
    std::uint64_t looked_up_ = 0;                ///< picture of the newest look-up
    std::unique_ptr<ReferenceJob> job_;
};

}  // namespace pl::ui
