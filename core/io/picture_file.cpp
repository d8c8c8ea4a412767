#include "core/io/picture_file.h"

#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/kernel/film/heat_color.h"
#include "core/session/shown_range.h"

namespace pl {
namespace {

namespace fs = std::filesystem;

std::uint8_t to_byte(float linear) { return static_cast<std::uint8_t>(std::lround(255.0f * encode_srgb(linear))); }

}  // namespace

ByteImage display_image(const Snapshot& snapshot, const DisplaySettings& display) {
    ByteImage image{.width = snapshot.width, .height = snapshot.height, .rgb = {}};
    image.rgb.reserve(3 * snapshot.pixels.size());
    const bool radiance = shows_radiance(snapshot.slot.view);
    const float factor = shown_range(snapshot).scale() * (radiance ? std::exp2(display.exposure_ev) : 1.0f);
    const ToneCurve curve = radiance ? display.curve : ToneCurve::Clamp;
    for (const Vec3f& pixel : snapshot.pixels) {
        if (is_heat_map(snapshot.slot.view)) {
            const ByteColor color = heat_color(pixel.x * factor);
            image.rgb.insert(image.rgb.end(), {color.r, color.g, color.b});
            continue;
        }
        const Vec3f shown = tone_map(pixel, factor, curve);
        for (int channel = 0; channel < 3; ++channel) image.rgb.push_back(to_byte(shown[channel]));
    }
    return image;
}

std::string encode_picture(ImageKind kind, const Snapshot& snapshot, const DisplaySettings& display,
                           const ImageMetadata& metadata) {
    if (kind == ImageKind::Png) return encode_png8(display_image(snapshot, display), metadata);
    const LinearImage image{.width = snapshot.width, .height = snapshot.height, .pixels = snapshot.pixels};
    return kind == ImageKind::Exr ? encode_exr(image, metadata) : encode_pfm(image);
}

void save_picture(const fs::path& path, const Snapshot& snapshot, const DisplaySettings& display,
                  const ImageMetadata& metadata) {
    write_file_atomic(path, encode_picture(image_kind(path), snapshot, display, metadata));
}

void require_writable(const fs::path& path) {
    std::error_code ignored;
    const fs::path target = fs::is_symlink(path, ignored) ? fs::weakly_canonical(path, ignored) : path;
    const fs::file_status status = fs::status(target, ignored);
    if (fs::is_directory(status)) fail_write(path, "it is a directory");
    if (fs::exists(status)) {
        if (access(target.c_str(), W_OK) != 0) fail_write(path, std::strerror(errno));
        if (!fs::is_regular_file(status)) return;
    }
    // Creating a file is the only reliable test: permissions say nothing about read-only disks.
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    std::string probe = (folder / ".pathlight-probe-XXXXXX").string();
    const int file = mkstemp(probe.data());
    if (file < 0) fail_write(path, std::strerror(errno));
    close(file);
    unlink(probe.c_str());
}

std::filesystem::path frame_file(const std::filesystem::path& folder, int index, ImageKind kind) {
    return folder / fmt::format("frame_{:04}.{}", index + 1, name_of(kind));
}

}  // namespace pl
