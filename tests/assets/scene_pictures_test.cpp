// The pictures of the scenes that come with the program: small, of the scene as it is, and with its line.
#include "core/io/files.h"
#include "core/io/image.h"
#include "core/io/load_scene.h"
#include "core/measure/picture_identity.h"
#include "core/scene/scene_hash.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/assets.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr int kScenePictureSide = 128;

RenderSettings settings_of(const SceneDescription& scene) {
    RenderSettings settings;
    settings.width = kScenePictureSide;
    settings.height = kScenePictureSide;
    settings.camera = scene.camera;
    return settings;
}

}  // namespace

TEST_CASE("Every shipped scene has a small picture of what its files describe now") {
    for (const std::string& name : list_scenes(kAssets)) {
        CAPTURE(name);
        const std::filesystem::path file = kAssets / "scenes" / name / (name + ".png");
        REQUIRE(std::filesystem::exists(file));
        CHECK(std::filesystem::file_size(file) <= 15'000);
        ImageMetadata metadata;
        const ByteImage picture = read_png8(file, &metadata);
        CHECK(picture.width == kScenePictureSide);
        CHECK(picture.height == kScenePictureSide);
        SceneDescription scene = load_scene(name, kAssets);
        INFO("docs/make_pictures.py PROGRAM scenes makes it anew");
        CHECK(text_of(metadata, kPictureHashKey) == picture_hash(scene_hash(scene), settings_of(scene)));
        CHECK(text_of(metadata, "summary") == scene.summary);
        scene.materials[0].albedo.x *= 0.5f;
        CHECK(text_of(metadata, kPictureHashKey) != picture_hash(scene_hash(scene), settings_of(scene)));
    }
}

TEST_CASE("Every shipped scene tells in one line what it shows, as the list of scenes does") {
    const std::string list = read_file(kAssets / "scenes" / "README.md");
    for (const std::string& name : list_scenes(kAssets)) {
        CAPTURE(name);
        const std::string summary = load_scene(name, kAssets).summary;
        CHECK_FALSE(summary.empty());
        CHECK(list.find("| " + summary + " |") != std::string::npos);
    }
}
