#include "ui/draw/curve.h"

#include "tests/support/catch.hpp"

using namespace pl;
using namespace pl::ui;

TEST_CASE("Curve: the scale shows all points, passes by their logarithm") {
    const std::vector<PassPoint> points{{1.0, 3.0}, {10.0, 1.0}, {100.0, 0.5}};
    const PassScale scale = scale_of(points, 0.0);
    const Rect rect{10.0f, 20.0f, 200.0f, 110.0f};
    CHECK(scale.first == 1.0);
    CHECK(scale.last == 100.0);
    CHECK_THAT(scale.place(rect, 1.0, 0.0).x, WithinAbs(10.0f, 1.0e-3f));
    CHECK_THAT(scale.place(rect, 10.0, 0.0).x, WithinAbs(110.0f, 1.0e-3f));
    CHECK_THAT(scale.place(rect, 100.0, 0.0).x, WithinAbs(210.0f, 1.0e-3f));
    CHECK_THAT(scale.place(rect, 1.0, 0.0).y, WithinAbs(130.0f, 1.0e-3f));
    CHECK_THAT(scale.place(rect, 1.0, 3.0).y, WithinAbs(30.0f, 1.0e-3f));  // a tenth of room above
    // A divergence's interval may reach below 0: it ends at the frame.
    CHECK(scale.place(rect, 1.0, -0.2).y == 130.0f);
    CHECK(scale.place(rect, 1.0e6, 0.0).x == 210.0f);
}

TEST_CASE("Curve: a level is always shown, and a single point or none has a scale") {
    CHECK(scale_of({}, 0.0).top == 1.0);
    CHECK(scale_of({}, 0.0).last > scale_of({}, 0.0).first);
    const std::vector<PassPoint> one{{7.0, 0.25}};
    CHECK(scale_of(one, 1.0).top >= 1.0);
    CHECK(scale_of(one, 1.0).last > 7.0);
}
