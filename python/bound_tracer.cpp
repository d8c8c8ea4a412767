// Path tracing batch by batch, with directions that a Python object samples.
#include <fmt/format.h>
#include <nanobind/stl/string.h>

#include "core/base/error.h"
#include "core/diagnose/batch_tracer.h"
#include "core/scene/pack_scene.h"
#include "core/session/path_settings.h"
#include "python/bindings.h"
#include "python/bound_scene.h"
#include "python/caller.h"
#include "python/convert.h"

namespace pl {
namespace {

using diagnose::PathVertex;

nb::object vertex_type() {
    nb::list members;
    const auto add = [&](const char* name, const char* type, int count) {
        members.append(count == 1 ? nb::make_tuple(name, type) : nb::make_tuple(name, type, count));
    };
    for (const char* name : {"pixel", "sample", "depth"}) add(name, "<u4", 1);
    for (const char* name : {"position", "normal", "outgoing", "albedo"}) add(name, "<f4", 3);
    add("uniforms", "<f4", 2);
    for (const char* name : {"throughput", "direction"}) add(name, "<f4", 3);
    add("pdf", "<f4", 1);
    add("incident", "<f4", 3);
    return nb::module_::import_("numpy").attr("dtype")(members);
}

nb::object vertex_array(std::vector<PathVertex> vertices) {
    const std::size_t count = vertices.size();
    const nb::object bytes =
        nb::cast(own_array<std::uint8_t>(std::move(vertices), {count, sizeof(PathVertex)}), nb::rv_policy::reference);
    return bytes.attr("view")(vertex_type()).attr("reshape")(-1);
}

[[noreturn]] void refuse(const char* method, std::size_t i, const PathVertex& vertex, const char* expected,
                         const std::string& got) {
    const Vec3f& at = vertex.position;
    throw Error(ErrorKind::Input, fmt::format("sampler.{}, vertex {} at ({:g}, {:g}, {:g}): expected {}, got {}",
                                              method, i, at.x, at.y, at.z, expected, got));
}

std::vector<Vec3f> ask_directions(nb::handle sampler, std::span<const PathVertex> vertices) {
    const nb::gil_scoped_acquire held;
    const nb::object answer = sampler.attr("sample")(vertex_array({vertices.begin(), vertices.end()}));
    const std::vector<float> values = floats_of("sampler.sample", answer, nb::make_tuple(vertices.size(), 3));
    std::vector<Vec3f> directions;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const Vec3f wi{values[3 * i], values[3 * i + 1], values[3 * i + 2]};
        const float length = glm::length(wi);
        if (!(std::fabs(length - 1.0f) < 1e-3f))
            refuse("sample", i, vertices[i], "a unit vector", fmt::format("({:g}, {:g}, {:g})", wi.x, wi.y, wi.z));
        directions.push_back(wi / length);
    }
    return directions;
}

std::vector<float> ask_densities(nb::handle sampler, std::span<const PathVertex> vertices,
                                 std::span<const Vec3f> directions) {
    const nb::gil_scoped_acquire held;
    const nb::object answer = sampler.attr("pdf")(vertex_array({vertices.begin(), vertices.end()}),
                                                  copy_array<float>(directions, {directions.size(), 3}));
    const std::vector<float> values = floats_of("sampler.pdf", answer, nb::make_tuple(vertices.size()));
    for (std::size_t i = 0; i < vertices.size(); ++i)
        if (!(values[i] >= 0.0f) || std::isinf(values[i]))
            refuse("pdf", i, vertices[i], "a finite density, not negative", fmt::format("{:g}", values[i]));
    return values;
}

/// A tracer as Python holds it.
class BoundTracer {
public:
    BoundTracer(const BoundScene& scene, const nb::object& sampler, float bsdf_fraction,
                const RenderSettings& settings)
        : tracer_(std::make_shared<const HostScene>(pack_scene(*scene.description)),
                  make_camera(scene.description->camera, settings.width, settings.height), settings.width,
                  settings.height, path_settings(settings, MethodId::Default)) {
        if (!(bsdf_fraction >= 0.0f && bsdf_fraction <= 1.0f))
            throw Error(ErrorKind::Usage, fmt::format("bsdf_fraction: expected 0 to 1, got {:g}", bsdf_fraction));
        if (sampler.is_none()) return;
        if (!nb::hasattr(sampler, "sample") || !nb::hasattr(sampler, "pdf") || PyType_Check(sampler.ptr()))
            throw Error(ErrorKind::Usage,
                        fmt::format("sampler: expected an object with methods sample(vertices) and pdf(vertices, "
                                    "directions), got {}",
                                    nb::repr(sampler).c_str()));
        object_ = sampler;
        sampler_ = {.sample = [asked = nb::handle(sampler)](
                                  std::span<const PathVertex> vertices) { return ask_directions(asked, vertices); },
                    .pdf =
                        [asked = nb::handle(sampler)](std::span<const PathVertex> vertices,
                                                      std::span<const Vec3f> directions) {
                            return ask_densities(asked, vertices, directions);
                        },
                    .bsdf_fraction = bsdf_fraction};
    }

