// Part of every test program: writes one small file per test with its seconds and the used share of its tolerances,
// in the folder `margins` of the build. tests/hard makes its table of them.
#if !__has_include(<catch2/catch_all.hpp>)
#define CATCH_CONFIG_EXTERNAL_INTERFACES
#endif
#include <algorithm>
#include <cctype>
#include <chrono>
#include <filesystem>
#include <fstream>

#include "tests/support/catch.hpp"
#include "tests/support/margin.h"

namespace pl::test {
namespace {

#if __has_include(<catch2/catch_all.hpp>)
using ListenerBase = Catch::EventListenerBase;
#else
using ListenerBase = Catch::TestEventListenerBase;
#endif

/// -1: the running test has noted none.
double largest_share = -1.0;

void note(double share) { largest_share = std::max(largest_share, share); }

/// Letters and digits of a name, so that it can be a file's.
std::string as_file_name(std::string name) {
    for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    return name;
}

class MarginListener : public ListenerBase {
public:
    using ListenerBase::ListenerBase;

    void testRunStarting(const Catch::TestRunInfo& run) override { program_ = std::string(run.name); }
    void testCaseStarting(const Catch::TestCaseInfo& test) override {
        test_ = std::string(test.name);
        largest_share = -1.0;
        on_used_share = note;
        start_ = std::chrono::steady_clock::now();
    }
    void testCaseEnded(const Catch::TestCaseStats& stats) override {
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start_;
        const std::filesystem::path folder = std::filesystem::path(PL_MARGIN_DIR) / program_;
        std::error_code ignored;
        std::filesystem::create_directories(folder, ignored);
        // Never a reason for a test to fail: where it cannot be written, the table keeps what it has.
        std::ofstream file(folder / as_file_name(test_));
        file << program_ << '.' << test_ << '\n'
             << seconds.count() << ' ' << largest_share << ' ' << stats.totals.assertions.passed << ' '
             << stats.totals.assertions.failed << '\n';
    }

private:
    std::string program_;
    std::string test_;
    std::chrono::steady_clock::time_point start_;
};

}  // namespace
}  // namespace pl::test

using pl::test::MarginListener;
CATCH_REGISTER_LISTENER(MarginListener)
