#include <atomic>
#include <stdexcept>

#include "tests/support/catch.hpp"
#include "tests/ui/fake_backend.h"
#include "ui/model/jobs.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Jobs: reports run on the calling thread, an exception becomes an error message") {
    Messages messages;
    Jobs jobs(messages);
    bool reported = false;
    jobs.push([&]() -> Jobs::Report { return [&] { reported = true; }; });
    jobs.push([]() -> Jobs::Report { throw std::runtime_error("the disk is full"); });
    REQUIRE(eventually([&] { return jobs.pending() == 0; }));
    CHECK_FALSE(reported);
    jobs.update();
    CHECK(reported);
    REQUIRE(messages.toasts().size() == 1);
    CHECK(messages.toasts()[0].level == MessageLevel::Error);
    CHECK(messages.toasts()[0].text == "the disk is full");
}

TEST_CASE("Jobs: all queued jobs run before the end") {
    Messages messages;
    std::atomic<int> done{0};
    Jobs jobs(messages);
    for (int i = 0; i < 5; ++i)
        jobs.push([&]() -> Jobs::Report {
            ++done;
            return {};
        });
    jobs.finish();
    CHECK(done == 5);
}
