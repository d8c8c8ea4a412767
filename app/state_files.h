// The state of a rendering, from one run of the program to the next: checkpoints and learned fields.
#pragma once

#include <optional>

#include "app/console.h"
#include "app/option_values.h"
#include "core/base/timer.h"
#include "core/io/checkpoint_file.h"
#include "core/session/session.h"

namespace pl {

/// --checkpoint, --checkpoint-every and --resume: the state of a rendering, from one run of the program to the next.
class CheckpointFiles {
public:
    /// Reads the file of --resume, if it is given. Throws Error(Input) if it cannot be used, Error(Usage) for --checkpoint-every
    /// without --checkpoint.
    CheckpointFiles(const Options& given, Console& console);

    /// Gives the state of --resume to the session; to be called before its first piece of work. Throws Error(Input) if that
    /// belongs to another run, Error(Unavailable) if the back end cannot be continued.
    void hand_over(Session& session);
    /// Seconds of rendering before this run.
    double earlier_seconds() const { return earlier_seconds_; }

    /// Writes the checkpoint if its interval is over; between two pieces of work. `seconds`: of rendering, earlier runs included.
    void save_if_due(const Session& session, double seconds);
    /// Writes the checkpoint, if one is asked for. A failure is a warning, told once in a row: the picture may still be saved, and the next
    /// time there may be room.
    void save(const Session& session, double seconds);
    /// "the same command with --resume FILE goes on from here", or from the last checkpoint, if save() did not write the present state;
    /// empty if this run has written none that is still there.
    std::string way_on() const;

private:
    Console& console_;
    std::string path_;  ///< empty: none is asked for
    double interval_ = 0.0;
    std::string resumed_;
    std::optional<Checkpoint> loaded_;
    double earlier_seconds_ = 0.0;
    bool has_written_ = false;
    bool is_present_ = false;  ///< the file holds the present state
    bool has_warned_ = false;
    Stopwatch since_last_;
};

/// --load-field and --save-field: the learned field, from one run of the program to the next.
class FieldFiles {
public:
    /// Reads the file of --load-field, if it is given. Throws Error(Input).
    explicit FieldFiles(const Options& given);

    /// Null without --load-field, and after take() or hand_over().
    const LearnedField* loaded() const { return loaded_ ? &*loaded_ : nullptr; }
    double load_seconds() const { return load_seconds_; }

    /// The loaded field, for a session to come; null without one. Throws Error(Input) if it was learned in another
    /// scene.
    std::shared_ptr<const LearnedField> take(const SceneDescription& scene, const Options& options);
    /// Gives the loaded field to the session. Its clocks start at zero and count this run alone. Throws Error(Input)
    /// if it was learned in another scene.
    void hand_over(Session& session, const Options& options, Console& console);
    /// Writes the file of --save-field, if it is given.
    void save(const Session& session, const Options& options, Console& console) const;

private:
    std::optional<LearnedField> loaded_;
    double load_seconds_ = 0.0;
};

}  // namespace pl
