#include "app/state_files.h"

#include <filesystem>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "app/options.h"
#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/base/timer.h"
#include "core/io/field_file.h"
#include "core/scene/scene_hash.h"
#include "core/session/exact_backend.h"

namespace pl {
namespace {

constexpr double kDefaultInterval = 600.0;

/// Copies of the state that are made on the way to the file: taken out of the back end, and in the order of the file.
constexpr std::uint64_t kCopies = 2;

}  // namespace

CheckpointFiles::CheckpointFiles(const Options& given, Console& console)
    : console_(console), path_(given.checkpoint_file), interval_(given.checkpoint_seconds.value_or(kDefaultInterval)),
      resumed_(given.resume_file) {
    if (path_.empty() && given.checkpoint_seconds)
        throw Error(ErrorKind::Usage, "--checkpoint-every: expected --checkpoint FILE with it");
    if (!resumed_.empty()) loaded_ = read_checkpoint(resumed_);
}

void CheckpointFiles::hand_over(Session& session) {
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
    console_.log().detail(fmt::format("{}: goes on after {:.1f} s of rendering", resumed_, earlier_seconds_));
}

void CheckpointFiles::save_if_due(const Session& session, double seconds) {
    if (since_last_.seconds() >= interval_) save(session, seconds);
    is_present_ = false;  // the rendering goes on
}

void CheckpointFiles::save(const Session& session, double seconds) {
    if (path_.empty()) return;
    since_last_ = {};
    is_present_ = false;
    try {
        require_memory(fmt::format("{}: cannot be written", path_), kCopies * session.state_bytes(),
                       ErrorKind::Runtime);
        write_checkpoint(path_, {.seconds = seconds, .state = session.save_state()});
        has_written_ = is_present_ = true;
        has_warned_ = false;
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::Runtime) throw;
        if (!std::exchange(has_warned_, true))
            console_.log().warning(fmt::format("{}: rendering goes on without this checkpoint", error.what()));
    }
}

std::string CheckpointFiles::way_on() const {
    std::error_code ignored;
    if (!has_written_ || !std::filesystem::exists(path_, ignored)) return "";
    return fmt::format("the same command with --resume {} goes on from {}", shell_word(path_),
                       is_present_ ? "here" : "the last checkpoint");
}

FieldFiles::FieldFiles(const Options& given) {
    if (given.load_field.empty()) return;
    const Stopwatch watch;
    loaded_ = read_field(given.load_field);
    load_seconds_ = watch.seconds();
}

std::shared_ptr<const LearnedField> FieldFiles::take(const SceneDescription& scene, const Options& options) {
    if (!loaded_) return nullptr;
    const auto field = std::make_shared<LearnedField>(std::move(*loaded_));
    loaded_.reset();
    try {
        require_learned_in(scene_hash(scene), *field);
    } catch (const Error& error) {
        throw Error(error.kind(), fmt::format("{}: {}", options.load_field, error.what()));
    }
    return field;
}

void FieldFiles::hand_over(Session& session, const Options& options, Console& console) {
    if (!loaded_) return;
    LearnedField field = std::move(*loaded_);
    loaded_.reset();
    console.log().detail(fmt::format("{}: {}", options.load_field, summary_of(field)));
    try {
        session.import_field(std::move(field));
    } catch (const Error& error) {
        throw Error(error.kind(), fmt::format("{}: {}", options.load_field, error.what()));
    }
}

void FieldFiles::save(const Session& session, const Options& options, Console& console) const {
    if (options.save_field.empty()) return;
    const LearnedField field = session.export_field(options.render.method);
    write_field(options.save_field, field);
    console.remark(fmt::format("{}: {}\n", options.save_field, summary_of(field)));
    console.event("field", {{"output", options.save_field},
                            {"volumes", field.volumes->normals.size()},
                            {"passes", field.progress.passes},
                            {"records", field.progress.records}});
}

}  // namespace pl
