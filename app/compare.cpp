// `pathlight compare`: how far a picture is from a reference, in all metrics.
#include <fmt/format.h>

#include "app/commands.h"
#include "app/metrics_json.h"
#include "core/base/error.h"
#include "core/io/image.h"
#include "core/measure/metrics.h"
#include "core/measure/picture_identity.h"

namespace pl {
namespace {

struct Picture {
    std::string path;
    LinearImage image;
    std::string hash;  ///< of what it shows, if it says so
};

/// Throws Error(Input) also for a picture with NaN or infinite pixels: its error is not known.
Picture read_picture(const std::string& path) {
    ImageMetadata metadata;
    Picture picture{.path = path, .image = read_linear(path, &metadata), .hash = {}};
    picture.hash = text_of(metadata, kPictureHashKey);
    const LinearImage& image = picture.image;
    if (const std::size_t invalid = count_invalid(image.pixels); invalid > 0) {
        const std::size_t first = first_invalid(image.pixels);
        const auto width = static_cast<std::size_t>(image.width);
        throw Error(ErrorKind::Input,
                    fmt::format("{}: {} of {} pixels are NaN or infinite, the first at {},{}: its error is not known",
                                path, invalid, image.pixels.size(), first % width, first / width));
    }
    return picture;
}

void require_same_size(const Picture& a, const Picture& b) {
    if (a.image.width != b.image.width || a.image.height != b.image.height)
        throw Error(ErrorKind::Input,
                    fmt::format("{}: expected a size of {}x{} as {} has, got {}x{}", a.path, b.image.width,
                                b.image.height, b.path, a.image.width, a.image.height));
}

std::string text_of_metrics(const Metrics& m, const Picture& picture, const std::string& reference) {
    std::string text =
        fmt::format("{} against {}, {}x{}\n", picture.path, reference, picture.image.width, picture.image.height);
    const auto row = [&text](std::string_view name, double value, const std::string& note) {
        text += fmt::format("{:<14} {:<12.6g} {}\n", name, value, note);
    };
    const std::string trimmed = fmt::format("without the worst {} % of the pixels", 100.0 * kTrimmedShare);
    row("mse", m.mse, "(x-r)^2");
    row("rmse", m.rmse, "");
    row("relmse", m.relmse, fmt::format("(x-r)^2 / (r^2 + {})", kEpsilon));
    row("mse-trimmed", m.mse_trimmed, trimmed);
    row("relmse-trimmed", m.relmse_trimmed, trimmed);
    row("mape", m.mape, fmt::format("|x-r| / (|r| + {})", kEpsilon));
    row("smape", m.smape, fmt::format("2 |x-r| / (|x| + |r| + {})", kEpsilon));
    row("bias", m.bias, fmt::format("luminance of x-r, {:+.4g} % of the reference", 100.0 * m.relative_bias));
    row("psnr", m.psnr_db, "dB, peak 1");
    return text;
}

}  // namespace

int run_compare(const CommandLine& line, Console& console) {
    const Picture picture = read_picture(line.options.inputs[0]);
    const Picture reference = read_picture(line.options.inputs[1]);
    require_same_size(picture, reference);
    if (picture.hash != reference.hash && !picture.hash.empty() && !reference.hash.empty())
        console.log().warning(
            fmt::format("{} and {} were made of different scenes, cameras or depths", picture.path, reference.path));
    const Metrics metrics = measure_error(picture.image.pixels, reference.image.pixels);
    console.result(text_of_metrics(metrics, picture, reference.path));
    Json event{{"image", picture.path},
               {"reference", reference.path},
               {"width", picture.image.width},
               {"height", picture.image.height}};
    event.update(metrics_json(metrics));
    console.event("compare", event);
    if (const auto target = line.options.target_error; target && metrics.relmse > *target)
        throw Error(ErrorKind::Threshold,
                    fmt::format("--target-error: expected relMSE of at most {}, got {}", *target, metrics.relmse));
    return 0;
}

}  // namespace pl
