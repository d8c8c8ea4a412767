// The search for the pixels of invalid samples, lost paths, lookup misses and clamped training samples.
#pragma once

#include <memory>
#include <optional>

#include "ui/model/jobs.h"
#include "ui/model/messages.h"
#include "ui/model/render_controls.h"
#include "ui/worker/published_frame.h"

namespace pl::ui {

// The background search for the pixels of invalid samples, lost paths, lookup misses and clamped training samples in
// the picture of the window. Its map is kept until the picture changes.

class DiagnosticsFinder {
public:
    using Found = std::shared_ptr<const diagnose::DiagnosticsMap>;

    /// The input of a search was requested from the render thread.
    void expect_answer() { is_asked_ = true; }
    /// The render thread has answered: the search begins, unless the picture has no paths.
    void begin(DiagnosticsAnswer answer);
    /// Ends the search; its result is the map so far.
    void stop();
    /// Drops the map.
    void drop() { map_.reset(); }

    bool is_searching() const { return is_asked_ || job_ != nullptr; }
    double share() const { return job_ ? job_->progress().share : 0.0; }
    /// Once per frame of the window, with the generation of the newest rendered edit: the map is dropped with its picture.
    /// Returns the result of a search once, at its end.
    std::optional<BackgroundJob<Found>::Result> update(std::uint64_t generation);

    /// The map of this picture; null without a search.
    Found map_of(const PublishedFrame& frame) const;

private:
    bool is_asked_ = false;
    std::uint64_t generation_ = 0;  ///< of the searched picture
    Found map_;
    std::unique_ptr<BackgroundJob<Found>> job_;
};

class DiagnosticsSearch {
public:
    DiagnosticsSearch(RenderLink& link, Messages& messages, const RenderControls& render)
        : link_(link), messages_(messages), render_(render) {}

    /// Once per frame of the window: begins and ends the search, drops the map with its picture.
    void update();

    /// Starts a search, during which rendering rests; or ends it, or hides its map.
    void toggle();

    /// The pixels found in the present picture; null before a search.
    std::shared_ptr<const diagnose::DiagnosticsMap> map() const;
    bool is_searching() const { return finder_.is_searching(); }
    /// The finished share of the search; empty without one.
    std::optional<double> share() const;

private:
    void start();

    RenderLink& link_;
    Messages& messages_;
    const RenderControls& render_;
    DiagnosticsFinder finder_;
};

}  // namespace pl::ui
