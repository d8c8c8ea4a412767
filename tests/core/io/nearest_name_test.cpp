// Suggestions for misspelt words: only near ones.
#include "core/io/nearest_name.h"

#include "tests/support/catch.hpp"

namespace pl::test {

TEST_CASE("A misspelt word is near the one that was meant") {
    struct Pair {
        const char* name;
        const char* known;
    };
    for (const auto& [name, known] : {
             Pair{"defualt", "default"},
             {"DEFAULT", "default"},
             {"reinforcment", "reinforcement"},
             {"reinforce", "reinforcement"},
             {"pre-computed", "precomputed"},
             {"rendr", "render"},
             {"redner", "render"},
             {"ref", "reference"},
             {"cornel", "cornell"},
             {"cornelll", "cornell"},
             {"metod", "--method"},
             {"--metod", "--method"},
             {"-spp", "--spp"},
             {"--sppp", "--spp"},
             {"--jsn", "--json"},
             {"voroni", "voronoi"},
             {"Voronoi", "voronoi"},
             {"sdtree", "sd-tree"},
             {"CPU", "cpu"},
             {"Z", "z"},
             {"means", "mean"},
             {"feild", "field"},
         }) {
        CAPTURE(name, known);
        CHECK(is_near(name, known));
        CHECK(nearest_name(name, {"unlike", known}) == known);
    }
}

TEST_CASE("Another word is not near, however few words there are to choose from") {
    struct Pair {
        const char* name;
        const char* known;
    };
    for (const auto& [name, known] : {
             Pair{"gpu", "cpu"},
             {"rl", "default"},
             {"rl", "render"},
             {"pt", "spp"},
             {"man", "view"},
             {"filmic", "clamp"},
             {"path", "default"},
             {"bsdf", "default"},
             {"guided", "field"},
             {"on", "off"},
             {"w", "z"},
             {"re", "reference"},
             {"knob", "k"},
             {"voronoi-cells", "voronoi"},
             {"twice", "doubling"},
             {"", "spp"},
             {"--", "--spp"},
             {"spp", ""},
         }) {
        CAPTURE(name, known);
        CHECK_FALSE(is_near(name, known));
        CHECK(nearest_name(name, {known}).empty());
        CHECK(did_you_mean(name, {known}).empty());
    }
    CHECK_FALSE(is_near(std::string(1000000, 'a'), std::string(1000001, 'a')));
}

TEST_CASE("The nearest name is the first of equals, and is put into words") {
    CHECK(nearest_name("spot", {"spit", "spat"}) == "spit");
    CHECK(nearest_name("spots", {"spits", "spot"}) == "spits");
    CHECK(nearest_name("x", {}).empty());
    CHECK(did_you_mean("defualt", {"default"}) == ", did you mean 'default'?");
    CHECK(known_names("defualt", {"default", "other"}) == ", did you mean 'default'? Known are: default, other");
    CHECK(known_names("rl", {"default", "other"}) == ". Known are: default, other");
}

}  // namespace pl::test
