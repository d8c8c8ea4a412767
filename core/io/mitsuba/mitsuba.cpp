#include "core/io/mitsuba/mitsuba.h"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include "core/base/error.h"
#include "core/io/line_reader.h"
#include "core/io/mitsuba/instances.h"
#include "core/io/mitsuba/lights.h"
#include "core/io/mitsuba/sensor.h"
#include "core/io/mitsuba/shapes.h"
#include "core/io/mitsuba/surfaces.h"
#include "core/io/texture_file.h"
#include "core/kernel/base/math.h"
#include "core/scene/far_origin.h"
#include "core/scene/up_axis.h"

namespace pl {

glm::vec3 mitsuba_absorption(const MitsubaObject& medium) {
    const glm::vec3 none(0.0f);
    const bool is_even = medium.type() == "homogeneous" && !medium.text("material");
    glm::vec3 absorbed = medium.color("sigma_a").value_or(none);
    glm::vec3 scattered = medium.color("sigma_s").value_or(none);
    if (!medium.property("sigma_a")) {
        const glm::vec3 all = medium.color("sigma_t").value_or(glm::vec3(1.0f));
        scattered = all * medium.color("albedo").value_or(glm::vec3(0.75f));
        absorbed = all - scattered;
    }
    if (!is_even || scattered != none) {
        medium.leave_out("media that scatter light, and those that vary, are left out");
        return none;
    }
    absorbed *= medium.number("scale").value_or(1.0f);
    if (!is_finite(absorbed) || !glm::all(glm::greaterThanEqual(absorbed, none)))
        medium.fail(
            fmt::format("expected an absorption of at least 0, got {} {} {}", absorbed.x, absorbed.y, absorbed.z));
    return absorbed;
}

namespace {

/// Builds the scene from the objects of the file.
class MitsubaLoader {
public:
    MitsubaLoader(const std::filesystem::path& path, const LoadSettings& asked, const glm::dvec3& origin)
        : file_(path, asked.parameters), instances_(asked.most_copied_triangles),
          round_shapes_(count_round_shapes(file_)) {
        scene_.source = path;
        scene_.origin = origin;
        tell_origin(scene_);
    }

    SceneDescription run() {
        for (const MitsubaObject& object : file_.objects()) {
            const std::string element = object.element();
            if (element == "shape")
                read_shape(object);
            else if (element == "emitter")
                read_far_light(object);
            else if (element == "sensor")
                read_sensor(object);
            else if (element == "integrator")
                read_integrator(object);
        }
        instances_.move_to(scene_);
        place_images();
        if (sensor_) note_clipped(sensor_, scene_);
        file_.note_unused();
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
        const MitsubaObject group = instance.part("shape");
        if (group.type() != "shapegroup") instance.fail("expected the shapegroup of this instance, got none");
        instances_.add(instance, shapes_of(group), scene_);
    }

