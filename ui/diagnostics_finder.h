// The search for diagnostics in the picture of the window, in the background, and what it found for as long as that picture stands.
#pragma once

#include <memory>
#include <optional>

#include "ui/background_job.h"
#include "ui/worker/published_frame.h"

namespace pl {

class DiagnosticsFinder {
public:
    using Found = std::shared_ptr<const DiagnosticsMap>;

    /// The render thread was asked for what it takes to search.
    void expect_answer() { is_asked_ = true; }
    /// It has answered: the search begins, if there is anything to look at.
    void begin(DiagnosticsAnswer answer);
    /// Ends the search; what it has found by then comes as its result.
    void stop();
    /// Forgets what was found.
    void drop() { map_.reset(); }

    bool is_searching() const { return is_asked_ || job_ != nullptr; }
    double share() const { return job_ ? job_->progress().share : 0.0; }
    /// Once per frame of the window, with the newest edit that is rendered: what was found is dropped with the picture. Once,
    /// when a search is over, its result.
    std::optional<BackgroundJob<Found>::Result> update(std::uint64_t generation);

    /// What was found in this picture; null if nothing was looked for.
    Found map_of(const PublishedFrame& frame) const;

private:
    bool is_asked_ = false;
    std::uint64_t generation_ = 0;  ///< of the picture that is or was searched
    Found map_;
    std::unique_ptr<BackgroundJob<Found>> job_;
};

}  // namespace pl
