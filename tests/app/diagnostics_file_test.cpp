// `trace --diagnostics` from a shell: the picture and the counts of invalid samples, lost paths and lookup misses.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/diagnose/diagnostics.h"
#include "core/io/image.h"
#include "core/kernel/film/frame_pixel.h"
#include "tests/support/program/outcome.h"

namespace pl::test {
namespace {

using nlohmann::json;

/// A closed room, so bright that the sum of the light of two walls is not finite.
std::string write_bright_room(const TempDir& folder) {
    write_all(folder / "room.mtl", "newmtl wall\nKd 0.9 0.9 0.9\nKe 2.5e38 2.5e38 2.5e38\n");
    write_all(folder / "room.obj",
              "mtllib room.mtl\nv -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
              "usemtl wall\nf 1 2 3 4\nf 8 7 6 5\nf 1 5 6 2\nf 4 3 7 8\nf 1 4 8 5\nf 2 6 7 3\n");
    return folder / "room.obj";
}

/// Members of the event.
json diagnostics_of(const std::string& scene, const std::string& picture, const Arguments& more) {
    const ProgramResult result = run_program(
        joined({"trace", scene, "--size", "20x12", "--backend", "cpu", "--diagnostics", picture, "--json"}, more));
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    for (const std::string& line : lines_of(result.out))
        if (json event = json::parse(line); event["event"] == "diagnostics") return event;
    return {};
}

const Arguments kInside{"--eye", "0,0,0.5", "--target", "0,0,-1", "--max-depth", "2", "--roulette", "albedo"};

}  // namespace

TEST_CASE("diagnostics: invalid samples are counted where they are, in numbers and in pictures") {
    const TempDir folder;
    const std::string scene = write_bright_room(folder);
    for (const char* method : {"default", "precomputed", "reinforcement"}) {
        Arguments more = kInside;
        more.insert(more.end(), {"--method", method, "--spp", "3", "--volumes", "20", "--bins", "16"});
        const json diagnostics = diagnostics_of(scene, folder / "t.exr", more);
        INFO(method << diagnostics.dump());
        const std::uint64_t invalid = diagnostics["invalid_samples"];
        CHECK(invalid > 100);
        const json& found = diagnostics["found"];
        CHECK(found["invalid_samples"]["count"] == invalid);
        CHECK(found["complete"] == true);
        double red = 0.0;
        const LinearImage counts = read_exr(folder / "t.exr");
        for (const glm::vec3 pixel : counts.pixels) red += static_cast<double>(pixel.x);
        CHECK(red == static_cast<double>(invalid));
        const json worst = found["invalid_samples"]["worst"][0];
        CHECK(worst[2] == 3);
        const auto index = worst[1].get<std::size_t>() * 20 + worst[0].get<std::size_t>();
        CHECK(counts.pixels[index].x == 3.0f);
    }
}

TEST_CASE("diagnostics: a PNG is dark but for the marks, and tells what they are") {
    const TempDir folder;
    Arguments more = kInside;
    more.insert(more.end(), {"--spp", "1"});
    const json diagnostics = diagnostics_of(write_bright_room(folder), folder / "t.png", more);
    ImageMetadata metadata;
    const ByteImage image = read_png8(folder / "t.png", &metadata);
    std::uint64_t marked = 0;
    for (std::size_t i = 0; i < image.rgb.size(); i += 3)
        marked += pack_pixel(image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]) ==
                  info_of(diagnose::DiagnosticKind::InvalidSample).color;
    CHECK(marked >= diagnostics["found"]["invalid_samples"]["pixels"]);
    CHECK(std::any_of(metadata.begin(), metadata.end(), [](const auto& entry) {
        return entry.first == "diagnostics" && entry.second.find(" invalid in ") != std::string::npos;
    }));
}

TEST_CASE(
    "diagnostics: misses are found, paths may leave an open scene, and clamped records are told by who learns") {
    const TempDir folder;
    const json misses = diagnostics_of(
        "cornell", folder / "t.pfm",
        {"--method", "precomputed", "--guiding", "always", "--volumes", "1", "--bins", "16", "--spp", "2"});
    CHECK(misses["lookup_misses"] > 100);
    CHECK(misses["found"]["lookup_misses"]["count"] == misses["lookup_misses"]);
    CHECK(misses["closed"] == false);
    CHECK(misses["escaped_paths"] == 0);
    CHECK(misses["clamped_records"] == 0);
    CHECK(misses["found"]["clamped_records"].is_null());
    const json learning = diagnostics_of("cornell", folder / "t.pfm", {"--method", "reinforcement", "--spp", "2"});
    CHECK(learning["clamped_records"] == 0);
    CHECK(learning["found"]["traced"] == 0);  // nothing was counted
    CHECK(learning["found"]["moving_tables"] == true);
}

TEST_CASE("diagnostics: statistics have what was counted without looking, too") {
    const TempDir folder;
    REQUIRE(run_program({"render", "furnace", "-o", folder / "a.pfm", "--size", "8x8", "--spp", "1", "--stats",
                         folder / "s.json"})
                .code == 0);
    const json diagnostics = json::parse(read_all(folder / "s.json"))["diagnostics"];
    CHECK(diagnostics["invalid_samples"] == 0);
    CHECK(diagnostics["lookup_misses"] == 0);
    CHECK_FALSE(diagnostics.contains("found"));
    CHECK(diagnostics["closed"].is_null());
}

TEST_CASE("2: diagnostics is looked for in paths, and written to pictures") {
    const TempDir folder;
    check_refused(2, {"trace", "cornell", "--pixel", "1,1", "--sample", "0", "--diagnostics", folder / "t.png"},
                  "whole picture");
    check_refused(2, {"trace", "cornell", "-o", folder / "a.png", "--diagnostics", folder / "t.png"},
                  "whole picture");
    check_refused(2, {"trace", "cornell", "--diagnostics", folder / "t.json"}, "t.json");
    check_refused(2, {"info", "cornell", "--diagnostics", folder / "t.png"}, "--diagnostics");
    check_refused(1, {"trace", "cornell", "--diagnostics", folder / "missing/t.png"}, "cannot be written");
    CHECK(folder.names().empty());
}

}  // namespace pl::test
