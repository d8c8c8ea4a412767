#include "core/io/mitsuba/mitsuba.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include "core/base/error.h"
#include "core/io/line_reader.h"
#include "core/io/mitsuba/instances.h"
#include "core/io/mitsuba/lights.h"
#include "core/io/mitsuba/medium.h"
#include "core/io/mitsuba/sensor.h"
#include "core/io/mitsuba/shapes.h"
#include "core/io/mitsuba/sky.h"
#include "core/io/mitsuba/surfaces.h"
#include "core/io/texture_file.h"
#include "core/scene/up_axis.h"

namespace pl {
namespace {

/// Builds the scene from the objects of the file.
class MitsubaLoader {
public:
    MitsubaLoader(const std::filesystem::path& path, std::uint64_t most_copied_triangles)
        : file_(path), instances_(most_copied_triangles), round_shapes_(count_round_shapes(file_)) {
        scene_.source = path;
    }

    SceneDescription run() {
        for (const MitsubaObject& object : file_.objects()) {
            const std::string element = object.element();
            if (element == "shape")
                read_shape(object);
            else if (element == "emitter" || element == "light")
                read_far_light(object);
            else if (element == "sensor" || element == "camera")
                read_sensor(object);
        }
        instances_.move_to(scene_);
        if (scene_.triangles.empty()) {
            throw Error(ErrorKind::Input,
                        fmt::format("{}: expected a shape with an area, got none", scene_.source.string()));
        }
        place_images();
        file_.notes().tell(scene_.warnings);
        const std::vector<std::filesystem::path>& own = file_.files();
        scene_.files.insert(scene_.files.begin(), own.begin(), own.end());
        return std::move(scene_);
    }

private:
    void read_shape(const MitsubaObject& shape) {
        if (shape.type() == "shapegroup") return;  // read by its first instance
        if (shape.type() == "instance") {
            read_instance(shape);
            return;
        }
        add_mitsuba_shape(shape, material_of(shape), round_shapes_, scene_);
    }

    void read_instance(const MitsubaObject& instance) {
        MitsubaObject group;
        for (const MitsubaObject& child : instance.children()) {
            const MitsubaObject target = mitsuba_target(file_, child);
            if (target.type() == "shapegroup") group = target;
        }
        if (!group) instance.fail("expected the shapegroup of this instance, got none");
        instances_.add(instance, shapes_of(group), scene_);
    }

    /// The triangles of a group where it is described, with materials of the scene.
    const MitsubaGroup& shapes_of(const MitsubaObject& group) {
        const auto number = static_cast<std::uint32_t>(groups_.size());
        const auto [known, is_new] = groups_.try_emplace(group.identity(), MitsubaGroup{.number = number});
        if (!is_new) return known->second;
        SceneDescription& part = known->second.shapes;
        part.source = scene_.source;
        for (const MitsubaObject& child : group.children()) {
            const MitsubaObject shape = mitsuba_target(file_, child);
            if (shape.element() == "shape") add_mitsuba_shape(shape, material_of(shape), round_shapes_, part);
        }
        const auto take = [](auto& from, auto& to) {
            to.insert(to.end(), from.begin(), from.end());
            from.clear();
        };
        take(part.warnings, scene_.warnings);
        take(part.files, scene_.files);
        known->second.name = group.attribute("id");
        known->second.outline = outline_of(part, scene_.materials);
        return known->second;
    }

    /// The scene's material of a shape: one for each surface, inside and radiance.
    ShapeMaterial material_of(const MitsubaObject& shape) {
        MitsubaObject surface;
        Emission emission;
        for (const MitsubaObject& child : shape.children()) {
            const MitsubaObject target = mitsuba_target(file_, child);
            if (target.element() == "bsdf")
                surface = target;
            else if (target.element() == "emitter" || target.element() == "light")
                emission = emission_of(target);
        }
        const MitsubaObject inside = mitsuba_target(file_, shape.property("interior"));
        if (shape.property("exterior")) shape.note("media outside of shapes are left out");
        const auto key = std::make_tuple(surface.identity(), inside.identity(), emission.image.identity(),
                                         emission.radiance.x, emission.radiance.y, emission.radiance.z);
        const auto [known, is_new] = materials_.try_emplace(key);
        if (is_new) known->second = add_material(surface, inside, emission);
        return known->second;
    }

    /// Radiance of a shape, which an image may multiply.
    struct Emission {
        glm::vec3 radiance{0.0f};
        MitsubaObject image{};
    };

    Emission emission_of(const MitsubaObject& emitter) {
        if (emitter.type() != "area") {
            emitter.note(fmt::format("emitters of the type {} are left out", in_quotes(emitter.type())));
            return {};
        }
        const MitsubaObject texture = mitsuba_target(file_, emitter.property("radiance"));
        if (texture.element() == "texture") return {.radiance = glm::vec3(1.0f), .image = texture};
        return {.radiance = emitter.color("radiance").value_or(glm::vec3(1.0f))};
    }

