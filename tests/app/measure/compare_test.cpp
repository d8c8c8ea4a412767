// `pathlight compare` from a shell: metrics, and the inputs it refuses to compare.
#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

#include "core/io/image.h"
#include "tests/support/program/outcome.h"

namespace pl::test {
namespace {

using nlohmann::json;

LinearImage plain(int width, int height, float value) {
    return {.width = width,
            .height = height,
            .pixels = std::vector<glm::vec3>(static_cast<std::size_t>(width * height), glm::vec3(value))};
}

/// Two pictures of 3 x 2 pixels that are 0.5 apart everywhere.
struct TwoPictures {
    TempDir folder;
    std::string picture = folder / "a.exr";
    std::string reference = folder / "b.pfm";

    TwoPictures() {
        write_exr(picture, plain(3, 2, 1.5f));
        write_pfm(reference, plain(3, 2, 1.0f));
    }
};

}  // namespace

TEST_CASE("compare tells all metrics, as text and as an event") {
    const TwoPictures files;
    const ProgramResult text = run_program({"compare", files.picture, files.reference});
    CAPTURE(text.err);
    CHECK(text.code == 0);
    for (const char* name :
         {"mse ", "rmse", "relmse ", "mse-trimmed", "relmse-trimmed", "mape", "smape", "bias", "psnr", "3x2", "0.25"})
        CHECK_THAT(text.out, contains(name));

    const ProgramResult result = run_program({"compare", files.picture, files.reference, "--json"});
    CHECK(result.code == 0);
    const json event = json::parse(result.out);
    CHECK(event.at("event") == "compare");
    CHECK(event.at("pixels") == 6);
    CHECK_THAT(event.at("mse").get<double>(), WithinRel(0.25, 1e-12));
    CHECK_THAT(event.at("relmse").get<double>(), WithinRel(0.25 / 1.01, 1e-12));
    CHECK_THAT(event.at("bias").get<double>(), WithinRel(0.5, 1e-6));
    CHECK_THAT(event.at("psnr_db").get<double>(), WithinRel(10.0 * std::log10(4.0), 1e-12));
    CHECK(event.at("epsilon") == 0.01);

    const json same = json::parse(run_program({"compare", files.reference, files.reference, "--json"}).out);
    CHECK(same.at("mse") == 0.0);
    CHECK(same.at("psnr_db").is_null());
}

TEST_CASE("compare tells FLIP if it is asked for") {
    const TwoPictures files;
    CHECK(run_program({"compare", files.picture, files.reference}).out.find("flip") == std::string::npos);
    write_exr(files.picture, plain(3, 2, 0.5f));
    const ProgramResult text = run_program({"compare", files.picture, files.reference, "--flip"});
    CHECK(text.code == 0);
    CHECK_THAT(text.out, contains("flip ") && contains("67 pixels per degree"));
    const json event = json::parse(
        run_program({"compare", files.picture, files.reference, "--flip", "--pixels-per-degree", "30", "--json"})
            .out);
    CHECK(event.at("pixels_per_degree") == 30.0);
    CHECK(event.at("flip").get<double>() > 0.1);
    CHECK(event.at("flip").get<double>() < 1.0);
    check_refused(2, {"compare", files.picture, files.reference, "--pixels-per-degree", "30"}, "expected --flip");
    check_refused(2, {"compare", files.picture, files.reference, "--flip", "--pixels-per-degree", "0"},
                  "--pixels-per-degree: expected");
}

TEST_CASE("5: compare misses a target error") {
    const TwoPictures files;
    CHECK(run_program({"compare", files.picture, files.reference, "--target-error", "0.3"}).code == 0);
    const ProgramResult missed = run_program({"compare", files.picture, files.reference, "--target-error", "0.2"});
    CHECK(missed.code == 5);
    CHECK_THAT(missed.err, contains("--target-error"));
    CHECK_THAT(missed.out, contains("relmse"));  // the metrics are printed in either case
}

TEST_CASE("2 and 3: what compare refuses") {
    const TwoPictures files;
    check_refused(2, {"compare"}, "needs two pictures, IMAGE REFERENCE: got 0");
    check_refused(2, {"compare", files.picture}, "got 1");
    check_refused(2, {"compare", files.picture, files.picture, files.picture}, "got 3");
    check_refused(2, {"compare", files.picture, files.reference, "--target-error", "0"}, "--target-error: expected");
    check_refused(3, {"compare", files.picture, files.folder / "none.exr"}, "none.exr");
    write_exr(files.folder / "large.exr", plain(2, 3, 1.0f));
    check_refused(3, {"compare", files.folder / "large.exr", files.reference}, "expected a size of 3x2");
    write_all(files.folder / "broken.exr", "no picture");
    check_refused(3, {"compare", files.picture, files.folder / "broken.exr"}, "broken.exr: expected an image");
    write_png8(files.folder / "shown.png", {.width = 1, .height = 1, .rgb = {1, 2, 3}});
    check_refused(3, {"compare", files.folder / "shown.png", files.reference}, "tone mapped");
    write_all(files.folder / "x.jpg", "\xff\xd8\xff");
    check_refused(3, {"compare", files.picture, files.folder / "x.jpg"},
                  "expected a linear picture (exr, pfm or hdr)");
}

TEST_CASE("3: pixels that are no numbers are counted and refused, wherever they are") {
    const TwoPictures files;
    LinearImage broken = plain(3, 2, 1.0f);
    broken.pixels[4].y = std::numeric_limits<float>::quiet_NaN();
    broken.pixels[5].x = std::numeric_limits<float>::infinity();
    write_exr(files.folder / "nan.exr", broken);
    const std::string told = "nan.exr: 2 of 6 pixels are NaN or infinite, the first at 1,1";
    check_refused(3, {"compare", files.folder / "nan.exr", files.reference}, told);
    check_refused(3, {"compare", files.picture, files.folder / "nan.exr"}, told);
}

TEST_CASE("pictures of different scenes are compared with a warning") {
    const TempDir folder;
    const auto render = [&](const std::string& file, const Arguments& more) {
        Arguments arguments{"render", "cornell", "-o", folder / file, "--size", "8x8", "--spp", "1"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        REQUIRE(run_program(arguments).code == 0);
    };
    render("a.exr", {});
    render("b.exr", {"--seed", "2", "--method", "reinforcement", "--nee", "on"});
    render("c.exr", {"--max-depth", "3"});
    CHECK(run_program({"compare", folder / "a.exr", folder / "b.exr"}).err.empty());
    CHECK_THAT(run_program({"compare", folder / "a.exr", folder / "c.exr"}).err, contains("different scenes"));
}

}  // namespace pl::test
