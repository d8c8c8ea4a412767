#include "app/gain_file.h"

#include <cmath>

#include <fmt/format.h>

#include "app/noise_report.h"
#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/picture_file.h"
#include "core/measure/run_recorder.h"

namespace pl {
namespace {

bool is_json(const Options& options) { return std::filesystem::path(options.gain_file).extension() == ".json"; }

/// Renders until the charged time is reached, and both halves have passes.
bool render_for(Session& session, FilmSlot slot, double seconds, const InterruptGuard& interrupt) {
    while (session.passes(slot) < 2 || charged_seconds(session.clocks(slot)) < seconds)
        if (session.advance(slot, interrupt.flag()) == Progress::Stopped) return false;
    return true;
}

TimedHalves timed(const Snapshot& snapshot) {
    return {.halves = halves_of(snapshot.halves), .seconds = charged_seconds(snapshot.clocks)};
}

/// A disc in the middle of each tile, in the color of its verdict.
ByteImage marked(ByteImage image, const TileGains& gains) {
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const int column = (gains.columns * (x + 1) - 1) / image.width;
            const int row = (gains.rows * (y + 1) - 1) / image.height;
            const int left = TileGains::edge(column, gains.columns, image.width);
            const int right = TileGains::edge(column + 1, gains.columns, image.width);
            const int top = TileGains::edge(row, gains.rows, image.height);
            const int bottom = TileGains::edge(row + 1, gains.rows, image.height);
            const double radius = 0.2 * std::min(right - left, bottom - top);
            if (std::hypot(x + 0.5 - 0.5 * (left + right), y + 0.5 - 0.5 * (top + bottom)) > radius) continue;
            const std::uint32_t color =
                mark_color(verdict_of(gains.tiles[static_cast<std::size_t>(row * gains.columns + column)]));
            const auto at = 3 * static_cast<std::size_t>(y * image.width + x);
            for (std::size_t channel = 0; channel < 3; ++channel)
                image.rgb[at + channel] = static_cast<std::uint8_t>(color >> (16 - 8 * channel) & 255u);
        }
    return image;
}

}  // namespace

void require_gain(const Options& options) {
    if (options.gain_file.empty()) return;
    const RenderSettings& render = options.render;
    if (!info_of(render.method).uses_field)
        throw Error(ErrorKind::Usage, fmt::format("--gain: compares a guided method with default: expected --method "
                                                  "precomputed or reinforcement, got {}",
                                                  info_of(render.method).name));
    if (render.view != View::Beauty)
        throw Error(ErrorKind::Usage,
                    fmt::format("--gain: expected --view beauty, got '{}', which has no noise of paths",
                                info_of(render.view).name));
    if (!is_json(options) && image_kind(options.gain_file) != ImageKind::Png)
        throw Error(ErrorKind::Usage,
                    fmt::format("--gain: expected a .json or .png file, got '{}'", options.gain_file));
    require_writable(options.gain_file);
}

bool write_gain(Session& session, const Snapshot& snapshot, const Options& options, const InterruptGuard& interrupt,
                Console& console) {
    const FilmSlot slot = slot_of(options.render);
    const FilmSlot base{baseline_method(), slot.view};
    if (!render_for(session, slot, 0.0, interrupt)) return false;
    const Snapshot method = session.snapshot_with_halves(slot);
    if (!render_for(session, base, charged_seconds(method.clocks), interrupt)) return false;
    const Snapshot baseline = session.snapshot_with_halves(base);
    const TileGains gains = tile_gains(timed(baseline), timed(method), method.width);
    if (is_json(options))
        write_text_file_atomic(options.gain_file, tile_gains_json(gains).dump(2) + "\n");
    else
        write_png8(options.gain_file, marked(display_image(snapshot, options.display), gains),
                   {{"Software", "pathlight " PL_VERSION}});
    console.remark(
        fmt::format("{}: {} {}\n", options.gain_file, info_of(slot.method).name, gain_text(gains.picture)));
    return true;
}

}  // namespace pl
