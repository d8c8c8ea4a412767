// --load-field and --save-field: the learned field, from one run of the program to the next.
#pragma once

#include <optional>

#include "app/console.h"
#include "app/option_values.h"
#include "core/session/session.h"

namespace pl {

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
