// Coats of Mitsuba scenes over other surfaces.
#include "core/io/mitsuba/coats.h"

#include <fmt/format.h>

#include "core/kernel/shading/fresnel.h"
#include "tests/core/io/mitsuba/mitsuba_text.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr const char* kMirror = "<bsdf type=\"conductor\"><rgb name=\"eta\" value=\"0.143, 0.375, 1.442\"/>"
                                "<rgb name=\"k\" value=\"3.983, 2.386, 1.603\"/></bsdf>";
constexpr const char* kRed = "<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"0.6, 0.2, 0.1\"/></bsdf>";

std::string coated(const std::string& inside, const std::string& more = "", const std::string& type = "coating") {
    return "<bsdf type=\"" + type + "\"><float name=\"intIOR\" value=\"1.5\"/><float name=\"extIOR\" value=\"1\"/>" +
           more + inside + "</bsdf>";
}

/// Share of even light that a smooth coat of this index reflects.
double mean_fresnel(float eta) {
    double sum = 0.0;
    for (int i = 0; i < 1000; ++i) {
        const double cosine2 = (i + 0.5) / 1000.0;
        sum += static_cast<double>(fresnel_dielectric(static_cast<float>(std::sqrt(cosine2)), eta)) / 1000.0;
    }
    return sum;
}

glm::vec3 reflectance(const MaterialDescription& metal, float cosine) {
    return fresnel_conductor(cosine, metal.specular, edge_loss_of(metal.specular, metal.edge_tint));
}

}  // namespace

TEST_CASE("mitsuba coats: a diffuse surface becomes plastic without the light that its coat reflects from inside") {
    const SceneDescription scene = scene_with(coated(kRed));
    REQUIRE(scene.materials.size() == 1);
    CHECK_FALSE(is_told(scene, "coat"));
    const MaterialDescription& smooth = scene.materials[0];
    CHECK(smooth.kind == SurfaceKind::Plastic);
    CHECK(smooth.ior == 1.5f);
    CHECK(smooth.roughness == 0.0f);
    CHECK(smooth.specular == glm::vec3(1.0f));
    // The coat lets a (1 - F) (1 - F) / eta^2 through, and plastic divides by the mean of 1 - F.
    const double expected = 0.6 * (1.0 - mean_fresnel(1.5f)) / 2.25;
    CHECK(static_cast<double>(smooth.albedo.x) == Approx(expected).epsilon(0.01));
    CHECK(smooth.albedo.y == Approx(smooth.albedo.x / 3.0f));

    const std::string facets = "<string name=\"distribution\" value=\"ggx\"/><float name=\"alpha\" value=\"0.25\"/>";
    const MaterialDescription rough =
        surface(coated(kRed, facets + "<rgb name=\"specularReflectance\" value=\"0.5\"/>", "roughcoating"));
    CHECK(rough.kind == SurfaceKind::Plastic);
    CHECK(rough.roughness == 0.5f);
    CHECK(rough.specular == glm::vec3(0.5f));
    CHECK(rough.albedo == smooth.albedo);
    CHECK(surface("<bsdf type=\"coating\"><bsdf type=\"diffuse\"/></bsdf>").ior == Approx(1.5046f / 1.000277f));
}

TEST_CASE("mitsuba coats: a smooth metal reflects with its coat") {
    const SceneDescription scene = scene_with(coated(kMirror));
    CHECK_FALSE(is_told(scene, "coat"));
    const MaterialDescription& both = scene.materials.at(0);
    CHECK(both.kind == SurfaceKind::Conductor);
    CHECK(both.roughness == 0.0f);
    const MaterialDescription bare = surface(kMirror);
    for (const float cosine : {1.0f, 0.7f, 0.4f, kEdgeCosine}) {
        const float coat = fresnel_dielectric(cosine, 1.5f);
        const float inside = std::sqrt(1.0f - (1.0f - cosine * cosine) / 2.25f);
        const glm::vec3 expected = coat + (1.0f - coat) * (1.0f - coat) * reflectance(bare, inside);
        // The model is right at both ends.
        const float near = cosine == 1.0f || cosine == kEdgeCosine ? 1e-5f : 0.05f;
        for (int i = 0; i < 3; ++i) CHECK(std::abs(reflectance(both, cosine)[i] - expected[i]) < near);
    }
}

TEST_CASE("mitsuba coats: both surfaces of a blend have the coat, and adapters around it or inside are kept") {
    const SceneDescription blend =
        scene_with(coated("<bsdf type=\"blendbsdf\"><float name=\"weight\" value=\"0.25\"/>" + std::string(kRed) +
                          kMirror + "</bsdf>"));
    REQUIRE(blend.materials.size() == 2);
    CHECK(blend.materials[0].kind == SurfaceKind::Plastic);
    CHECK(blend.materials[0].blend.share == 0.25f);
    CHECK(blend.materials[1].specular == surface(coated(kMirror)).specular);
    const auto masked = [](const std::string& inside) {
        return "<bsdf type=\"mask\"><float name=\"opacity\" value=\"0.5\"/>" + inside + "</bsdf>";
    };
    const SceneDescription outside = scene_with(masked(coated(kRed)));
    CHECK(outside.materials[0].kind == SurfaceKind::Plastic);
    CHECK(outside.materials[0].opacity == 0.5f);
    CHECK_FALSE(is_told(outside, "coat"));
    const SceneDescription inside = scene_with(coated(masked(kRed)));
    CHECK(inside.materials[0].opacity == 0.5f);
    CHECK(is_told(inside, "masks and reliefs under a coat are those of the coat, too"));
}

TEST_CASE("mitsuba coats: effects that are left out are told") {
    const std::string rough = "<bsdf type=\"roughconductor\"><string name=\"distribution\" value=\"ggx\"/></bsdf>";
    const std::string dull = "<string name=\"distribution\" value=\"ggx\"/>";
    const std::string left_out =
        "on other surfaces than diffuse ones, and smooth metals under a smooth coat, is left";
    const std::pair<std::string, std::string> cases[] = {{coated(rough), rough},
                                                         {coated(kMirror, dull, "roughcoating"), kMirror}};
    for (const auto& [with, without] : cases) {
        const SceneDescription scene = scene_with(with);
        CHECK(is_told(scene, left_out));
        CHECK(scene.materials.at(0) == surface(without));
    }
    CHECK(is_told(scene_with(coated(kRed, "<rgb name=\"sigmaA\" value=\"0.1, 0, 0\"/>")), "absorption of coats"));
    CHECK_FALSE(is_told(scene_with(coated(kRed, "<rgb name=\"sigmaA\" value=\"0\"/>")), "coat"));
    const SceneDescription twice = scene_with(coated(coated(kRed)));
    CHECK(is_told(twice, "coats under coats are left out"));
    CHECK(twice.materials.at(0).albedo == surface(coated(kRed)).albedo);
}
