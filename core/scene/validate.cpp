#include "core/scene/validate.h"

#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/kernel/base/math.h"
#include "core/scene/blends.h"
#include "core/scene/instances.h"
#include "core/scene/punctual_lights.h"
#include "core/scene/surface_info.h"

namespace pl {

namespace {

bool is_light(const glm::vec3& v) { return is_finite(v) && v.x >= 0.0f && v.y >= 0.0f && v.z >= 0.0f; }

bool is_albedo(const glm::vec3& v) { return is_light(v) && v.x <= 1.0f && v.y <= 1.0f && v.z <= 1.0f; }

bool is_orthonormal(const glm::mat3& axes) {
    constexpr float kMostError = 1e-4f;
    const glm::mat3 error = glm::transpose(axes) * axes - glm::mat3(1.0f);
    bool is_small = true;
    for (int i = 0; i < 3; ++i)
        is_small = is_small && glm::all(glm::lessThanEqual(glm::abs(error[i]), glm::vec3(kMostError)));
    return is_small;
}

std::string show(const glm::vec3& v) { return fmt::format("({} {} {})", v.x, v.y, v.z); }

/// Errors of one kind: the text of the first, and their number.
class Complaint {
public:
    explicit Complaint(std::string& list) : list_(list) {}
    Complaint(const Complaint&) = delete;
    Complaint& operator=(const Complaint&) = delete;

    template <typename MakeText>
    void add(MakeText make_text) {
        if (count_++ == 0) {
            first_ = make_text();
        }
    }

    ~Complaint() {
        if (count_ == 1) {
            list_ += "\n  " + first_;
        } else if (count_ > 1) {
            list_ += fmt::format("\n  {} ({} such)", first_, count_);
        }
    }

private:
    std::string& list_;
    std::string first_;
    std::size_t count_ = 0;
};

void check_numbers(std::string& list, std::string_view what, const std::vector<glm::vec3>& values) {
    Complaint complaint(list);
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!is_finite(values[i])) {
            complaint.add([&] { return fmt::format("{} {} is not finite: {}", what, i, show(values[i])); });
        }
    }
}

void check_vertex_colors(std::string& list, const SceneDescription& scene) {
    if (!scene.vertex_colors.empty() && scene.vertex_colors.size() != scene.positions.size())
        list +=
            fmt::format("\n  there are {} colors of {} vertices", scene.vertex_colors.size(), scene.positions.size());
    Complaint color(list);
    for (std::size_t i = 0; i < scene.vertex_colors.size(); ++i)
        if (!is_albedo(scene.vertex_colors[i]))
            color.add([&] {
                return fmt::format("the color {} of vertex {} is not within [0, 1]", show(scene.vertex_colors[i]), i);
            });
}

void check_triangles(std::string& list, const SceneDescription& scene) {
    Complaint vertex(list);
    Complaint normal(list);
    Complaint uv(list);
    Complaint material(list);
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        const TriangleDescription& t = scene.triangles[i];
        const auto out_of_range = [i](const char* what, std::uint32_t index, std::size_t size) {
            return fmt::format("triangle {}: {} {} is out of range, there are {}", i, what, index, size);
        };
        for (int k = 0; k < 3; ++k) {
            if (t.vertex[k] >= scene.positions.size()) {
                vertex.add([&] { return out_of_range("vertex", t.vertex[k], scene.positions.size()); });
            }
            if (t.uv[k] != TriangleDescription::kNoUv && t.uv[k] >= scene.uvs.size()) {
                uv.add([&] { return out_of_range("texture point", t.uv[k], scene.uvs.size()); });
            }
            if (t.normal[k] != TriangleDescription::kNoNormal && t.normal[k] >= scene.normals.size()) {
                normal.add([&] { return out_of_range("normal", t.normal[k], scene.normals.size()); });
            }
        }
        if (t.material >= scene.materials.size()) {
            material.add([&] { return out_of_range("material", t.material, scene.materials.size()); });
        }
    }
}

bool within(float x, float low, float high) { return x >= low && x <= high; }

/// Whether a number, or each channel of a color, is finite and in the range of its parameter.
bool is_valid(const MaterialDescription& m, const MaterialParameter& parameter) {
    const glm::vec3 value = parameter.color != nullptr ? m.*parameter.color : glm::vec3(m.*parameter.number);
    return is_finite(value) && glm::all(glm::greaterThanEqual(value, glm::vec3(parameter.least))) &&
           glm::all(glm::lessThanEqual(value, glm::vec3(parameter.most)));
}

