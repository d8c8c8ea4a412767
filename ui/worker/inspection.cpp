#include "ui/worker/inspection.h"

#include "core/base/error.h"

namespace pl::ui {
namespace {

/// Only the number of the volume while the method has no tables.
VolumeInspection inspect(const Session& session, MethodId method, std::int32_t volume) {
    try {
        return session.inspect_volume(method, volume);
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::Usage) throw;
        VolumeInspection result;
        result.volume = volume;
        return result;
    }
}

}  // namespace

bool Inspection::refresh(const Session& session, MethodId method, std::int32_t volume) {
    const bool aged = !age_ || age_->seconds() > kSeconds;
    if (!wants(volume) && !(aged && volume != kNoVolume)) return false;
    is_stale_ = false;
    age_.emplace();
    volume_ =
        volume == kNoVolume ? nullptr : std::make_shared<const VolumeInspection>(inspect(session, method, volume));
    return true;
}

}  // namespace pl::ui
