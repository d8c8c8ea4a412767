#include "core/io/field_checks.h"

#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "core/base/error.h"

namespace pl {
namespace {

bool is_finite(const Vec3f& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// A frame of a longer vector would give directions outside of the direction cells.
bool is_unit(const Vec3f& v) { return std::fabs(glm::dot(v, v) - 1.0f) < 1.0e-4f; }

bool is_square(int n) {
    const std::int64_t side = std::lround(std::sqrt(static_cast<double>(n)));
    return side * side == n;
}

/// Finite and not negative.
bool is_amount(double x) { return x >= 0.0 && std::isfinite(x); }

std::string text_of(const Vec3f& v) { return fmt::format("{},{},{}", v.x, v.y, v.z); }

class Checks {
public:
    Checks(const LearnedField& field, const std::filesystem::path& path)
        : field_(field), volumes_(*field.volumes), path_(path) {}

    void run() const {
        settings();
        shape();
        sizes();
        progress();
        placement();
        tree();
        tables();
        distributions("row table", field_.tables.row_cdf);
        distributions("column table", field_.tables.column_cdf);
    }

private:
    template <class Got>
    [[noreturn]] void fail(const std::string& what, std::string_view expected, const Got& got) const {
        throw Error(ErrorKind::Input,
                    fmt::format("{}: damaged field: {}: expected {}, got {}", path_.string(), what, expected, got));
    }
    template <class Got>
    void require(bool holds, const char* what, std::string_view expected, const Got& got) const {
        if (!holds) fail(what, expected, got);
    }

    void settings() const {
        const FieldSettings& s = field_.settings;
        require(s.volumes >= 0, "volumes asked for", "0 or more", s.volumes);
        require(is_amount(s.budget_megabytes), "budget", "a number of megabytes", s.budget_megabytes);
        require(s.bins >= 4 && s.bins <= 1024 && is_square(s.bins), "bins", "a square number from 4 to 1024", s.bins);
        require(s.rate >= LearningRate::SampleMean && s.rate <= LearningRate::Forgetful, "learning rate", "1 to 4",
                static_cast<std::uint32_t>(s.rate));
        require(s.learning.target <= LearningTarget::MonteCarlo, "learning target", "0 to 2",
                static_cast<std::uint32_t>(s.learning.target));
        require(s.learning.light <= LearnedLight::Indirect, "learned light", "0 or 1",
                static_cast<std::uint32_t>(s.learning.light));
        require(s.uniform_floor >= 0.0f && s.uniform_floor <= 1.0f, "uniform share", "0 to 1", s.uniform_floor);
        require(s.precompute_samples > 0 && is_square(s.precompute_samples), "precomputed samples",
                "a square number above 0", s.precompute_samples);
        require(s.lookup <= Lookup::Grid, "lookup", "0 to 2", static_cast<std::uint32_t>(s.lookup));
        require((s.refine_share >= 0.0f && s.refine_share <= 1.0f) || s.refine_share == kRefineByRecords,
                "share of added volumes", "0 to 1, or -1", s.refine_share);
    }

    void shape() const {
        const FieldSettings& s = field_.settings;
        const FieldShape& shape = field_.shape;
        // The first conditions exclude an overflow of the product.
        require(shape.cells.side > 0 && shape.cells.side <= s.bins && shape.cells.count() == s.bins,
                "cells to a side", fmt::format("the root of {} bins", s.bins), shape.cells.side);
        const float unit = shape.radiance_unit;
        int exponent = 0;
        require(unit > 0.0f && std::isfinite(unit) && std::frexp(unit, &exponent) == 0.5f, "radiance unit",
                "a power of two", unit);
        require(is_amount(shape.extent), "extent", "0 or more", shape.extent);
        require(shape.rate == s.rate && shape.uniform_floor == s.uniform_floor && shape.lookup == s.lookup,
                "learning rate, uniform share and lookup of the tables", "those of the settings", "others");
    }

    /// All arrays have the length that follows from the number of volumes.
    void sizes() const {
        const std::size_t volumes = volumes_.normals.size();
        const auto side = static_cast<std::size_t>(field_.shape.cells.side);
        constexpr auto kMostCells = static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
        const std::size_t most = kMostCells / (side * side);
        require(volumes <= most, "volumes", fmt::format("at most {}", most), volumes);
        const HostTables& t = field_.tables;
        const std::size_t cells = volumes * side * side;
        const auto size = [&](const char* what, const auto& array, std::size_t expected) {
            require(array.size() == expected, what, fmt::format("{} values", expected), array.size());
        };
        size("places", volumes_.sites, volumes);
        require(field_.refinement.added <= volumes, "added volumes", fmt::format("at most {}", volumes),
                field_.refinement.added);
        require(volumes_.kd_nodes.size() <= volumes, "search tree", fmt::format("at most {} values", volumes),
                volumes_.kd_nodes.size());
        size("radiance", t.radiance, cells);
        size("visits", t.visits, cells);
        size("sums", t.pending_sum, cells);
        size("counts", t.pending_count, cells);
        size("row table", t.row_cdf, volumes * side);
        size("column table", t.column_cdf, cells);
        size("mean radiance", t.mean_radiance, volumes);
        size("changes", t.change, volumes);
        size("slopes of the mixture", t.pending_slope, volumes);
        size("curvatures of the mixture", t.pending_curvature, volumes);
        size("targets of the mixture", t.mixture_target, volumes);
        size("weights of the mixture", t.mixture_weight, volumes);
        size("BSDF shares", t.bsdf_fraction, volumes);
        size("sums of distances", t.pending_distance, volumes);
        size("sums of light", t.pending_light, volumes);
        size("distances of the reach", t.reach_distance, volumes);
        size("weights of the reach", t.reach_weight, volumes);
        size("inverse reaches", t.inverse_reach, volumes);
    }

    void progress() const {
        const FieldProgress& p = field_.progress;
        const auto slices = static_cast<std::uint32_t>(field_.settings.precompute_samples);
        const std::size_t probes = p.precomputed_slices < slices ? field_.tables.radiance.size() : 0;
        require(p.precomputed_slices <= slices, "precomputed slices", fmt::format("at most {}", slices),
                p.precomputed_slices);
        require(p.next_probe == 0 || p.next_probe < probes, "next probe", fmt::format("0, or below {}", probes),
                p.next_probe);
        require(is_amount(p.precompute_seconds), "seconds of precomputation", "a time", p.precompute_seconds);
    }

    /// SurfacePoint::primitive is only compared and SurfacePoint::material is unused, so neither needs a range.
    void placement() const {
        for (std::size_t i = 0; i < volumes_.sites.size(); ++i) {
            const SurfacePoint& site = volumes_.sites[i];
            if (!is_finite(site.position))
                fail(fmt::format("place of volume {}", i), "a finite position", text_of(site.position));
            if (!is_amount(site.position_error))
                fail(fmt::format("place of volume {}", i), "an error bound", site.position_error);
            for (const Vec3f& normal : {site.geometric_normal, site.shading_normal, volumes_.normals[i]})
                if (!is_unit(normal))
                    fail(fmt::format("normal of volume {}", i), "a vector of length 1", text_of(normal));
        }
    }

    void tree() const {
        for (std::size_t i = 0; i < volumes_.kd_nodes.size(); ++i) {
            const KdNode& node = volumes_.kd_nodes[i];
            const auto name = [i] { return fmt::format("node {} of the search tree", i); };
            if (node.volume >= volumes_.sites.size())
                fail(name(), fmt::format("a volume below {}", volumes_.sites.size()), node.volume);
            if (node.axis > 2) fail(name(), "an axis from 0 to 2", node.axis);
            const SurfacePoint& site = volumes_.sites[node.volume];
            if (node.position != site.position)
                fail(name(), "the position " + text_of(site.position), text_of(node.position));
            if (node.normal != site.geometric_normal)
                fail(name(), "the normal " + text_of(site.geometric_normal), text_of(node.normal));
        }
    }

    void tables() const {
        const HostTables& t = field_.tables;
        constexpr double kMostPerRecord = static_cast<double>(kMaxRecordedUnits) * kStepsPerUnit;
        for (std::size_t i = 0; i < t.radiance.size(); ++i) {
            if (!is_amount(t.radiance[i])) fail(fmt::format("radiance of cell {}", i), "0 or more", t.radiance[i]);
            const double most = t.pending_count[i] * kMostPerRecord;
            if (t.pending_sum[i] < 0 || static_cast<double>(t.pending_sum[i]) > most)
                fail(fmt::format("sum of cell {}", i), fmt::format("0 to {}", most), t.pending_sum[i]);
        }
        const auto amounts = [this](const char* what, const LargeArray<float>& values) {
            for (std::size_t i = 0; i < values.size(); ++i)
                if (!is_amount(values[i])) fail(fmt::format("{} of volume {}", what, i), "0 or more", values[i]);
        };
        amounts("mean radiance", t.mean_radiance);
        amounts("change", t.change);
        amounts("weight of the mixture", t.mixture_weight);
        amounts("distance of the reach", t.reach_distance);
        amounts("weight of the reach", t.reach_weight);
        amounts("inverse reach", t.inverse_reach);
        for (std::size_t i = 0; i < t.bsdf_fraction.size(); ++i) mixture(i);
        for (std::size_t i = 0; i < t.inverse_reach.size(); ++i) reach(i);
    }

    void mixture(std::size_t volume) const {
        const HostTables& t = field_.tables;
        const float share = t.bsdf_fraction[volume];
        if (!(share >= kMinBsdfFraction && share <= kMaxBsdfFraction))
            fail(fmt::format("BSDF share of volume {}", volume),
                 fmt::format("{} to {}", kMinBsdfFraction, kMaxBsdfFraction), share);
        if (!std::isfinite(t.mixture_target[volume]))
            fail(fmt::format("target of the mixture of volume {}", volume), "a finite number",
                 t.mixture_target[volume]);
        if (t.pending_curvature[volume] < 0)
            fail(fmt::format("curvature of the mixture of volume {}", volume), "0 or more",
                 t.pending_curvature[volume]);
    }

    void reach(std::size_t volume) const {
        const HostTables& t = field_.tables;
        const std::int64_t light = t.pending_light[volume];
        if (light < 0 || t.pending_distance[volume] < 0 || t.pending_distance[volume] > light)
            fail(fmt::format("distance of volume {}", volume), fmt::format("0 to {}", light),
                 t.pending_distance[volume]);
    }

    /// Every row of cumulative probabilities ascends from at least 0 to exactly 1.
    void distributions(const char* what, const LargeArray<float>& cdf) const {
        const auto side = static_cast<std::size_t>(field_.shape.cells.side);
        for (std::size_t i = 0; i < cdf.size(); ++i) {
            const float before = i % side == 0 ? 0.0f : cdf[i - 1];
            const bool last = i % side == side - 1;
            if (!(cdf[i] >= before && cdf[i] <= 1.0f) || (last && cdf[i] != 1.0f))
                fail(fmt::format("entry {} of the {}", i, what),
                     last ? "1" : fmt::format("a probability from {} to 1", before), cdf[i]);
        }
    }

    const LearnedField& field_;
    const HostVolumes& volumes_;
    const std::filesystem::path& path_;
};

}  // namespace

void require_usable(const LearnedField& field, const std::filesystem::path& path) { Checks(field, path).run(); }

}  // namespace pl