std::string fault_of(const MaterialDescription& m, const MaterialParameter& parameter) {
    const std::string value =
        parameter.color != nullptr ? show(m.*parameter.color) : fmt::format("{}", m.*parameter.number);
    std::string expected = "finite";
    if (std::isfinite(parameter.most))
        expected = fmt::format("within [{}, {}]", parameter.least, parameter.most);
    else if (std::isfinite(parameter.least))
        expected += fmt::format(" and at least {}", parameter.least);
    return fmt::format("material '{}': {} {} is not {}", m.name, parameter.words, value, expected);
}

void check_materials(std::string& list, std::span<const MaterialDescription> materials) {
    Complaint value(list);
    Complaint emission(list);
    for (const MaterialDescription& m : materials) {
        for (const MaterialParameter* parameter : kMaterialParameters)
            if (!is_valid(m, *parameter)) value.add([&] { return fault_of(m, *parameter); });
        if (!is_light(m.emission))
            emission.add([&] {
                return fmt::format("material '{}': emission {} is not finite and at least 0", m.name,
                                   show(m.emission));
            });
        if (!within(m.opacity, 0.0f, 1.0f))
            value.add(
                [&] { return fmt::format("material '{}': opacity {} is not within [0, 1]", m.name, m.opacity); });
    }
}

void check_textures(std::string& list, const std::vector<TextureDescription>& textures) {
    Complaint size(list);
    Complaint value(list);
    for (const TextureDescription& t : textures) {
        if (t.width == 0 || t.height == 0 || t.texels.size() != std::size_t{t.width} * t.height) {
            size.add([&] {
                return fmt::format("texture '{}': {}x{} with {} texels", t.source.string(), t.width, t.height,
                                   t.texels.size());
            });
        }
        for (const glm::vec4& texel : t.texels) {
            if (!is_light(glm::vec3(texel)) || !within(texel.w, 0.0f, 1.0f)) {
                value.add([&] { return fmt::format("texture '{}': a texel is no color", t.source.string()); });
            }
        }
    }
}

float brightest_of(const TextureDescription& texture) {
    float most = 0.0f;
    for (const glm::vec4& texel : texture.texels) {
        most = glm::max(most, glm::max(texel.x, glm::max(texel.y, texel.z)));
    }
    return most;
}

void check_texture_uses(std::string& list, std::span<const MaterialDescription> materials,
                        const std::vector<TextureDescription>& textures) {
    Complaint index(list);
    Complaint light(list);
    for (const MaterialDescription& m : materials) {
        const TextureUse& use = m.textures;
        for (const std::uint32_t texture :
             {use.albedo, use.roughness, use.emission, use.opacity, use.normal, use.blend}) {
            if (texture != kNoTexture && texture >= textures.size()) {
                index.add([&] { return fmt::format("material '{}': there is no texture {}", m.name, texture); });
            }
        }
        if (use.emission < textures.size() && !is_finite(m.emission * brightest_of(textures[use.emission]))) {
            light.add([&] { return fmt::format("material '{}': emission times its texture is not finite", m.name); });
        }
    }
}

/// Blends with a material that exists, in no circle, without solid glass, whose inside paths could leave as another material.
void check_blends(std::string& list, std::span<const MaterialDescription> materials) {
    Complaint share(list);
    Complaint other(list);
    for (const MaterialDescription& m : materials) {
        if (!m.blend.is_any()) continue;
        if (!within(m.blend.share, 0.0f, 1.0f))
            share.add([&] {
                return fmt::format("material '{}': the share {} of a blend is not within [0, 1]", m.name,
                                   m.blend.share);
            });
        const std::string error = error_of_blend(materials, m);
        if (!error.empty()) other.add([&] { return fmt::format("material '{}': {}", m.name, error); });
    }
}

void check_far_lights(std::string& list, const SceneDescription& scene) {
    const EnvironmentMapDescription& map = scene.environment_map;
    if (map.texels.size() != std::size_t{map.width} * map.height) {
        list += fmt::format("\n  environment map: {}x{} with {} texels", map.width, map.height, map.texels.size());
    }
    Complaint value(list);
    for (const glm::vec3& texel : map.texels) {
        if (!is_light(texel)) {
            value.add([&] {
                return fmt::format("environment map: radiance {} is not finite and at least 0", show(texel));
            });
        }
    }
    if (!std::isfinite(map.rotation_deg)) {
        list += "\n  environment map: the rotation is not finite";
    }
    if (!is_orthonormal(map.axes)) {
        list += fmt::format("\n  environment map: axes {}, {}, {} are not orthonormal", show(map.axes[0]),
                            show(map.axes[1]), show(map.axes[2]));
    }
    const SunDescription& sun = scene.sun;
    const float length = glm::length(sun.direction);
    if (!is_light(sun.radiance)) {
        list += fmt::format("\n  sun: radiance {} is not finite and at least 0", show(sun.radiance));
    }
    if (!std::isfinite(length) || !(length > 0.0f)) {
        list += fmt::format("\n  sun: {} is no direction", show(sun.direction));
    }
    if (!within(sun.angle_deg, kLeastSunAngle, kMostSunAngle)) {
        list += fmt::format("\n  sun: angle {} is not within [{}, {}] degrees", sun.angle_deg, kLeastSunAngle,
                            kMostSunAngle);
    }
}

