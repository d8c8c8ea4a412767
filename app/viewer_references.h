// References for the viewer: found in a folder, and made there.
#pragma once

#include <filesystem>
#include <memory>

#include "ui/viewer.h"

namespace pl {

/// Where the viewer keeps references, relative to the working directory, as it does its pictures.
inline constexpr const char* kViewerReferences = "references";

/// The stored reference of just this picture, null if there is none with samples in both halves. Throws Error(Input) for
/// files that are damaged or show something else than their name says.
std::shared_ptr<const StoredReference> find_viewer_reference(const std::filesystem::path& folder,
                                                             const SceneDescription& scene,
                                                             const RenderSettings& settings);

/// Goes on with it on a CPU back end of its own, by default path tracing with next-event estimation.
std::shared_ptr<const StoredReference> make_viewer_reference(const std::filesystem::path& folder,
                                                             const std::string& scene_name,
                                                             const std::shared_ptr<const SceneDescription>& scene,
                                                             const RenderSettings& settings, int threads,
                                                             const JobMonitor& monitor);

}  // namespace pl
