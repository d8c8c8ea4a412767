#include "python/bound_learner.h"

#include <fmt/format.h>
#include <nanobind/stl/string.h>

#include "core/base/error.h"
#include "python/bindings.h"
#include "python/convert.h"

namespace pl {
namespace {

/// The argument of update(): copies, which the learner may keep.
struct BoundSamples {
    NumpyArray<std::int64_t> sums;
    NumpyArray<std::uint32_t> counts;
    NumpyArray<float> radiance;
    NumpyArray<std::uint32_t> visits;
    NumpyArray<float> positions;
    NumpyArray<float> normals;
    double unit = 0.0;
    float floor = 0.0f;
};

BoundSamples samples_of(const LearnerInput& input) {
    const std::size_t volumes = volume_count(input.tables);
    const auto cells = static_cast<std::size_t>(input.shape.cells.count());
    std::vector<Vec3f> positions;
    for (const SurfacePoint& site : input.volumes.sites) positions.push_back(site.position);
    return {.sums = copy_array<std::int64_t>(input.tables.pending_sum, {volumes, cells}),
            .counts = copy_array<std::uint32_t>(input.tables.pending_count, {volumes, cells}),
            .radiance = copy_array<float>(input.tables.radiance, {volumes, cells}),
            .visits = copy_array<std::uint32_t>(input.tables.visits, {volumes, cells}),
            .positions = own_array<float>(std::move(positions), {volumes, 3}),
            .normals = copy_array<float>(input.volumes.normals, {volumes, 3}),
            .unit = static_cast<double>(input.shape.radiance_unit) / kStepsPerUnit,
            .floor = input.shape.uniform_floor};
}

bool returns_radiance(const nb::handle& learner) {
    if (!nb::hasattr(learner, "returns")) return false;
    const std::string name = nb::str(nb::object(learner.attr("returns"))).c_str();
    if (name != "radiance" && name != "probabilities")
        throw Error(ErrorKind::Usage,
                    fmt::format("learner, returns: expected 'probabilities' or 'radiance', got '{}'", name));
    return name == "radiance";
}

}  // namespace

FieldLearner bound_learner(const nb::handle& learner) {
    if (!nb::hasattr(learner, "update") || PyType_Check(learner.ptr()))
        throw Error(ErrorKind::Usage, fmt::format("learner: expected an object with a method update(samples), got {}",
                                                  nb::repr(learner).c_str()));
    return [learner, are_radiance = returns_radiance(learner)](const LearnerInput& input) {
        const nb::gil_scoped_acquire held;
        const nb::object answer = learner.attr("update")(samples_of(input));
        const nb::tuple shape = nb::make_tuple(volume_count(input.tables), input.shape.cells.count());
        return LearnedCells{.are_radiance = are_radiance, .values = floats_of("learner", answer, shape)};
    };
}

void bind_learner(nb::module_& module) {
    nb::class_<BoundSamples>(
        module, "Samples",
        "What a learner is told at an update: the training samples since the last one, and what the table knew "
        "before.\n\n"
        "The arrays are copies. A volume keeps its number; refinement adds volumes behind the others.")
        .def_ro("sums", &BoundSamples::sums, nb::rv_policy::reference,
                "Sums of incident radiance, in steps of `unit`. (volumes, cells) int64")
        .def_ro("counts", &BoundSamples::counts, nb::rv_policy::reference,
                "Training samples. (volumes, cells) uint32")
        .def_ro("radiance", &BoundSamples::radiance, nb::rv_policy::reference,
                "Radiance learned so far. (volumes, cells) float32")
        .def_ro("visits", &BoundSamples::visits, nb::rv_policy::reference,
                "Training samples so far. (volumes, cells) uint32")
        .def_ro("positions", &BoundSamples::positions, nb::rv_policy::reference,
                "Of the volumes. (volumes, 3) float32")
        .def_ro("normals", &BoundSamples::normals, nb::rv_policy::reference, "(volumes, 3) float32")
        .def_ro("unit", &BoundSamples::unit,
                "Radiance of one step of the sums: the mean target is sums * unit / counts.")
        .def_ro("floor", &BoundSamples::floor, "Uniform share that the program mixes into the probabilities.");
}

}  // namespace pl