void check_camera(std::string& list, const CameraDescription& camera) {
    if (!is_finite(camera.eye) || !is_finite(camera.target) || !is_finite(camera.up)) {
        list += "\n  camera: eye, target and up must be finite";
    } else if (camera.eye == camera.target) {
        list += fmt::format("\n  camera: eye and target are the same point {}", show(camera.eye));
    }
    if (!(camera.fov_deg > 0.0f && camera.fov_deg < 180.0f)) {
        list += fmt::format("\n  camera: field of view {} is not within (0, 180) degrees", camera.fov_deg);
    }
    if (!(std::isfinite(camera.aperture_radius) && camera.aperture_radius >= 0.0f)) {
        list += fmt::format("\n  camera: aperture radius {} is not finite and at least 0", camera.aperture_radius);
    }
    if (!std::isfinite(camera.shift.x) || !std::isfinite(camera.shift.y)) list += "\n  camera: shift must be finite";
    if (!(std::isfinite(camera.focus_distance) && camera.focus_distance > 0.0f)) {
        list += fmt::format("\n  camera: focus distance {} is not finite and above 0", camera.focus_distance);
    }
}

}  // namespace

void validate_scene(const SceneDescription& scene) {
    std::string list;
    if (scene.triangles.empty()) {
        list += "\n  there are no triangles";
    }
    check_numbers(list, "vertex", scene.positions);
    check_numbers(list, "normal", scene.normals);
    check_vertex_colors(list, scene);
    check_triangles(list, scene);
    list += complaints_about_instances(scene);
    check_materials(list, scene.materials);
    check_textures(list, scene.textures);
    check_texture_uses(list, scene.materials, scene.textures);
    check_blends(list, scene.materials);
    check_far_lights(list, scene);
    list += complaints_about(scene.punctual_lights);
    check_camera(list, scene.camera);
    if (!is_light(scene.environment)) {
        list += fmt::format("\n  environment radiance {} is not finite and at least 0", show(scene.environment));
    }
    if (!list.empty()) {
        throw Error(ErrorKind::Input, fmt::format("{}: the scene is not valid:{}", scene.source.string(), list));
    }
}

void validate_material(const MaterialDescription& material, std::uint32_t index, const SceneDescription& scene) {
    std::string list;
    check_materials(list, {&material, 1});
    check_texture_uses(list, {&material, 1}, scene.textures);
    std::vector<MaterialDescription> materials = scene.materials;
    materials[index] = material;
    check_blends(list, materials);
    if (material.emission != glm::vec3(0.0f) && is_of_mesh(scene, index))
        list += fmt::format("\n  material '{}': expected no emission, since instances show it", material.name);
    if (!list.empty()) {
        throw Error(ErrorKind::Input, fmt::format("the material is not valid:{}", list));
    }
}

glm::vec3 usable_up(const CameraDescription& camera) {
    // In double: floats would overflow in the squares of large coordinates.
    const glm::dvec3 forward = glm::normalize(glm::dvec3(camera.target) - glm::dvec3(camera.eye));
    const glm::dvec3 up(camera.up);
    const double length = glm::length(up);
    // Below this sine of their angle, rounding errors of floats would decide the roll of the camera.
    constexpr double kSmallestSine = 1e-5;
    if (length > 0.0 && glm::length(glm::cross(forward, up / length)) > kSmallestSine) {
        return camera.up;
    }
    const glm::dvec3 size = glm::abs(forward);
    if (size.y <= size.x && size.y <= size.z) {
        return {0.0f, 1.0f, 0.0f};
    }
    // Vertical view: the top of the picture is towards -z.
    return size.z <= size.x ? glm::vec3(0.0f, 0.0f, -1.0f) : glm::vec3(1.0f, 0.0f, 0.0f);
}

}  // namespace pl