    nb::object trace() {
        const SoleUse held = use();
        std::vector<PathVertex> vertices;
        {
            const nb::gil_scoped_release released;
            vertices = object_.is_valid() ? tracer_.trace(sampler_) : tracer_.trace();
        }
        return vertex_array(std::move(vertices));
    }

    NumpyArray<float> film() const {
        const SoleUse held = use();
        std::vector<Vec3f> pixels;
        for (const FilmPixel& pixel : tracer_.film()) pixels.push_back(mean_or_nan(pixel));
        return own_array<float>(std::move(pixels), {static_cast<std::size_t>(tracer_.height()),
                                                    static_cast<std::size_t>(tracer_.width()), 3});
    }

    std::uint32_t passes() const {
        const SoleUse held = use();
        return tracer_.passes();
    }

    std::uint64_t invalid_samples() const {
        const SoleUse held = use();
        std::uint64_t count = 0;
        for (const FilmPixel& pixel : tracer_.film()) count += pixel.invalid;
        return count;
    }

    const nb::object& called() const { return object_; }
    void drop_called() { object_.reset(); }

private:
    SoleUse use() const { return {is_used_, "tracer"}; }

    nb::object object_;  ///< null without a sampler
    diagnose::DirectionSampler sampler_;
    diagnose::BatchTracer tracer_;
    mutable std::atomic<bool> is_used_{false};
};

}  // namespace

void bind_tracer(nb::module_& module) {
    nb::class_<BoundTracer>(module, "PathTracer", nb::type_slots(CallerSlots<BoundTracer>::slots),
                            "Path tracing batch by batch, with the vertices of all paths as arrays, and "
                            "directions of your own. Slow: for trying ideas at small sizes.")
        .def(
            "__init__",
            [](BoundTracer* self, const BoundScene& scene, const nb::object& sampler, int width, int height,
               std::uint64_t seed, bool nee, int max_depth, bool roulette, float bsdf_fraction) {
                if (width < 1 || height < 1 || std::int64_t{width} * height > 1 << 24)
                    throw Error(ErrorKind::Usage,
                                fmt::format("width, height: expected 1 to 2^24 pixels, got {}x{}", width, height));
                if (max_depth < 1)
                    throw Error(ErrorKind::Usage, fmt::format("max_depth: expected at least 1, got {}", max_depth));
                RenderSettings settings{
                    .width = width, .height = height, .seed = seed, .max_depth = max_depth, .next_event = nee};
                if (!roulette) settings.roulette = kNoRoulette;
                new (self) BoundTracer(scene, sampler, bsdf_fraction, settings);
            },
            nb::arg("scene"), nb::arg("sampler") = nb::none(), nb::kw_only(), nb::arg("width") = 64,
            nb::arg("height") = 64, nb::arg("seed") = 1, nb::arg("nee") = true, nb::arg("max_depth") = 64,
            nb::arg("roulette") = true, nb::arg("bsdf_fraction") = 0.5f,
            "sampler: an object with two methods, called with the vertices of a batch, a structured array (n,) "
            "as trace() returns it, whose direction, pdf and incident are not known yet. sample(vertices) "
            "returns unit vectors (n, 3), by the uniform numbers vertices['uniforms'] or others of its own; "
            "pdf(vertices, directions) returns their densities per steradian (n,).\n\n"
            "A path takes its direction from the BSDF with probability bsdf_fraction, else from the sampler; "
            "both densities, and those of light samples (nee), are weighed exactly. The mean of the film is "
            "right if pdf() is the density of sample(), does not change within a call of trace(), and together "
            "with the BSDF's share is positive wherever light is reflected. What it answers at delta lobes is "
            "not used. Without a sampler it is the method `default`.")
        .def("trace", &BoundTracer::trace,
             "Adds a sample to every pixel of the film. Returns the vertices of the new paths, by depth, then by "
             "pixel, a structured array: pixel, sample, depth; position, normal, outgoing, albedo; uniforms; "
             "throughput on arrival; direction; its pdf per steradian, 0 of a delta lobe; incident, the path's "
             "estimate of the radiance from there, in which emission that light samples find as well has the "
             "weight of the direction alone. Where a path ends direction, pdf and incident are 0.")
        .def("film", &BoundTracer::film, "Mean radiance, linear RGB. (height, width, 3) float32")
        .def_prop_ro("passes", &BoundTracer::passes, "Samples per pixel.")
        .def_prop_ro("invalid_samples", &BoundTracer::invalid_samples,
                     "Samples left out of the film: not finite, or negative.");
}

}  // namespace pl
