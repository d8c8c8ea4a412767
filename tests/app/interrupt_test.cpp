// The first interruption requests the end of a run, the second one ends the program.
#include <csignal>

#include <sys/wait.h>
#include <unistd.h>

#include "app/interrupt.h"
#include "tests/support/catch.hpp"

namespace pl {
namespace {

/// Exit code of a child process that runs `body`.
template <class Body>
int in_child(Body body) {
    const pid_t child = fork();
    if (child == 0) {
        body();
        _exit(0);
    }
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

}  // namespace

TEST_CASE("the first interruption raises the flag, the second one ends the program with 130") {
    CHECK(in_child([] {
              const InterruptGuard guard;
              raise(SIGINT);
              _exit(guard.raised() ? 7 : 8);
          }) == 7);
    CHECK(in_child([] {
              const InterruptGuard guard;
              raise(SIGINT);
              raise(SIGINT);
          }) == 130);
    CHECK(in_child([] {
              { const InterruptGuard guard; }
              raise(SIGINT);
          }) == 128 + SIGINT);
    CHECK(in_child([] {
              std::signal(SIGINT, SIG_IGN);
              { const InterruptGuard guard; }
              raise(SIGINT);
              _exit(9);
          }) == 9);
    for (const int signal : {SIGTERM, SIGHUP})
        CHECK(in_child([&] {
                  const InterruptGuard guard;
                  raise(signal);
                  _exit(guard.raised() ? 7 : 8);
              }) == 7);
}

TEST_CASE("a program started by nohup outlives its terminal") {
    CHECK(in_child([] {
              std::signal(SIGHUP, SIG_IGN);
              const InterruptGuard guard;
              raise(SIGHUP);
              _exit(guard.raised() ? 7 : 8);
          }) == 8);
}

}  // namespace pl
