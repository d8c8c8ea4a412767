#include "tests/parity/random_case.h"

#include <set>

#include "tests/support/catch.hpp"

using namespace pl;
using namespace pl::parity;

TEST_CASE("A random case is decided by seed and number alone") {
    SceneShelf scenes({"cornell", "door"});
    const std::string fifth = random_case(scenes, 1, 5).label();
    for (std::uint32_t number = 0; number < 5; ++number) CHECK(random_case(scenes, 1, number).label() != fifth);
    SceneShelf others({"cornell", "door"});
    CHECK(random_case(others, 1, 5).label() == fifth);
    CHECK(random_case(scenes, 2, 5).label() != fifth);
}

TEST_CASE("Random cases cover scenes, methods, targets and light samples, in sizes of a second") {
    SceneShelf scenes({"cornell", "door"});
    std::set<std::string> names;
    std::set<MethodId> methods;
    std::set<LearningTarget> targets;
    std::set<Representation> representations;
    std::set<bool> light_samples;
    for (std::uint32_t number = 0; number < 100; ++number) {
        const BackendCase drawn = random_case(scenes, 3, number);
        const RenderSettings& settings = drawn.settings;
        names.insert(drawn.scene->name);
        methods.insert(settings.method);
        targets.insert(settings.field.learning.target);
        representations.insert(settings.field.representation);
        light_samples.insert(settings.next_event);
        CHECK((settings.width >= 1 && settings.width <= 96 && settings.height >= 1 && settings.height <= 96));
        CHECK((drawn.passes >= 1 && drawn.passes <= 12));
        CHECK(kEveryFeature.covers(settings.forced_effects));
        CHECK((settings.mixture.bsdf_fraction >= 0.1f && settings.mixture.bsdf_fraction <= 1.0f));
    }
    CHECK(names.size() == 2);
    CHECK(methods.size() == all_methods().size());
    CHECK(targets.size() == 3);
    CHECK(representations.size() == 2);
    CHECK(light_samples.size() == 2);
}