    /// The triangles of a group where it is described, with materials of the scene.
    const MitsubaGroup& shapes_of(const MitsubaObject& group) {
        const auto number = static_cast<std::uint32_t>(groups_.size());
        const auto [known, is_new] = groups_.try_emplace(group.identity(), MitsubaGroup{.number = number});
        if (!is_new) return known->second;
        SceneDescription& part = known->second.shapes;
        part.source = scene_.source;
        for (const MitsubaObject& shape : group.parts("shape"))
            add_mitsuba_shape(shape, material_of(shape), round_shapes_, part);
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
        const MitsubaObject surface = shape.part("bsdf");
        const MitsubaObject emitter = shape.part("emitter");
        const Emission emission = emitter ? emission_of(emitter) : Emission{};
        const MitsubaObject inside = shape.property("interior");
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

    static Emission emission_of(const MitsubaObject& emitter) {
        if (emitter.type() != "area") {
            emitter.leave_out(fmt::format("emitters of the type {} are left out", in_quotes(emitter.type())));
            return {};
        }
        const MitsubaObject texture = emitter.property("radiance");
        if (texture.element() == "texture") return {.radiance = glm::vec3(1.0f), .image = texture};
        return {.radiance = emitter.color("radiance").value_or(glm::vec3(1.0f))};
    }

    ShapeMaterial add_material(const MitsubaObject& surface, const MitsubaObject& inside, const Emission& emission) {
        MitsubaSurface read;
        read.material.albedo = glm::vec3(emission.radiance == glm::vec3(0.0f) ? 0.5f : 0.0f);
        if (surface) read = mitsuba_surface(surface, scene_);
        MaterialDescription& material = read.material;
        material.emission = emission.radiance;
        if (emission.image) {
            const auto image = mitsuba_image(emission.image, TextureContent::Color, scene_);
            if (!image) emission.image.note("textures of radiance other than images are shown as 1");
            material.textures.emission = image.value_or(kNoTexture);
            if (!read.image) read.image = emission.image;
        }
        if (emission.radiance != glm::vec3(0.0f) && surface && surface.type() == "null") {
            material.opacity = 1.0f;
            surface.note("surfaces of the type 'null' of shapes that emit are black");
        }
        if (emission.radiance != glm::vec3(0.0f) && material.may_have_holes())
            surface.note("the light of shapes with a mask is masked, too");
        if (inside) set_inside(inside, read);
        const std::string id = surface ? surface.attribute("id") : "";
        material.name = id.empty() ? fmt::format("material {}", scene_.materials.size()) : id;
        if (std::any_of(scene_.materials.begin(), scene_.materials.end(),
                        [&](const MaterialDescription& other) { return other.name == material.name; }))
            material.name += fmt::format(" ({})", scene_.materials.size());
        const auto first = static_cast<std::uint32_t>(scene_.materials.size());
        scene_.materials.push_back(material);
        surfaces_.push_back(read);
        add_parts(first, read.others);
        return {first, read.shows_vertex_colors, emission.radiance != glm::vec3(0.0f), read.is_inside_out};
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
    static void set_inside(const MitsubaObject& medium, MitsubaSurface& surface) {
        if (medium.element() == "medium" && surface.material.kind == SurfaceKind::Dielectric &&
            !surface.is_inside_out)
            surface.material.absorption = mitsuba_absorption(medium);
        else
            medium.leave_out("media inside of other surfaces than glass are left out");
    }

    void read_far_light(const MitsubaObject& emitter) {
        const std::string type = emitter.type();
        if (type == "constant")
            scene_.environment = emitter.color("radiance").value_or(glm::vec3(1.0f));
        else if (type == "envmap")
            scene_.environment_map = mitsuba_map(emitter, scene_.warnings);
        else if (!add_mitsuba_light(emitter, scene_) && !add_mitsuba_sky(emitter, scene_))
            emitter.leave_out(fmt::format("emitters of the type {} are left out", in_quotes(type)));
    }

    /// Its depth becomes a preset. [Mitsuba 3, path]
    void read_integrator(const MitsubaObject& integrator) {
        const std::string type = integrator.type();
        if (const MitsubaObject inside = integrator.part("integrator")) {
            integrator.leave_out(
                fmt::format("integrators of the type {} are shown as the one inside", in_quotes(type)));
            read_integrator(inside);
            return;
        }
        constexpr std::array<std::string_view, 4> kOfPaths = {"path", "volpath", "volpathmis", "direct"};
        if (std::ranges::find(kOfPaths, type) == kOfPaths.end()) {
            integrator.leave_out(
                fmt::format("integrators of the type {} are left out: pictures are of paths", in_quotes(type)));
            return;
        }
        const float depth = integrator.number("max_depth").value_or(type == "direct" ? 2.0f : -1.0f);
        if (depth >= 0.0f)
            scene_.settings.emplace_back("max-depth", fmt::format("{:.0f}", std::clamp(depth, 1.0f, kMostDepth)));
        for (const char* rule : {"hide_emitters", "strict_normals"})
            if (integrator.boolean(rule).value_or(false))
                integrator.note(fmt::format("{} is left out", in_quotes(rule)));
    }

    void read_sensor(const MitsubaObject& sensor) {
        const std::string type = sensor.type();
        if ((type != "perspective" && type != "thinlens") || !scene_.cameras.empty()) {
            sensor.leave_out(scene_.cameras.empty()
                                 ? fmt::format("sensors of the type {} are left out", in_quotes(type))
                                 : "sensors after the first one are left out");
            return;
        }
        const MitsubaView view = mitsuba_view(sensor, scene_.origin);
        sensor_ = sensor;
        scene_.settings.emplace_back("size", fmt::format("{:.0f}x{:.0f}", view.width, view.height));
        scene_.cameras.push_back({.name = sensor.attribute("id"), .camera = view.camera});
        scene_.camera = scene_.cameras.front().camera;
        scene_.chosen_camera = 1;
        scene_.up = nearest_axis(scene_.camera.up);
    }

    static constexpr float kMostDepth = 65536.0f;  // of --max-depth

    MitsubaFile file_;
    SceneDescription scene_;
    std::map<std::tuple<const void*, const void*, const void*, float, float, float>, ShapeMaterial> materials_;
    std::map<const void*, MitsubaGroup> groups_;
    MitsubaInstances instances_;
    RoundShapes round_shapes_;
    MitsubaObject sensor_;
    std::vector<MitsubaSurface> surfaces_;  ///< [material]
};

}  // namespace

SceneDescription load_mitsuba(const std::filesystem::path& path, const LoadSettings& asked) {
    SceneDescription scene = MitsubaLoader(path, asked, glm::dvec3(0.0)).run();
    if (const glm::dvec3 origin = far_origin(scene); origin != glm::dvec3(0.0))
        scene = MitsubaLoader(path, asked, origin).run();
    if (scene.triangles.empty())
        throw Error(ErrorKind::Input, fmt::format("{}: expected a shape with an area, got none", path.string()));
    return scene;
}

}  // namespace pl
