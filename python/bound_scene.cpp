#include "python/bound_scene.h"

#include <map>
#include <optional>

#include <fmt/format.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "app/option_parsers.h"
#include "core/base/error.h"
#include "core/base/timer.h"
#include "core/io/camera_file.h"
#include "core/io/load_scene.h"
#include "core/io/scene_materials.h"
#include "core/scene/validate.h"
#include "python/bindings.h"
#include "python/convert.h"

namespace pl {
namespace {

namespace fs = std::filesystem;

void warn_about(const SceneDescription& scene) {
    for (const std::string& warning : scene.warnings)
        if (PyErr_WarnEx(PyExc_UserWarning, warning.c_str(), 1) != 0) throw nb::python_error();
}

BoundScene open_scene(const fs::path& path, const std::map<std::string, nb::object>& parameters,
                      const std::string& camera, const std::optional<fs::path>& materials,
                      std::optional<bool> default_light, const std::optional<std::string>& up_axis) {
    BoundScene scene{.name = path.string(), .description = {}};
    scene.load = {.camera = camera, .materials = materials.value_or(fs::path()), .default_light = default_light};
    for (const auto& [key, value] : parameters) scene.load.parameters.emplace_back(key, nb::str(value).c_str());
    if (up_axis) scene.load.up_axis = parse_choice<UpAxis>(*up_axis);
    {
        const nb::gil_scoped_release released;
        const Stopwatch watch;
        scene.description =
            std::make_shared<const SceneDescription>(load_scene(scene.name, find_assets_dir(), scene.load));
        scene.load_seconds = watch.seconds();
    }
    warn_about(*scene.description);
    return scene;
}

/// Named materials, each with the members of a scene file. In the order of the dictionary.
void read_material_dict(const nb::dict& materials, SceneDescription& scene) {
    for (const auto& [name, values] : materials) {
        MaterialDescription& material = scene.materials.emplace_back();
        material.name = nb::cast<std::string>(name);
    }
    read_materials(JsonDocument(fmt::format("{{\"materials\": {}}}", json_text(materials)), "materials"), scene);
}

using Indices = nb::ndarray<const std::uint32_t, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using MaterialNumbers = nb::ndarray<const std::uint32_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

BoundScene scene_from_arrays(const Vectors& vertices, const Indices& triangles, const nb::dict& materials,
                             const std::optional<MaterialNumbers>& material_of, const nb::dict& camera,
                             const nb::dict& environment) {
    if (material_of && material_of->shape(0) != triangles.shape(0))
        throw Error(ErrorKind::Input, fmt::format("material_of: expected a number for each of {} triangles, got {}",
                                                  triangles.shape(0), material_of->shape(0)));
    SceneDescription scene;
    scene.name = "arrays";
    scene.source = "arrays";
    for (std::size_t i = 0; i < vertices.shape(0); ++i) scene.positions.push_back(vector_at(vertices, i));
    for (std::size_t i = 0; i < triangles.shape(0); ++i)
        scene.triangles.push_back({.vertex = {triangles(i, 0), triangles(i, 1), triangles(i, 2)},
                                   .material = material_of ? (*material_of)(i) : 0});
    read_material_dict(materials, scene);
    read_environment(JsonDocument(fmt::format("{{\"environment\": {}}}", json_text(environment)), "environment"),
                     scene);
    validate_scene(scene);
    set_default_camera(scene);
    CameraChoice choice;
    read_camera_parts(JsonDocument(json_text(camera), "camera"), "", choice);
    scene.camera = replaced(scene.camera, choice);
    validate_scene(scene);
    scene.camera.up = usable_up(scene.camera);
    return {.name = "arrays",
            .description = std::make_shared<const SceneDescription>(std::move(scene)),
            .is_from_arrays = true};
}

nb::dict material_dict(const SceneDescription& scene) {
    nb::dict all;
    for (const MaterialDescription& material : scene.materials)
        all[material.name.c_str()] = from_json(material_json(material));
    return all;
}

nb::dict parameter_dict(const SceneDescription& scene) {
    nb::dict all;
    for (const KnobDescription& knob : scene.knobs) all[knob.name.c_str()] = knob.value;
    return all;
}

NumpyArray<std::uint32_t> triangle_array(const SceneDescription& scene) {
    std::vector<glm::uvec3> corners;
    for (const TriangleDescription& triangle : scene.triangles) corners.push_back(triangle.vertex);
    const std::size_t count = corners.size();
    return own_array<std::uint32_t>(std::move(corners), {count, 3});
}

std::string words_of(const BoundScene& scene) {
    return fmt::format("<pathlight.Scene '{}': {} triangles, {} materials>", scene.name,
                       scene.description->triangles.size(), scene.description->materials.size());
}

}  // namespace

void bind_scene(nb::module_& module) {
    module.def(
        "scenes", [] { return list_scenes(find_assets_dir()); }, "Names of the scenes that come with pathlight.");
    nb::class_<BoundScene>(module, "Scene", "A scene: surfaces, lights and a camera. It does not change.")
        .def(
            "__init__",
            [](BoundScene* self, const fs::path& name, const std::map<std::string, nb::object>& parameters,
               const std::string& camera, const std::optional<fs::path>& materials, std::optional<bool> default_light,
               const std::optional<std::string>& up_axis) {
                new (self) BoundScene(open_scene(name, parameters, camera, materials, default_light, up_axis));
            },
            nb::arg("name"), nb::kw_only(), nb::arg("parameters") = std::map<std::string, nb::object>(),
            nb::arg("camera") = "", nb::arg("materials") = nb::none(), nb::arg("default_light") = nb::none(),
            nb::arg("up_axis") = nb::none(),
            "Opens a scene by its name, see scenes(), or a file: .obj, .gltf, .glb, Mitsuba .xml or a scene's "
            ".json.\n\n"
            "parameters: values of its knobs, or of the $names of a Mitsuba scene. camera: name or number of one "
            "that the file lists.\nmaterials: file of values that replace the scene's. Warnings of the loader "
            "are warnings of Python.")
        .def_static("from_arrays", &scene_from_arrays, nb::arg("vertices"), nb::arg("triangles"), nb::kw_only(),
                    nb::arg("materials"), nb::arg("material_of") = nb::none(), nb::arg("camera") = nb::dict(),
                    nb::arg("environment") = nb::dict(),
                    "A scene of triangles. vertices: (n, 3). triangles: (m, 3), numbers of vertices, "
                    "counter-clockwise from the front.\n\n"
                    "materials: name -> values as in scene files, such as {'lamp': {'emission': [9, 9, 9]}, "
                    "'wall': {'albedo': [.5, .5, .5]}}.\nmaterial_of: (m,), the material of each triangle, in "
                    "the order of the dictionary; all have the first one by default.\ncamera: 'eye', 'target', "
                    "'up', 'fov_deg', ...; by default it frames the scene. environment: 'radiance', 'sky', ...")
        .def_ro("name", &BoundScene::name)
        .def_prop_ro(
            "camera", [](const BoundScene& scene) { return from_json(camera_json(scene.description->camera)); },
            "A dict with 'eye', 'target', 'up' and 'fov_deg'.")
        .def_prop_ro(
            "parameters", [](const BoundScene& scene) { return parameter_dict(*scene.description); },
            "Values of the knobs of the scene.")
        .def_prop_ro(
            "materials", [](const BoundScene& scene) { return material_dict(*scene.description); },
            "Name -> values, as in scene files.")
        .def_prop_ro(
            "vertices",
            [](const BoundScene& scene) {
                return copy_array<float>(scene.description->positions, {scene.description->positions.size(), 3});
            },
            nb::rv_policy::reference, "(n, 3) float32")
        .def_prop_ro(
            "triangles", [](const BoundScene& scene) { return triangle_array(*scene.description); },
            nb::rv_policy::reference, "Numbers of vertices, (m, 3) uint32; instanced meshes are there once.")
        .def("__repr__", &words_of);
}

}  // namespace pl
