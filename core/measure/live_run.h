// A measured run: its pictures, kept in bounded memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/measure/halves.h"
#include "core/measure/metrics.h"
#include "core/session/settings.h"
#include "core/session/snapshot.h"

namespace pl {

// Pictures kept for later, in half floats: half the memory, three digits.

/// Linear values, row 0 on top.
struct HalfPicture {
    int width = 0;
    int height = 0;
    std::vector<std::uint16_t> rgb;

    std::size_t bytes() const { return rgb.size() * sizeof(std::uint16_t); }
};

HalfPicture half_picture(int width, int height, Pixels pixels);
std::vector<Vec3f> pixels_of(const HalfPicture& picture);

// The runs of a viewer as data: points over time with their errors, noise and pictures.

/// Labels of a run, which distinguish its curve from others.
struct RunLabel {
    MethodId method = MethodId::Default;
    std::string backend;
    bool next_event = false;
    /// Began with learned radiance, whose cost is not among the seconds of this run.
    bool warm = false;
    std::uint64_t seed = 0;     ///< runs that differ in the seed alone are repetitions
    std::uint64_t picture = 0;  ///< picture_key(): runs of different keys show different light and are never compared
    std::string details;        ///< other settings that differ from the defaults, in words

    friend bool operator==(const RunLabel&, const RunLabel&) = default;
};

struct LivePoint {
    std::uint32_t spp = 0;
    Clocks clocks;  ///< of this run; charged_seconds() is the axis of plots
    PassCounters counters;
    double noise = 0.0;      ///< Noise::relmse, from the halves of the film: needs no reference
    double noise_off = 0.0;  ///< standard error of noise over the blocks of this picture; seeds may differ by more
    /// Against the reference of the same picture; empty without one. Points measured before their reference was
    /// available are measured from half floats (three digits), without the three members below.
    std::optional<Metrics> metrics{};
    std::optional<double> relmse_off{};  ///< standard error of Metrics::relmse, like noise_off
    std::optional<Estimate> squared_bias{};
    std::optional<Estimate> signed_bias{};
    std::shared_ptr<const HalfPicture> picture{};  ///< null after it was dropped to free memory
};

/// All passes of one method into one film from empty on; a run continues when its method is selected again.
struct LiveRun {
    std::uint64_t number = 0;  ///< FilmOrigin::number of its film
    RunLabel label;
    RenderSettings settings;        ///< at its last point
    std::vector<LivePoint> points;  ///< at least one
    std::uint32_t passes = 0;       ///< of its film, at its last point or when another film took its place
    bool in_progress = false;       ///< the session renders it
};

/// Whether a number that was measured after so many passes is old beside a picture of `passes`: behind by more than the spacing of
/// points.
constexpr bool is_old(std::uint32_t measured, std::uint32_t passes) { return passes > measured + measured / 4 + 1; }

/// All runs at one moment; immutable, so that threads may share it.
struct LiveRunSet {
    std::vector<std::shared_ptr<const LiveRun>> runs;  ///< in the order of their first points
    std::size_t picture_bytes = 0;
    std::size_t picture_bytes_cap = 0;
    double measure_seconds = 0.0;  ///< for measuring; charged to no run
    double charged_seconds = 0.0;  ///< to all runs so far, dropped ones included
};

/// A converged picture in two halves.
struct LiveReference {
    std::uint64_t picture = 0;  ///< its picture_key()
    int width = 0;
    int height = 0;
    std::vector<Vec3f> first;
    std::vector<Vec3f> second;
};

// The choice of the picture to drop when the pictures of live runs exceed their memory.

/// A picture by its place: a run, and a point of it.
struct PicturePlace {
    std::size_t run = 0;
    std::size_t point = 0;
};

/// The picture that is needed least: of the oldest run that shows another picture than `present` (a picture_key()), if there
/// is one; else the one whose neighbors in time are closest to each other. The last picture of a run goes at the end. At
/// least one picture is left.
PicturePlace least_needed_picture(const std::vector<std::shared_ptr<const LiveRun>>& runs, std::uint64_t present);

}  // namespace pl
