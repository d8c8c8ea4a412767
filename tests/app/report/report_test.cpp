// `pathlight report` from a shell: one page that needs no other file, and plots beside it.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/io/image.h"
#include "tests/support/program/outcome.h"

namespace pl::test {
namespace {

using nlohmann::json;

std::string between(const std::string& text, const std::string& before, const std::string& after) {
    const std::size_t start = text.find(before);
    REQUIRE(start != std::string::npos);
    const std::size_t end = text.find(after, start + before.size());
    REQUIRE(end != std::string::npos);
    return text.substr(start + before.size(), end - start - before.size());
}

}  // namespace

TEST_CASE("a report is one page with plots, sentences, tables and pictures") {
    const TempDir folder;
    const Arguments bench{"bench",      "cornell",   "door",  "-o",
                          folder / "b", "--size",    "16x12", "--spp",
                          "8",          "--seeds",   "5",     "--backend",
                          "cpu",        "--volumes", "40",    "--reference-spp",
                          "16",         "--bins",    "16",    "--measure-share",
                          "1000000"};
    REQUIRE(run_program(bench).code == 0);
    const ProgramResult result = run_program({"report", folder / "b"});
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    for (const char* plot : {"cornell-time", "cornell-samples", "door-time", "door-samples"})
        CHECK_THAT(read_all(folder / ("b/" + std::string(plot) + ".svg")), contains("<polyline"));

    const std::string page = read_all(folder / "b/report.html");
    CHECK(page.starts_with("<!DOCTYPE html>"));
    // Nothing is fetched from anywhere.
    for (const char* part : {"src=\"", "href=", "@import", "url(", "https:"})
        CHECK(page.find(part) == std::string::npos);
    CHECK(page.find("http:") == page.find("http://www.w3.org/2000/svg"));
    for (const char* part : {"class=\"headline\"", "to the same error", "(95 %: ", "s to relMSE", "warm-up s",
                             "pathlight bench cornell door", "equal error", "intervals are rough"})
        CHECK_THAT(page, contains(part));

    const json scenes = json::parse(between(page, "id=\"pictures\">", "</script>"));
    REQUIRE(scenes.size() == 2);
    for (const json& scene : scenes) {
        CHECK(scene.at("reference").get<std::string>().starts_with("data:image/png;base64,iVBOR"));
        CHECK(scene.at("cells").size() == 3);
        for (const json& cell : scene.at("cells")) {
            REQUIRE(cell.at("points").size() == 4);
            double seconds = 0.0;
            for (const json& point : cell.at("points")) {
                CHECK(point.at("seconds").get<double>() > seconds);
                seconds = point.at("seconds");
                CHECK(point.at("picture").get<std::string>().starts_with("data:image/png;base64,iVBOR"));
            }
        }
    }

    // Without its pictures the page still has its numbers.
    std::filesystem::remove_all(folder / "b/pictures");
    CHECK(run_program({"report", folder / "b", "-q"}).out.empty());
    CHECK_THAT(read_all(folder / "b/report.html"), contains("class=\"headline\""));
}

TEST_CASE("a scene may have any name") {
    const TempDir folder;
    const std::string name = "=1+1,\"<!--<script>";
    write_all(folder / (name + ".obj"), "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n");
    const ProgramResult bench =
        run_program({"bench", folder / (name + ".obj"), "-o", folder / "b", "--size", "8x8", "--spp", "2", "--seeds",
                     "1", "--backend", "cpu", "--volumes", "4", "--bins", "4", "--reference-spp", "2"});
    CAPTURE(bench.err);
    REQUIRE(bench.code == 0);
    const std::string quoted = "\"'=1+1,\"\"<!--<script>\",";
    for (const char* file : {"b/series.csv", "b/summary.csv"}) {
        const std::vector<std::string> lines = lines_of(read_all(folder / file));
        REQUIRE(lines.size() > 1);
        const auto commas = std::ranges::count(lines[0], ',');
        for (std::size_t i = 1; i < lines.size(); ++i) {
            CHECK(lines[i].starts_with(quoted));
            CHECK(std::ranges::count(lines[i], ',') == commas + 1);  // one in the name
        }
    }
    REQUIRE(run_program({"report", folder / "b"}).code == 0);
    const std::string page = read_all(folder / "b/report.html");
    CHECK(page.find("<!--") == std::string::npos);
    CHECK(json::parse(between(page, "id=\"pictures\">", "</script>"))[0].at("scene") == name);
}

TEST_CASE("2 and 3: reports that are refused") {
    const TempDir folder;
    check_refused(2, {"report"}, "'report' needs one folder of 'bench', DIR: got 0");
    check_refused(2, {"report", folder / "a", folder / "b"}, "got 2");
    check_refused(3, {"report", folder / "none"}, "results.json");
    std::filesystem::create_directory(folder / "b");
    write_all(folder / "b/results.json", "{");
    check_refused(3, {"report", folder / "b"}, "results.json");
    write_all(folder / "b/results.json", "{\"schema\": \"pathlight.stats/1\"}");
    check_refused(3, {"report", folder / "b"}, "expected schema pathlight.bench/1, got pathlight.stats/1");
    write_all(folder / "b/results.json", "{\"schema\": \"pathlight.bench/1\"}");
    check_refused(3, {"report", folder / "b"}, "results.json");
    write_all(folder / "b/results.json", "[]");
    check_refused(3, {"report", folder / "b"}, "results.json");
}

}  // namespace pl::test
