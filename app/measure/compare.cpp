// `pathlight compare`: the error of a picture against another or against its reference, in all metrics.
#include <charconv>

#include <fmt/format.h>

#include "app/commands.h"
#include "core/base/error.h"
#include "core/bench/figures_json.h"
#include "core/bench/reference_store.h"
#include "core/io/image.h"
#include "core/measure/flip.h"
#include "core/measure/metrics.h"
#include "core/measure/picture_identity.h"

namespace pl {
namespace {

struct Picture {
    std::string path;
    LinearImage image;
    ImageMetadata metadata;

    /// picture_hash() from its metadata; empty if it has none.
    std::string hash() const { return text_of(metadata, kPictureHashKey); }
};

/// Throws Error(Input) also for a picture with NaN or infinite pixels, whose error is undefined.
Picture read_picture(const std::string& path, Console& console) {
    Picture picture{.path = path, .image = {}, .metadata = {}};
    std::vector<std::string> warnings;
    picture.image = read_linear(path, &picture.metadata, &warnings);
    for (const std::string& warning : warnings) console.log().warning(warning);
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

/// Throws Error(Input) if sizes differ or the reference is of another picture. Warns if two pictures differ in
/// content.
void check_pair(const Picture& picture, const Picture& reference, Console& console) {
    const LinearImage& a = picture.image;
    const LinearImage& b = reference.image;
    if (a.width != b.width || a.height != b.height)
        throw Error(ErrorKind::Input, fmt::format("{}: expected a size of {}x{} as {} has, got {}x{}", picture.path,
                                                  b.width, b.height, reference.path, a.width, a.height));
    if (picture.hash() == reference.hash() || picture.hash().empty() || reference.hash().empty()) return;
    if (!text_of(reference.metadata, bench::kReferenceHalfKey).empty())
        throw Error(ErrorKind::Input,
                    fmt::format("{}: is the reference of another scene, camera, light or depth than "
                                "{} shows",
                                reference.path, picture.path));
    console.log().warning(
        fmt::format("{} and {} were made of different scenes, cameras or depths", picture.path, reference.path));
}

/// The reference of a picture, from a folder.
bench::Reference reference_for(const Picture& picture, const std::string& folder) {
    if (picture.hash().empty())
        throw Error(ErrorKind::Input,
                    fmt::format("{}: has no picture hash, so that its reference in {} cannot be found: expected an "
                                ".exr of 'pathlight render' with --view beauty",
                                picture.path, folder));
    int max_depth = 0;
    const std::string depth = text_of(picture.metadata, "max_depth");
    std::from_chars(depth.data(), depth.data() + depth.size(), max_depth);
    return bench::ReferenceStore(folder).require({.picture_hash = picture.hash(),
                                                  .scene_hash = text_of(picture.metadata, "scene_hash"),
                                                  .width = picture.image.width,
                                                  .height = picture.image.height,
                                                  .max_depth = max_depth});
}

struct MeasuredError {
    Metrics metrics;
    std::optional<double> flip;
};

/// Pixels per degree for FLIP; empty without --flip.
std::optional<double> flip_resolution(const Options& options) {
    if (options.pixels_per_degree > 0.0 && !options.flip)
        throw Error(ErrorKind::Usage, "--pixels-per-degree: expected --flip with it");
    if (!options.flip) return std::nullopt;
    return options.pixels_per_degree > 0.0 ? options.pixels_per_degree : kFlipPixelsPerDegree;
}

/// `resolution` is for FLIP, in pixels per degree.
MeasuredError compare(const Picture& picture, const PictureHalves& halves, Pixels mean,
                      std::optional<double> resolution) {
    MeasuredError result{.metrics = measure_error(picture.image.pixels, halves), .flip = {}};
    if (resolution) result.flip = mean_of(flip_map(picture.image.pixels, mean, picture.image.width, *resolution));
    return result;
}

MeasuredError compare(const Picture& picture, const std::string& reference, std::optional<double> resolution,
                      Console& console) {
    if (std::filesystem::is_directory(reference)) {
        const bench::Reference found = reference_for(picture, reference);
        return compare(picture, found.pixels(), found.mean().pixels, resolution);
    }
    const Picture other = read_picture(reference, console);
    check_pair(picture, other, console);
    return compare(picture, {other.image.pixels, other.image.pixels}, other.image.pixels, resolution);
}

std::string text_of(const MeasuredError& comparison, std::optional<double> resolution, const Picture& picture,
                    const std::string& reference) {
    const Metrics& m = comparison.metrics;
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
    if (comparison.flip)
        row("flip", *comparison.flip,
            fmt::format("0 to 1, radiance above 1 is white, {} pixels per degree", *resolution));
    return text;
}

}  // namespace

int run_compare(const CommandLine& line, Console& console) {
    const std::optional<double> resolution = flip_resolution(line.options);
    const Picture picture = read_picture(line.options.inputs[0], console);
    const std::string& reference = line.options.inputs[1];
    const MeasuredError comparison = compare(picture, reference, resolution, console);
    const Metrics& metrics = comparison.metrics;
    console.result(text_of(comparison, resolution, picture, reference));
    if (metrics.invalid_reference > 0)
        console.log().warning(fmt::format("{}: {} pixels are NaN or infinite: the picture is not scored there",
                                          reference, metrics.invalid_reference));
    Json event{{"image", picture.path},
               {"reference", reference},
               {"width", picture.image.width},
               {"height", picture.image.height}};
    event.update(bench::metrics_json(metrics));
    if (comparison.flip) event.update({{"flip", *comparison.flip}, {"pixels_per_degree", *resolution}});
    console.event("compare", event);
    if (const auto target = line.options.target_error; target && metrics.relmse > *target)
        throw Error(ErrorKind::Threshold,
                    fmt::format("--target-error: expected relMSE of at most {}, got {}", *target, metrics.relmse));
    return 0;
}

}  // namespace pl
