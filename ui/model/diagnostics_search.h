// The search for the pixels of invalid samples, lost paths, lookup misses and clamped training samples.
#pragma once

#include <memory>
#include <optional>

#include "ui/model/diagnostics_finder.h"
#include "ui/model/messages.h"
#include "ui/model/render_controls.h"

namespace pl::ui {

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