    ShapeMaterial add_material(const MitsubaObject& surface, const MitsubaObject& inside, const Emission& emission) {
        MitsubaSurface read;
        read.material.albedo = glm::vec3(emission.radiance == glm::vec3(0.0f) ? 0.5f : 0.0f);
        if (surface) read = mitsuba_surface(file_, surface, scene_);
        MaterialDescription& material = read.material;
        material.emission = emission.radiance;
        if (emission.image) {
            const auto image = mitsuba_image(emission.image, TextureContent::Color, scene_);
            if (!image) emission.image.note("textures of radiance other than images are shown as 1");
            material.textures.emission = image.value_or(kNoTexture);
            if (!read.image) read.image = emission.image;
        }
        if (emission.radiance != glm::vec3(0.0f) && material.may_have_holes())
            surface.note("the light of shapes with a mask is masked, too");
        if (inside) set_inside(inside, material);
        const std::string id = surface ? surface.attribute("id") : "";
        material.name = id.empty() ? fmt::format("material {}", scene_.materials.size()) : id;
        if (std::any_of(scene_.materials.begin(), scene_.materials.end(),
                        [&](const MaterialDescription& other) { return other.name == material.name; }))
            material.name += fmt::format(" ({})", scene_.materials.size());
        const auto first = static_cast<std::uint32_t>(scene_.materials.size());
        scene_.materials.push_back(material);
        surfaces_.push_back(read);
        add_parts(first, read.others);
        return {first, read.shows_vertex_colors, emission.radiance != glm::vec3(0.0f)};
    }

    /// The materials that the last one blends with.
    void add_parts(std::uint32_t first, const std::vector<MaterialDescription>& others) {
        for (const MaterialDescription& other : others) {
            const auto number = static_cast<std::uint32_t>(scene_.materials.size());
            scene_.materials.back().blend.other = number;
            scene_.materials.push_back(other);
            scene_.materials.back().name =
                fmt::format("{} (part {})", scene_.materials[first].name, number - first + 1);
            surfaces_.emplace_back();
        }
    }

    /// Transformations of images, and reliefs, by the triangles that they are on.
    void place_images() {
        for (std::uint32_t material = 0; material < surfaces_.size(); ++material) {
            const MitsubaSurface& surface = surfaces_[material];
            const glm::dmat4 to_uv = surface.image ? mitsuba_to_uv(surface.image) : glm::dmat4(1.0);
            if (to_uv != glm::dmat4(1.0)) transform_uvs(scene_, material, to_uv);
            if ((to_uv[0].y != 0.0 || to_uv[1].x != 0.0) && scene_.materials[material].is_anisotropic())
                surface.image.note("images that are turned turn the direction of anisotropy, too");
            if (surface.relief) add_mitsuba_relief(scene_, material, *surface.relief);
        }
    }

    /// The medium inside of a shape.
    static void set_inside(const MitsubaObject& medium, MaterialDescription& material) {
        if (medium.element() == "medium" && material.kind == SurfaceKind::Dielectric)
            material.absorption = mitsuba_absorption(medium);
        else
            medium.note("media inside of other surfaces than glass are left out");
    }

    void read_far_light(const MitsubaObject& emitter) {
        const std::string type = emitter.type();
        const float scale = emitter.number("scale").value_or(1.0f);
        if (type == "constant")
            scene_.environment = emitter.color("radiance").value_or(glm::vec3(1.0f));
        else if (type == "envmap" && scale >= 0.0f)
            read_map(emitter, scale);
        else if (!add_mitsuba_light(emitter, scene_) && !add_mitsuba_sky(emitter, scene_))
            emitter.note(fmt::format("emitters of the type {} are left out", in_quotes(type)));
    }

    /// Its first column is towards -z, its middle one towards +z, seen from inside. [Mitsuba 3, envmap]
    void read_map(const MitsubaObject& emitter, float scale) {
        const glm::dvec3 forward(emitter.transform("to_world")[2]);
        if (std::abs(forward.y) > 1e-3) emitter.note("environment maps that are tilted stand upright");
        const double yaw = std::atan2(forward.x, forward.z) * 180.0 / glm::pi<double>();
        scene_.environment_map =
            read_environment_map(emitter.file("filename"), scale, static_cast<float>(180.0 + yaw), scene_.warnings);
    }

    void read_sensor(const MitsubaObject& sensor) {
        const std::string type = sensor.type();
        if ((type != "perspective" && type != "thinlens") || !scene_.cameras.empty()) {
            sensor.note(scene_.cameras.empty() ? fmt::format("sensors of the type {} are left out", in_quotes(type))
                                               : "sensors after the first one are left out");
            return;
        }
        const MitsubaView view = mitsuba_view(sensor);
        scene_.settings.emplace_back("size", fmt::format("{:.0f}x{:.0f}", view.width, view.height));
        scene_.cameras.push_back({.name = sensor.attribute("id"), .camera = view.camera});
        scene_.camera = scene_.cameras.front().camera;
        scene_.chosen_camera = 1;
        scene_.up = nearest_axis(scene_.camera.up);
    }

    MitsubaFile file_;
    SceneDescription scene_;
    std::map<std::tuple<const void*, const void*, const void*, float, float, float>, ShapeMaterial> materials_;
    std::map<const void*, MitsubaGroup> groups_;
    MitsubaInstances instances_;
    RoundShapes round_shapes_;
    std::vector<MitsubaSurface> surfaces_;  ///< [material]
};

}  // namespace

SceneDescription load_mitsuba(const std::filesystem::path& path, std::uint64_t most_copied_triangles) {
    return MitsubaLoader(path, most_copied_triangles).run();
}

}  // namespace pl
