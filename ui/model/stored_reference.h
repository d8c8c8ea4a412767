// References of the picture in the window: found in a folder, and made there.
#pragma once

#include <filesystem>
#include <memory>

#include "core/session/backend.h"
#include "ui/viewer.h"

namespace pl::ui {

/// The stored reference of exactly this picture; null if there is none with samples in both halves. Throws
/// Error(Input) for files that are damaged or whose content differs from the one in their name.
std::shared_ptr<const StoredReference> find_stored_reference(const std::filesystem::path& folder,
                                                             const SceneDescription& scene,
                                                             const RenderSettings& settings);

/// Continues it on the CPU, by path tracing with next-event estimation, until it is converged or the monitor stops it; with
/// samples in both halves either way.
std::shared_ptr<const StoredReference> make_stored_reference(const std::filesystem::path& folder,
                                                             const OpenScene& scene, const RenderSettings& settings,
                                                             const BackendFactory& make_backend,
                                                             const JobMonitor& monitor);

}  // namespace pl::ui
