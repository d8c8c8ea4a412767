#include "python/bound_field.h"

#include <fmt/format.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>

#include "core/base/error.h"
#include "core/fields/inspect_field.h"
#include "core/io/field_file.h"
#include "python/bindings.h"
#include "python/convert.h"

namespace pl {
namespace {

/// One value for each cell or volume. `of`: from an inspection of the volume.
template <class T, class Of>
std::vector<T> gather(BoundField& field, Of&& of) {
    const AnyFieldView view = field.view();
    std::vector<T> values;
    for (std::size_t volume = 0; volume < field.volumes(); ++volume) {
        const auto more = of(inspect_volume(view, static_cast<std::int32_t>(volume)));
        if constexpr (requires { more.begin(); })
            values.insert(values.end(), more.begin(), more.end());
        else
            values.push_back(more);
    }
    return values;
}
template <class T, auto kMember>
NumpyArray<T> cell_array(BoundField& field) {
    return own_array<T>(gather<T>(field, [](const VolumeInspection& v) { return v.*kMember; }),
                        {field.volumes(), field.cells()});
}
template <auto kMember>
NumpyArray<float> volume_array(BoundField& field) {
    return own_array<float>(gather<float>(field, [](const VolumeInspection& v) { return v.*kMember; }),
                            {field.volumes()});
}

NumpyArray<float> position_array(const BoundField& field) {
    std::vector<Vec3f> positions;
    for (const SurfacePoint& site : field.learned.volumes->sites) positions.push_back(site.position);
    return own_array<float>(std::move(positions), {field.volumes(), 3});
}

/// World directions through the middles of the cells of every volume.
NumpyArray<float> direction_array(const BoundField& field) {
    const DirectionCells& cells = field.learned.shape.cells;
    std::vector<Vec3f> directions;
    for (const Vec3f& normal : field.learned.volumes->normals)
        for (int cell = 0; cell < cells.count(); ++cell)
            directions.push_back(
                make_frame(normal).to_world(square_to_cosine_hemisphere(cells.point_in_cell(cell, Vec2f{0.5f}))));
    return own_array<float>(std::move(directions), {field.volumes(), field.cells(), 3});
}

void require_length(const char* name, std::size_t expected, std::size_t got) {
    if (expected != got)
        throw Error(ErrorKind::Input,
                    fmt::format("{}: expected {} rows as positions have, got {}", name, expected, got));
}

SurfacePoint surface_at(const Vectors& positions, const Vectors& normals, std::size_t i) {
    SurfacePoint surface;
    surface.position = vector_at(positions, i);
    surface.geometric_normal = surface.shading_normal = vector_at(normals, i);
    return surface;
}

/// Calls visit(view, location, surface, i) for the points that a volume serves.
template <class Visit>
void at_points(BoundField& field, const Vectors& positions, const Vectors& normals, Visit&& visit) {
    require_length("normals", positions.shape(0), normals.shape(0));
    const AnyFieldView any = field.view();
    visit_field(any, [&](const auto& view) {
        for (std::size_t i = 0; i < positions.shape(0); ++i) {
            const SurfacePoint surface = surface_at(positions, normals, i);
            const auto location = view.locate(surface);
            if (location.is_served()) visit(view, location, surface, i);
        }
    });
}

NumpyArray<float> densities(BoundField& field, const Vectors& positions, const Vectors& normals,
                            const Vectors& directions) {
    require_length("directions", positions.shape(0), directions.shape(0));
    std::vector<float> values(positions.shape(0), std::numeric_limits<float>::quiet_NaN());
    at_points(field, positions, normals,
              [&](const auto& view, const auto& location, const SurfacePoint& surface, std::size_t i) {
                  values[i] = view.density(location, surface, vector_at(directions, i)).pdf_sa;
              });
    return own_array<float>(std::move(values), {positions.shape(0)});
}

std::pair<NumpyArray<float>, NumpyArray<float>> sample(BoundField& field, const Vectors& positions,
                                                       const Vectors& normals, const Pairs& numbers) {
    require_length("numbers", positions.shape(0), numbers.shape(0));
    const std::size_t count = positions.shape(0);
    std::vector<Vec3f> directions(count, Vec3f{std::numeric_limits<float>::quiet_NaN()});
    std::vector<float> values(count, std::numeric_limits<float>::quiet_NaN());
    at_points(field, positions, normals,
              [&](const auto& view, const auto& location, const SurfacePoint& surface, std::size_t i) {
                  ScatterUniforms uniforms;
                  uniforms.rng.pixel = static_cast<std::uint32_t>(i);
                  uniforms.u = {0.0f, numbers(i, 0), numbers(i, 1), 0.0f};
                  directions[i] = view.sample(location, surface, uniforms);
                  values[i] = view.density(location, surface, directions[i]).pdf_sa;
              });
    return {own_array<float>(std::move(directions), {count, 3}), own_array<float>(std::move(values), {count})};
}

std::string words_of(const BoundField& field) {
    return fmt::format("<pathlight.Field: {}>", summary_of(field.learned));
}

}  // namespace

void bind_field(nb::module_& module) {
    nb::class_<BoundField>(
        module, "Field",
        "A learned field as it was when the session was asked. Arrays are copies of what its volumes hold.")
        .def_prop_ro("positions", &position_array, nb::rv_policy::reference, "Of the volumes. (volumes, 3) float32")
        .def_prop_ro(
            "normals",
            [](const BoundField& field) {
                return copy_array<float>(field.learned.volumes->normals, {field.volumes(), 3});
            },
            nb::rv_policy::reference, "(volumes, 3) float32")
        .def_prop_ro("directions", &direction_array, nb::rv_policy::reference,
                     "World directions through the middles of the cells. (volumes, cells, 3) float32")
        .def_prop_ro("radiance", &cell_array<float, &VolumeInspection::radiance>, nb::rv_policy::reference,
                     "Learned incident radiance. (volumes, cells) float32")
        .def_prop_ro("probabilities", &cell_array<float, &VolumeInspection::probability>, nb::rv_policy::reference,
                     "Of sampling each cell; cells have equal projected solid angles. (volumes, cells) float32")
        .def_prop_ro("visits", &cell_array<std::uint32_t, &VolumeInspection::visits>, nb::rv_policy::reference,
                     "Training samples. (volumes, cells) uint32")
        .def_prop_ro("mean_radiance", &volume_array<&VolumeInspection::mean_radiance>, nb::rv_policy::reference,
                     "Irradiance / pi. (volumes,) float32")
        .def_prop_ro("bsdf_fraction", &volume_array<&VolumeInspection::bsdf_fraction>, nb::rv_policy::reference,
                     "Share of BSDF samples in the mixture that guides paths. (volumes,) float32")
        .def("pdf", &densities, nb::arg("positions"), nb::arg("normals"), nb::arg("directions"),
             "Density of the field per steradian, without the BSDF's part of the mixture. All (n, 3) -> (n,) "
             "float32; nan where no volume serves the point.")
        .def("sample", &sample, nb::arg("positions"), nb::arg("normals"), nb::arg("numbers"),
             "Directions by uniform numbers (n, 2), and their densities: (n, 3) and (n,) float32; nan where no "
             "volume serves the point.")
        .def("plot", python_method("_plots", "plot_hemisphere"),
             nb::sig("def plot(self, volume: int, values: str = 'radiance', axes: object | None = None, "
                     "brightest: float | None = None) -> object"),
             "Draws the hemisphere of a volume as seen along its normal, by matplotlib: equal areas of the disc "
             "for equal projected solid angles.\n\n"
             "values: 'radiance', 'probabilities' or 'visits'. axes: of matplotlib; new ones by default. "
             "brightest: value of the brightest color, the largest one by default. Returns the axes.")
        .def(
            "save",
            [](const BoundField& field, const std::filesystem::path& path) { write_field(path, field.learned); },
            nb::arg("path"), "Writes the file that Session(load_field=...) and `--load-field` continue from.")
        .def("__len__", &BoundField::volumes)
        .def("__repr__", &words_of);
}

}  // namespace pl
