#include "app/checkpoint_files.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/session/exact_backend.h"

namespace pl {
namespace {

constexpr double kDefaultInterval = 600.0;

}  // namespace

CheckpointFiles::CheckpointFiles(const Options& given)
    : path_(given.checkpoint_file), interval_(given.checkpoint_seconds.value_or(kDefaultInterval)),
      resumed_(given.resume_file) {
    if (path_.empty() && given.checkpoint_seconds)
        throw Error(ErrorKind::Usage, "--checkpoint-every: expected --checkpoint FILE with it");
    if (!resumed_.empty()) loaded_ = read_checkpoint(resumed_);
}

void CheckpointFiles::hand_over(Session& session, Console& console) {
    if (!path_.empty()) exact(session.backend_access()).settle_when_stopped();
    if (!loaded_) return;
    Checkpoint checkpoint = std::move(*loaded_);
    loaded_.reset();
    try {
        session.restore_state(std::move(checkpoint.state));
    } catch (const Error& error) {
        throw Error(error.kind(), fmt::format("{}: {}", resumed_, error.what()));
    }
    earlier_seconds_ = checkpoint.seconds;
    console.log().detail(fmt::format("{}: goes on after {:.1f} s of rendering", resumed_, earlier_seconds_));
}

void CheckpointFiles::save_if_due(const Session& session, double seconds) {
    if (since_last_.seconds() >= interval_) save(session, seconds);
}

void CheckpointFiles::save(const Session& session, double seconds) {
    if (path_.empty()) return;
    write_checkpoint(path_, {.seconds = seconds, .state = session.save_state()});
    has_written_ = true;
    since_last_ = {};
}

}  // namespace pl
