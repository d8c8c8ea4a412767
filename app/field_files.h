// --load-field and --save-field: what was learned, from one run of the program to the next.
#pragma once

#include <optional>

#include "app/console.h"
#include "app/option_values.h"
#include "core/session/session.h"

namespace pl {

/// What a loaded field takes from the present run: clocks that start at zero, and the way to look volumes up.
void fit_to_run(LearnedField& field, const FieldSettings& settings);

class FieldFiles {
public:
    /// Reads the field that the options ask for, if any. Throws Error(Input).
    explicit FieldFiles(const Options& given);

    /// Null if none was asked for, or once a session has it.
    const LearnedField* loaded() const { return loaded_ ? &*loaded_ : nullptr; }
    double load_seconds() const { return load_seconds_; }

    /// What was loaded, for a session to come; null if nothing was. Throws Error(Input) if it was learned in another scene.
    std::shared_ptr<const LearnedField> take(const SceneDescription& scene, const Options& options);
    /// Gives the session what was loaded. Its clocks start at zero: they tell the time of this run.
    /// Throws Error(Input) if it was learned in another scene.
    void hand_over(Session& session, const Options& options, Console& console);
    /// Writes what the session has learned if the options say so, with the time of all runs.
    void save(const Session& session, const Options& options, Console& console) const;

private:
    std::optional<LearnedField> loaded_;
    double load_seconds_ = 0.0;
    double earlier_precompute_seconds_ = 0.0;
};

}  // namespace pl
