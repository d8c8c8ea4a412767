// The selected volume as carried by frames: read again after edits, and a few times a second while a method learns.
#pragma once

#include <memory>
#include <optional>

#include "core/base/timer.h"
#include "core/session/session.h"

namespace pl::ui {

class Inspection {
public:
    static constexpr double kSeconds = 0.25;  ///< between two readings of one volume

    /// An edit may have changed the field.
    void invalidate() { is_stale_ = true; }
    /// Whether the volume has to be read for a reason other than time.
    bool wants(std::int32_t volume) const { return is_stale_ || volume != shown(); }
    /// Reads the hemisphere of a method at the volume if it is due; kNoVolume shows none. Returns whether it was due.
    bool refresh(const Session& session, MethodId method, std::int32_t volume);

    /// Number of the volume that is shown, or kNoVolume.
    std::int32_t shown() const { return volume_ ? volume_->volume : kNoVolume; }
    /// Null if none is shown.
    std::shared_ptr<const VolumeInspection> volume() const { return volume_; }

private:
    std::shared_ptr<const VolumeInspection> volume_;
    bool is_stale_ = false;
    std::optional<Stopwatch> age_;  ///< since the last reading
};

}  // namespace pl::ui
