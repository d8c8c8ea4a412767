#include "core/io/field_file.h"

#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/square_number.h"
#include "core/fields/field_kernels.h"
#include "core/io/files.h"
#include "core/io/sealed_file.h"
#include "core/kernel/base/math.h"

namespace pl {
namespace {

/// A frame of a longer vector would give directions outside of the direction cells.
bool is_unit(const Vec3f& v) { return std::fabs(glm::dot(v, v) - 1.0f) < 1.0e-4f; }

bool is_bsdf_fraction(float x) { return x >= kMinBsdfFraction && x <= kMaxBsdfFraction; }

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
        arrays();
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

    template <Described Enum>
    void require_choice(const char* what, Enum value) const {
        require(is_choice(value), what, "one of " + choice_numbers<Enum>(), static_cast<std::uint32_t>(value));
    }

    void settings() const {
        const FieldSettings& s = field_.settings;
        require(s.volumes >= 0, "volumes asked for", "0 or more", s.volumes);
        require(is_amount(s.budget_megabytes), "budget", "a number of megabytes", s.budget_megabytes);
        require(s.bins >= 4 && s.bins <= 1024 && is_square(s.bins), "bins", "a square number from 4 to 1024", s.bins);
        require_choice("learning rate", s.rate);
        require_choice("learning target", s.learning.target);
        require_choice("learned light", s.learning.light);
        require(s.uniform_floor >= 0.0f && s.uniform_floor <= 1.0f, "uniform share", "0 to 1", s.uniform_floor);
        require(s.precompute_samples > 0 && is_square(s.precompute_samples), "precomputed samples",
                "a square number above 0", s.precompute_samples);
        require_representation(s.representation, path_, "field");
        require(has_target(s.representation, s.learning.target), "learning target",
                "0, that of Expected Sarsa, unless it is a table", static_cast<std::uint32_t>(s.learning.target));
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
        require(shape.light_clusters <= kMostLightClusters, "clusters of lights",
                fmt::format("at most {}", kMostLightClusters), shape.light_clusters);
        require(is_amount(shape.extent), "extent", "0 or more", shape.extent);
        require(shape.rate == s.rate && shape.uniform_floor == s.uniform_floor,
                "learning rate and uniform share of the tables", "those of the settings", "others");
        require(shape.representation == s.representation, "representation of the shape", "that of the settings",
                "another");
        require(is_finite(shape.corner), "corner of the cube", "a finite position", text_of(shape.corner));
        require(shape.edge > 0.0f && std::isfinite(shape.edge), "edge of the cube", "a length above 0", shape.edge);
        require(shape.most_nodes > 0 && shape.most_nodes <= kMostQuadNodes, "nodes of quadtrees",
                fmt::format("1 to {}", kMostQuadNodes), shape.most_nodes);
        const Representation expected = representation_of(s, field_.method);
        require(representation_of(field_.field) == expected, "representation of the arrays",
                fmt::format("{}", static_cast<std::uint32_t>(expected)),
                static_cast<std::uint32_t>(representation_of(field_.field)));
    }

    /// All arrays have the length that follows from the number of volumes.
    void sizes() const {
        const std::size_t volumes = volumes_.normals.size();
        const std::size_t side = cells_to_a_side();
        constexpr auto kMostCells = static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
        const std::size_t most = kMostCells / (side * side);
        require(volumes <= most, "volumes", fmt::format("at most {}", most), volumes);
        const auto size = [&](const char* what, const auto& array, std::size_t expected) {
            require(array.size() == expected, what, fmt::format("{} values", expected), array.size());
        };
        size("places", volumes_.sites, volumes);
        require(field_.refinement.added <= volumes, "added volumes", fmt::format("at most {}", volumes),
                field_.refinement.added);
        require(volumes_.kd_nodes.size() <= volumes, "search tree", fmt::format("at most {} values", volumes),
                volumes_.kd_nodes.size());
        std::visit(
            [&](const auto& arrays) {
                for_each_array(arrays, [&](const auto& spec, const auto& array) {
                    size(spec.name, array, length_of(spec, field_.shape, arrays, volumes));
                });
            },
            field_.field);
    }

