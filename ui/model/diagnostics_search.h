// The search for the pixels of invalid samples, lost paths, lookup misses and clamped training samples.
#pragma once

#include <memory>
#include <optional>

#include "ui/model/jobs.h"
#include "ui/model/messages.h"
#include "ui/model/render_controls.h"
#include "ui/worker/published_frame.h"

namespace pl::ui {

/// Runs in the background. Its map is kept until the picture changes.
class DiagnosticsSearch {
public:
    DiagnosticsSearch(RenderLink& link, Messages& messages, const RenderControls& render)
        : link_(link), messages_(messages), render_(render) {}

    /// Once per frame of the window: begins and ends the search, drops the map with its picture.
    void update();

    /// Starts a search, during which rendering rests; or ends it with the map so far, or hides its map.
    void toggle();

    /// The pixels found in the present picture; null before a search.
    std::shared_ptr<const diagnose::DiagnosticsMap> map() const;
    bool is_searching() const { return is_asked_ || job_ != nullptr; }
    /// The finished share of the search; empty without one.
    std::optional<double> share() const;

private:
    using Found = std::shared_ptr<const diagnose::DiagnosticsMap>;

    void start();
    void begin(DiagnosticsAnswer answer);
    void end(BackgroundJob<Found>::Result result);

    RenderLink& link_;
    Messages& messages_;
    const RenderControls& render_;
    bool is_asked_ = false;         ///< the input of a search, of the render thread
    std::uint64_t generation_ = 0;  ///< of the searched picture
    Found map_;
    std::unique_ptr<BackgroundJob<Found>> job_;
};

}  // namespace pl::ui
