// `pathlight trace` from a shell: it prints the path of the rendered picture.
#include <nlohmann/json.hpp>

#include "core/io/image.h"
#include "tests/support/catch.hpp"
#include "tests/support/program/run_program.h"

namespace pl::test {
namespace {

using nlohmann::json;

const Arguments kTracedPicture{"--size", "48x40", "--volumes", "60", "--bins", "64"};

Arguments trace_of(const std::string& pixel, const std::string& sample, const Arguments& more) {
    return joined(joined({"trace", "cornell", "--pixel", pixel, "--sample", sample}, kTracedPicture), more);
}

json traced(const std::string& pixel, const std::string& sample, const Arguments& more) {
    const ProgramResult result = run_program(joined(trace_of(pixel, sample, more), {"--json"}));
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    const std::vector<std::string> lines = lines_of(result.out);
    REQUIRE(lines.size() == 1);
    return json::parse(lines.front());
}

}  // namespace

TEST_CASE("the contributions of a traced path add up to the pixel of a picture with that sample") {
    const TempDir folder;
    for (const std::string method : {"default", "reinforcement"})
        for (const std::string nee : {"off", "on"}) {
            CAPTURE(method, nee);
            const Arguments settings{"--method", method, "--nee", nee, "--seed", "7"};
            const std::string picture = folder / (method + nee + ".pfm");
            const ProgramResult rendered = run_program(
                joined(joined({"render", "cornell", "-o", picture, "--spp", "1"}, kTracedPicture), settings));
            CAPTURE(rendered.err);
            REQUIRE(rendered.code == 0);
            const LinearImage image = read_linear(picture);
            int lit = 0;
            // The last ones are in a later part of the first pass, guided by the parts before.
            for (const int pixel : {48 * 3 + 5, 48 * 20 + 24, 48 * 25 + 10, 48 * 30 + 40, 48 * 37 + 20}) {
                const json path =
                    traced(std::to_string(pixel % 48) + "," + std::to_string(pixel / 48), "0", settings);
                for (std::size_t channel = 0; channel < 3; ++channel) {
                    double sum = 0.0;
                    for (const json& vertex : path["vertices"]) sum += vertex["contribution"][channel].get<double>();
                    const float value = image.pixels[static_cast<std::size_t>(pixel)][static_cast<int>(channel)];
                    CHECK(path["radiance"][channel].get<float>() == value);
                    CHECK(sum == Approx(value).epsilon(1e-6));  // the path adds in float
                    lit += value > 0.0f ? 1 : 0;
                }
            }
            CHECK((lit > 0 || nee == "off"));
        }
}

TEST_CASE("a traced path begins under its pixel and knows why it ends") {
    const json path = traced("24,13", "0", {"--method", "default"});
    const json& first = path["vertices"][0];
    CHECK(first["throughput"] == json::array({1.0, 1.0, 1.0}));
    // The camera looks along +z at the back wall, z = 559.2.
    CHECK(first["surface"]["position"][2].get<double>() == Approx(559.2).epsilon(1e-6));
    CHECK(first["surface"]["geometric_normal"] == json::array({0.0, 0.0, -1.0}));
    CHECK(path["segments"] == path["vertices"].size());
    CHECK(path["end"].is_string());
    CHECK(path["vertices"].back()["scattered"].is_null());
    CHECK(path["guided"] == false);
    CHECK(first["surface"]["volume"].is_null());
}

TEST_CASE("a later sample of a method that learns is guided by volumes, the same for any number of threads") {
    const Arguments settings{"--method", "reinforcement", "--guiding", "always"};
    const json path = traced("24,8", "3", joined(settings, {"-t", "1"}));
    CHECK(traced("24,8", "3", joined(settings, {"-t", "2"})) == path);
    CHECK(path["guided"] == true);
    CHECK(path["vertices"][0]["surface"]["volume"].is_number());
    CHECK(path["vertices"][0]["surface"]["bsdf_fraction"].get<double>() < 1.0);
    CHECK(traced("24,8", "2", settings) != path);
}

TEST_CASE("of several samples each path is the same as alone, and the brightest comes first") {
    for (const std::string method : {"default", "reinforcement"}) {
        CAPTURE(method);
        const Arguments settings{"--method", method, "--nee", "on"};
        const ProgramResult result = run_program(joined(trace_of("24,20", "2-6", settings), {"--json"}));
        CAPTURE(result.err);
        REQUIRE(result.code == 0);
        const std::vector<std::string> lines = lines_of(result.out);
        REQUIRE(lines.size() == 5);
        double previous = 1.0e30;
        int samples = 0;
        for (const std::string& line : lines) {
            const json path = json::parse(line);
            CHECK(path == traced("24,20", std::to_string(path["sample"].get<int>()), settings));
            const json& radiance = path["radiance"];
            const double light = 0.2126 * radiance[0].get<double>() + 0.7152 * radiance[1].get<double>() +
                                 0.0722 * radiance[2].get<double>();
            CHECK(light <= previous * (1.0 + 1.0e-6));
            previous = light;
            samples |= 1 << path["sample"].get<int>();
        }
        CHECK(samples == 0b1111100);
    }
}

TEST_CASE("of several samples the text has a line each, the same at every run") {
    const ProgramResult result = run_program(trace_of("24,20", "0-3", {"--method", "default", "--nee", "on"}));
    REQUIRE(result.code == 0);
    const std::vector<std::string> lines = lines_of(result.out);
    REQUIRE(lines.size() == 4);
    for (const std::string& line : lines) {
        CHECK(line.rfind("sample ", 0) == 0);
        CHECK(line.find("; vertices ") != std::string::npos);
        CHECK(line.find("; end: ") != std::string::npos);
    }
    CHECK(run_program(trace_of("24,20", "0-3", {"--method", "default", "--nee", "on"})).out == result.out);
}

TEST_CASE("samples out of order are refused") {
    const ProgramResult result = run_program(trace_of("24,20", "5-2", {}));
    CHECK(result.code == 2);
    CHECK(result.err.find("--sample") != std::string::npos);
}

TEST_CASE("without JSON a path is text, and ends with its radiance") {
    const ProgramResult result = run_program(trace_of("24,8", "0", {"--method", "default"}));
    REQUIRE(result.code == 0);
    const std::vector<std::string> lines = lines_of(result.out);
    REQUIRE(lines.size() > 5);
    CHECK(lines.front() == "pixel 24,8, sample 0, seed 1, default");
    CHECK(lines.back().rfind("radiance ", 0) == 0);
    CHECK(result.out.find("\nvertex 0\n") != std::string::npos);
    CHECK(result.out.find("\n  end         ") != std::string::npos);
}

}  // namespace pl::test
