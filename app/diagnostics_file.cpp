#include "app/diagnostics_file.h"

#include <algorithm>
#include <functional>

#include "app/picture_file.h"
#include "core/kernel/film/frame_pixel.h"

namespace pl {
namespace {

/// The pixels with most of it, in rows from the top where they are equal: [x, y, count].
Json worst_pixels(const DiagnosticsMap& map, std::size_t kind) {
    constexpr std::size_t kMost = 16;
    std::vector<std::size_t> pixels;
    for (std::size_t i = 0; i < map.pixels.size(); ++i)
        if (map.pixels[i][kind] > 0) pixels.push_back(i);
    std::ranges::stable_sort(pixels, std::greater{}, [&](std::size_t i) { return map.pixels[i][kind]; });
    Json list = Json::array();
    const auto width = static_cast<std::size_t>(map.width);
    for (const std::size_t i : pixels) {
        if (list.size() == kMost) break;
        list.push_back({i % width, i / width, map.pixels[i][kind]});
    }
    return list;
}

Json found_json(const DiagnosticsMap& map) {
    Json json{{"samples", map.samples},
              {"traced", map.traced},
              {"complete", map.is_complete},
              {"moving_tables", map.has_moving_tables}};
    for (const DiagnosticInfo& diagnostics : all_diagnostics()) {
        const auto kind = static_cast<std::size_t>(diagnostics.id);
        if (diagnostics.id == Diagnostic::ClampedRecord && !map.has_clamped_records) {
            json[std::string(diagnostics.name)] = nullptr;
            continue;
        }
        json[std::string(diagnostics.name)] = {{"count", map.found[kind]},
                                               {"pixels", map.pixel_count(diagnostics.id)},
                                               {"worst", worst_pixels(map, kind)}};
    }
    return json;
}

ByteImage marked(ByteImage image, const DiagnosticsMap& map) {
    std::vector<std::uint32_t> argb(image.rgb.size() / 3);
    for (std::size_t i = 0; i < argb.size(); ++i)
        argb[i] = pack_pixel(image.rgb[3 * i], image.rgb[3 * i + 1], image.rgb[3 * i + 2]);
    mark_diagnostics(map, argb.data(), static_cast<std::size_t>(image.width));
    for (std::size_t i = 0; i < argb.size(); ++i)
        for (std::size_t channel = 0; channel < 3; ++channel)
            image.rgb[3 * i + channel] = static_cast<std::uint8_t>(argb[i] >> (16 - 8 * channel) & 255u);
    return image;
}

LinearImage counts_of(const DiagnosticsMap& map) {
    LinearImage image{.width = map.width, .height = map.height, .pixels = {}};
    for (const DiagnosticsMap::Pixel& pixel : map.pixels) {
        const auto count = [&](Diagnostic diagnostics) {
            return static_cast<float>(pixel[static_cast<std::size_t>(diagnostics)]);
        };
        image.pixels.push_back({count(Diagnostic::Invalid), count(Diagnostic::Escaped),
                                count(Diagnostic::LookupMiss) + count(Diagnostic::ClampedRecord)});
    }
    return image;
}

}  // namespace

Json diagnostics_json(const Snapshot& snapshot, const DiagnosticsMap* found) {
    const DiagnosticCounts counted = counted_diagnostics(snapshot);
    // Nobody looks for a way out before a path has left.
    const bool is_known = snapshot.counters.path.escaped > 0;
    Json json{{"closed", is_known ? Json(snapshot.is_closed) : Json(nullptr)}};
    for (const DiagnosticInfo& diagnostics : all_diagnostics())
        json[std::string(diagnostics.name)] = counted[static_cast<std::size_t>(diagnostics.id)];
    json["found"] = found != nullptr ? found_json(*found) : Json(nullptr);
    return json;
}

void save_diagnostics(const std::filesystem::path& path, const Snapshot& snapshot, const DisplaySettings& display,
                      const DiagnosticsMap& map, ImageMetadata metadata) {
    metadata.emplace_back("diagnostics", summary_of(map));
    const ImageKind kind = image_kind(path);
    if (kind == ImageKind::Png)
        write_png8(path, marked(display_image(snapshot, display), map), metadata);
    else if (kind == ImageKind::Exr)
        write_exr(path, counts_of(map), metadata);
    else
        write_pfm(path, counts_of(map));
}

}  // namespace pl