    void progress() const {
        const FieldProgress& p = field_.progress;
        const auto slices = static_cast<std::uint32_t>(field_.settings.precompute_samples);
        const std::size_t all = volumes_.normals.size() * static_cast<std::size_t>(field_.shape.cells.count());
        const std::size_t probes = p.precomputed_slices < slices ? all : 0;
        require(p.precomputed_slices <= slices, "precomputed slices", fmt::format("at most {}", slices),
                p.precomputed_slices);
        require(p.next_probe == 0 || p.next_probe < probes, "next probe", fmt::format("0, or below {}", probes),
                p.next_probe);
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

    /// The values of each array by its valid range, and those that are valid only together.
    void arrays() const {
        std::visit(
            [&](const auto& arrays) {
                for_each_array(arrays, [&](const auto& spec, const auto& array) { values_of(spec, array); });
                if (const std::optional<FieldDamage> damage = damage_of(arrays))
                    fail(damage->what, damage->expected, damage->got);
            },
            field_.field);
    }

    template <class Spec, class Array>
    void values_of(const Spec& spec, const Array& values) const {
        const auto all = [&](std::string_view expected, const auto& is_valid) {
            for (std::size_t i = 0; i < values.size(); ++i)
                if (!is_valid(values[i]))
                    fail(fmt::format("{} of {} {}", spec.single, spec.owner.name, i), expected, values[i]);
        };
        switch (spec.valid) {
        case ValidRange::Any: break;
        case ValidRange::Amount: all("0 or more", [](auto x) { return is_amount(static_cast<double>(x)); }); break;
        case ValidRange::Finite:
            all("a finite number", [](auto x) { return std::isfinite(static_cast<double>(x)); });
            break;
        case ValidRange::NotNegative: all("0 or more", [](auto x) { return x >= 0; }); break;
        case ValidRange::BsdfFraction:
            all(fmt::format("{} to {}", kMinBsdfFraction, kMaxBsdfFraction),
                [](auto x) { return is_bsdf_fraction(static_cast<float>(x)); });
            break;
        case ValidRange::Cumulative: distributions(spec.name, values, cells_to_a_side(), false); break;
        case ValidRange::Choice: distributions(spec.name, values, field_.shape.light_clusters, true); break;
        }
    }

    /// Each row of cumulative probabilities rises from at least 0 to exactly 1, or is all 0 if it `may_be_unknown`.
    template <class Array>
    void distributions(const char* what, const Array& cdf, std::size_t length, bool may_be_unknown) const {
        for (std::size_t i = 0; i < cdf.size(); ++i) {
            const auto before = i % length == 0 ? typename Array::value_type{} : cdf[i - 1];
            const bool last = i % length == length - 1;
            if (!(cdf[i] >= before && cdf[i] <= 1) || (last && cdf[i] != 1 && !(may_be_unknown && cdf[i] == 0)))
                fail(fmt::format("entry {} of the {}", i, what),
                     last ? "1" : fmt::format("a probability from {} to 1", before), cdf[i]);
        }
    }

    std::size_t cells_to_a_side() const { return static_cast<std::size_t>(field_.shape.cells.side); }

    const LearnedField& field_;
    const HostVolumes& volumes_;
    const std::filesystem::path& path_;
};

}  // namespace

void require_usable(const LearnedField& field, const std::filesystem::path& path) { Checks(field, path).run(); }

namespace {

constexpr SealedKind kFieldKind{.magic = "PLFIELD\n", .version = 10, .title = "learned field", .word = "field"};

template <class Stream, class Field>
void transfer_header(Stream& stream, Field& field) {
    stream.text(field.scene_hash);
    transfer_settings(stream, field.settings);
    transfer_shape(stream, field.shape);
    transfer_refinement(stream, field.refinement);
    auto& progress = field.progress;
    const auto all = [&](auto&... values) { (transfer(stream, values), ...); };
    all(progress.passes, progress.records, progress.clamped_records, progress.lookup_misses,
        progress.precomputed_slices, progress.next_probe);
}

LearnedField read_content(std::string_view content, const std::filesystem::path& path) {
    BinaryReader reader(content, path, kFieldKind.word);
    LearnedField field;
    std::string method;
    reader.text(method);
    const std::optional<MethodId> known = method_by_name(method);
    if (!known || !info_of(*known).uses_field)
        fail_damaged(path, kFieldKind.word, fmt::format("expected a method that learns, got '{}'", method));
    field.method = *known;
    transfer_header(reader, field);
    HostVolumes volumes;
    transfer_volumes(reader, volumes);
    transfer_tables(reader, field.field);
    reader.require_end();
    field.volumes = std::make_shared<const HostVolumes>(std::move(volumes));
    return field;
}

}  // namespace

void write_field(const std::filesystem::path& path, const LearnedField& field) {
    BinaryWriter writer = begin_sealed(kFieldKind);
    writer.text(std::string(info_of(field.method).name));
    transfer_header(writer, field);
    transfer_volumes(writer, *field.volumes);
    transfer_tables(writer, field.field);
    write_sealed(path, std::move(writer));
}

LearnedField read_field(const std::filesystem::path& path) {
    const std::string bytes = read_file(path);
    LearnedField field = read_content(sealed_content(bytes, path, kFieldKind), path);
    require_usable(field, path);
    return field;
}

}  // namespace pl
