#include "app/diagnostics_file.h"

#include <algorithm>
#include <filesystem>
#include <functional>

#include <fmt/format.h>

#include "app/progress.h"
#include "core/diagnose/diagnostics.h"
#include "core/io/picture_file.h"
#include "core/kernel/film/frame_pixel.h"

namespace pl {
namespace {

/// The pixels with most occurrences of a kind, in rows from the top where counts are equal: [x, y, count].
Json worst_pixels(const diagnose::DiagnosticsMap& map, diagnose::DiagnosticKind kind) {
    constexpr std::size_t kMost = 16;
    const auto count_at = [&](std::size_t pixel) { return map.pixels[pixel][index_of(kind)]; };
    std::vector<std::size_t> pixels;
    for (std::size_t i = 0; i < map.pixels.size(); ++i)
        if (count_at(i) > 0) pixels.push_back(i);
    std::ranges::stable_sort(pixels, std::greater{}, count_at);
    Json list = Json::array();
    const auto width = static_cast<std::size_t>(map.width);
    for (const std::size_t i : pixels) {
        if (list.size() == kMost) break;
        list.push_back({i % width, i / width, count_at(i)});
    }
    return list;
}

Json found_json(const diagnose::DiagnosticsMap& map) {
    Json json{{"samples", map.samples},
              {"traced", map.traced},
              {"complete", map.is_complete},
              {"moving_tables", map.has_moving_tables}};
    for (const diagnose::DiagnosticInfo& info : diagnose::all_diagnostics()) {
        Json& entry = json[std::string(info.name)];
        if (info.id == diagnose::DiagnosticKind::ClampedSample && !map.knows_clamped)
            entry = nullptr;
        else
            entry = {{"count", map.found[index_of(info.id)]},
                     {"pixels", map.pixel_count(info.id)},
                     {"worst", worst_pixels(map, info.id)}};
    }
    return json;
}

ByteImage marked(ByteImage image, const diagnose::DiagnosticsMap& map) {
    std::vector<std::uint32_t> argb(image.rgb.size() / 3);
    for (std::size_t i = 0; i < argb.size(); ++i)
        argb[i] = pack_pixel(image.rgb[3 * i], image.rgb[3 * i + 1], image.rgb[3 * i + 2]);
    diagnose::mark_diagnostics(map, {argb.data(), static_cast<std::size_t>(image.width)});
    for (std::size_t i = 0; i < argb.size(); ++i)
        for (std::size_t channel = 0; channel < 3; ++channel)
            image.rgb[3 * i + channel] = static_cast<std::uint8_t>(argb[i] >> (16 - 8 * channel) & 255u);
    return image;
}

LinearImage counts_of(const diagnose::DiagnosticsMap& map) {
    LinearImage image{.width = map.width, .height = map.height, .pixels = {}};
    for (const diagnose::DiagnosticsMap::Pixel& pixel : map.pixels) {
        const auto count = [&](diagnose::DiagnosticKind kind) { return static_cast<float>(pixel[index_of(kind)]); };
        image.pixels.push_back(
            {count(diagnose::DiagnosticKind::InvalidSample), count(diagnose::DiagnosticKind::EscapedPath),
             count(diagnose::DiagnosticKind::LookupMiss) + count(diagnose::DiagnosticKind::ClampedSample)});
    }
    return image;
}

}  // namespace

Json diagnostics_json(const Snapshot& snapshot) {
    const diagnose::DiagnosticCounts counted = diagnose::counted_diagnostics(snapshot);
    // Whether surfaces close the scene is examined only once a path has escaped.
    const bool is_known = snapshot.counters.path.escaped > 0;
    Json json{{"closed", is_known ? Json(snapshot.is_closed) : Json(nullptr)}};
    for (const diagnose::DiagnosticInfo& info : diagnose::all_diagnostics())
        json[std::string(info.name)] = counted[index_of(info.id)];
    return json;
}

bool write_diagnostics(const Session& session, const Snapshot& snapshot, const Options& options,
                       ImageMetadata metadata, const InterruptGuard& interrupt, Console& console) {
    ProgressDisplay progress(console, !options.no_progress && !options.quiet);
    const diagnose::DiagnosticsMap found = diagnose::find_diagnostics(
        diagnose::diagnostics_input(session, snapshot.slot), options.threads, interrupt.flag(), [&](double share) {
            progress.show({.activity = "tracing again", .share = share, .spp = snapshot.passes, .detail = ""});
        });
    const std::string summary = summary_of(found);
    metadata.emplace_back("diagnostics", summary);
    const std::filesystem::path path = options.diagnostics_file;
    const ImageKind kind = image_kind(path);
    if (kind == ImageKind::Png)
        write_png8(path, marked(display_image(snapshot, options.display), found), metadata);
    else if (kind == ImageKind::Exr)
        write_exr(path, counts_of(found), metadata);
    else
        write_pfm(path, counts_of(found));
    console.remark(fmt::format("{}: {}\n", options.diagnostics_file, summary));
    Json event = diagnostics_json(snapshot);
    event["found"] = found_json(found);
    console.event("diagnostics", event);
    return found.is_complete;
}

}  // namespace pl
