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

/// Whether a point is on the mark of a verdict, in units of its radius from its center, y down: a triangle up for a gain, one down for
/// a loss, a disc for no difference, a ring where nothing is decided.
bool is_on_mark(Verdict verdict, double x, double y) {
    const double radius = std::hypot(x, y);
    if (verdict == Verdict::NoDifference) return radius < 0.7;
    if (verdict != Verdict::Faster && verdict != Verdict::Slower) return std::abs(radius - 0.6) < 0.15;
    const double below_tip = 1.0 + (verdict == Verdict::Faster ? y : -y);  // 0 at the tip, 1.5 at the base
    return below_tip < 1.5 && std::abs(x) < 0.58 * below_tip;
}

void draw_mark(ByteImage& image, const Interval& gain, glm::ivec2 low, glm::ivec2 high) {
    const Verdict verdict = verdict_of(gain);
    const std::uint32_t color = mark_color(verdict);
    const double radius = 0.25 * std::min(high.x - low.x, high.y - low.y);
    for (int y = low.y; y < high.y; ++y)
        for (int x = low.x; x < high.x; ++x) {
            if (!is_on_mark(verdict, (x + 0.5 - 0.5 * (low.x + high.x)) / radius,
                            (y + 0.5 - 0.5 * (low.y + high.y)) / radius))
                continue;
            const auto at = 3 * static_cast<std::size_t>(y * image.width + x);
            for (std::size_t channel = 0; channel < 3; ++channel)
                image.rgb[at + channel] = static_cast<std::uint8_t>(color >> (16 - 8 * channel) & 255u);
        }
}

ByteImage marked(ByteImage image, const TileGains& gains) {
    const auto corner = [&](int column, int row) {
        return glm::ivec2{TileGains::edge(column, gains.columns, image.width),
                          TileGains::edge(row, gains.rows, image.height)};
    };
    for (int row = 0; row < gains.rows; ++row)
        for (int column = 0; column < gains.columns; ++column)
            draw_mark(image, gains.tiles[static_cast<std::size_t>(row * gains.columns + column)], corner(column, row),
                      corner(column + 1, row + 1));
    return image;
}

}  // namespace

void require_gain(const Options& options) {
    if (options.gain_file.empty()) return;
    const MethodInfo& method = info_of(options.render.method);
    if (!method.uses_field)
        throw Error(ErrorKind::Usage, fmt::format("--gain: compares a guided method with default: expected --method "
                                                  "precomputed or reinforcement, got {}",
                                                  method.name));
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
    console.remark(fmt::format("{}: {} {} in the time to the same noise\n", options.gain_file,
                               info_of(slot.method).name, mark_text(gains.picture)));
    return true;
}

}  // namespace pl
