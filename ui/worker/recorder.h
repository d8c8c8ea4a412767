// The runs of a render thread: error and noise against time of every film that it renders, and the identity of the picture
// that these films show.
#pragma once

#include "core/measure/live_runs.h"

namespace pl::ui {

/// The settings of a method that differ from the defaults, in words: they tell its runs on one picture apart. Empty without any.
std::string details_of(const RenderSettings& settings, MethodId method);
/// "Reinforcement (SD-tree)": the method with them.
std::string method_text(const RenderSettings& settings, MethodId method);

class Recorder {
public:
    /// Memory for pictures of runs.
    static constexpr std::size_t kPictureBytes = std::size_t{256} << 20;

    Recorder();

    /// After each piece of work on a film of full size. True if runs() changed. `is_last`: no pass follows.
    bool observe(const Session& session, FilmSlot slot, bool is_last = false);
    /// See LiveRuns::is_up_to_date().
    bool is_up_to_date(const Session& session, FilmSlot slot) const { return runs_.is_up_to_date(session, slot); }
    /// Errors are measured against it from now on, where pictures are the same. Throws as LiveRuns::set_reference().
    void set_reference(std::shared_ptr<const LiveReference> reference);
    const std::shared_ptr<const LiveReference>& reference() const { return reference_; }

    std::shared_ptr<const LiveRunSet> runs() const { return runs_.current(); }
    /// picture_key() of a film; 0 if none of its generation was observed.
    std::uint64_t picture(const FilmOrigin& origin) const { return origin.generation == generation_ ? picture_ : 0; }

private:
    LiveRuns runs_;
    std::shared_ptr<const LiveReference> reference_;
    std::uint64_t picture_ = 0;     ///< picture_key(); 0 before the first film
    std::uint64_t generation_ = 0;  ///< FilmOrigin::generation of picture_
};

}  // namespace pl::ui
