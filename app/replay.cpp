// `pathlight replay`: the pictures of a camera path without a display, as the viewer plays and writes it.
#include <fmt/format.h>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/make_backend.h"
#include "app/open_scene.h"
#include "app/picture_target.h"
#include "app/run_passes.h"
#include "app/state_files.h"
#include "app/stats_json.h"
#include "core/base/error.h"
#include "core/io/camera_file.h"
#include "core/io/files.h"
#include "core/io/json_file.h"
#include "core/io/picture_file.h"

namespace pl {
namespace {

constexpr int kFramesPerCamera = 24;

/// Names the first fault of the files before anything is rendered; makes the folder. Throws Error(Runtime).
void prepare_outputs(const Options& options) {
    make_folder(options.output);
    require_writable(frame_file(options.output, 0, options.frame_kind));
    if (!options.stats_file.empty()) require_writable(options.stats_file);
    if (!options.save_field.empty()) require_writable(options.save_field);
}

/// Volumes and learned tables stay when the camera moves, as in the viewer.
class Sequence {
public:
    Sequence(Session& session, const Options& options, std::string command, CameraPath path,
             const InterruptGuard& interrupt, Console& console)
        : session_(session), options_(options), command_(std::move(command)), interrupt_(interrupt),
          console_(console), path_(std::move(path)),
          frames_(options.frames > 0 ? options.frames : kFramesPerCamera * static_cast<int>(path_.size() - 1) + 1) {}

    /// Until all frames are written, or the run is interrupted.
    void render() {
        while (written_ < frames_ && render_frame(written_)) ++written_;
    }
    bool is_complete() const { return written_ == frames_; }

    /// Throws Error(Threshold) if frames missed --target-error.
    void report() {
        if (!options_.stats_file.empty()) {
            stats_["frames"] = rows_;
            write_file_atomic(options_.stats_file, stats_.dump(2) + "\n");
        }
        console_.event("done", {{"output", options_.output}, {"frames", written_}, {"interrupted", !is_complete()}});
        if (!is_complete())
            console_.log().warning(fmt::format("interrupted: {} of {} frames are written, the one under way is lost",
                                               written_, frames_));
        if (is_complete() && missed_ > 0)
            throw Error(ErrorKind::Threshold,
                        fmt::format("--target-error: expected noise of at most {:.3g} as relMSE in every frame, got "
                                    "more in {} of {}",
                                    *options_.target_error, missed_, frames_));
    }

private:
    /// False if it was interrupted; then it leaves no file.
    bool render_frame(int index) {
        const CameraDescription camera = path_.frame(index, frames_);
        session_.apply(EditCamera{camera});
        std::optional<ErrorTarget> target;
        if (options_.target_error) target.emplace(*options_.target_error);
        ErrorTarget* const aim = target ? &*target : nullptr;
        const RunOutcome outcome =
            run_passes(session_, options_, *interrupt_.flag(), console_, Until::Rendered, {.target = aim});
        if (outcome.interrupted()) return false;
        const FilmSlot slot = slot_of(options_.render);
        if (aim != nullptr) aim->measure_last(session_, slot);
        if (aim != nullptr && !aim->is_low_enough()) ++missed_;
        const Snapshot snapshot = session_.snapshot(slot);
        const std::string name = frame_file(options_.output, index, options_.frame_kind).string();
        stats_ = stats_json(session_, snapshot, options_, outcome, aim);
        save_picture(name, snapshot, options_.display, metadata_of(session_, snapshot, stats_, command_, false));
        note(name, camera, snapshot, outcome);
        return true;
    }

    void note(const std::string& name, const CameraDescription& camera, const Snapshot& snapshot,
              const RunOutcome& outcome) {
        Json row{{"output", name},
                 {"camera", camera_json(camera)},
                 {"spp", snapshot.passes},
                 {"seconds", outcome.seconds},
                 {"learned_passes", snapshot.field ? Json(snapshot.field->passes) : Json(nullptr)}};
        console_.remark(fmt::format("{}: {} of {}, {} spp, {:.2f} s\n", name, rows_.size() + 1, frames_,
                                    snapshot.passes, outcome.seconds));
        console_.event("frame", row);
        rows_.push_back(std::move(row));
    }

    Session& session_;
    const Options& options_;
    std::string command_;
    const InterruptGuard& interrupt_;
    Console& console_;
    CameraPath path_;
    int frames_;
    int written_ = 0;
    int missed_ = 0;               ///< frames that missed --target-error
    Json rows_ = Json::array();    ///< of the frames written
    Json stats_ = Json::object();  ///< of the last one
};

}  // namespace

int run_replay(const CommandLine& line, Console& console) {
    const InterruptGuard interrupt;
    (void)read_text_file(line.options.camera_path);  // a missing file is told before the scene is read
    const LoadedScene loaded = open_scene(line.options.scene, line.options.load, console);
    FieldFiles fields(line.options);
    const Options options = resolve_options(line, *loaded.scene, fields.loaded());
    CameraPath path = load_camera_path(options.camera_path, options.render.camera);
    prepare_outputs(options);
    Session session(make_backend(options.backend, options.threads), loaded.scene, options.render,
                    loaded.load_seconds + fields.load_seconds());
    fields.hand_over(session, options, console);
    announce(session, console);
    Sequence sequence(session, options,
                      command_text(Command::Replay, options, scene_defaults(options.scene, *loaded.scene)),
                      std::move(path), interrupt, console);
    sequence.render();
    fields.save(session, options, console);
    sequence.report();
    return sequence.is_complete() ? 0 : kExitInterrupted;
}

}  // namespace pl
