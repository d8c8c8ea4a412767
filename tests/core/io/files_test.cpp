// Whole files: written completely or not at all.
#include "core/io/files.h"

#include <atomic>
#include <csignal>
#include <thread>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/catch.hpp"
#include "tests/support/files/input_error.h"
#include "tests/support/files/temporary_folder.h"

using namespace pl;
using pl::test::contains;
using pl::test::error_message;
using pl::test::TemporaryFolder;

namespace fs = std::filesystem;

TEST_CASE("A written file has the bytes and no companion") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "a.txt";
    const std::string bytes("one\0two\r\n\xff", 10);
    write_file_atomic(path, bytes);
    CHECK(read_file(path) == bytes);
    write_file_atomic(path, "");
    CHECK(read_file(path).empty());
    CHECK(folder.file_count() == 1);
}

TEST_CASE("A byte order mark is no part of a text") {
    const TemporaryFolder folder;
    CHECK(read_text_file(folder.write("a", "\xEF\xBB\xBFtext")) == "text");
    CHECK(read_text_file(folder.write("b", "\xEF\xBB")) == "\xEF\xBB");
}

TEST_CASE("A file that cannot be written is told with its path and leaves nothing behind") {
    const TemporaryFolder folder;
    const auto message = [&](const fs::path& path) {
        return error_message(ErrorKind::Runtime, [&] { write_file_atomic(path, "new"); });
    };
    CHECK_THAT(message(folder.path() / "gone/a.txt"), contains("gone/a.txt: cannot be written: No such file"));
    fs::create_directories(folder.path() / "dir");
    CHECK_THAT(message(folder.path() / "dir"), contains("dir: cannot be written: it is a directory"));
    const fs::path below_file = folder.write("file", "old") / "a.txt";
    CHECK_THAT(message(below_file), contains("Not a directory"));
    CHECK_THAT(message(folder.path() / std::string(300, 'x')), contains("File name too long"));
    CHECK(folder.file_count() == 2);
    CHECK(read_file(folder.path() / "file") == "old");
}

TEST_CASE("A folder that may not be written to keeps its old file") {
    const TemporaryFolder folder;
    const fs::path path = folder.write("locked/a.txt", "old");
    fs::permissions(path.parent_path(), fs::perms::owner_read | fs::perms::owner_exec);
    if (::access(path.parent_path().c_str(), W_OK) == 0) {
        return;  // the superuser may write everywhere
    }
    CHECK_THAT(error_message(ErrorKind::Runtime, [&] { write_file_atomic(path, "new"); }),
               contains("Permission denied"));
    fs::permissions(path.parent_path(), fs::perms::owner_all);
    CHECK(read_file(path) == "old");
    CHECK(folder.file_count() == 2);
}

TEST_CASE("A full disk leaves the old file and nothing else") {
    const TemporaryFolder folder;
    const fs::path path = folder.write("a.txt", "old");
    // A limit on the size of files fails in the same call as a full disk does.
    struct ::rlimit before {};
    REQUIRE(::getrlimit(RLIMIT_FSIZE, &before) == 0);
    const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
    const struct ::rlimit small { .rlim_cur = 100000, .rlim_max = before.rlim_max };
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &small) == 0);
    const std::string told =
        error_message(ErrorKind::Runtime, [&] { write_file_atomic(path, std::string(1 << 20, 'x')); });
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, old_handler);
    CHECK_THAT(told, contains("a.txt: cannot be written: File too large"));
    CHECK(read_file(path) == "old");
    CHECK(folder.file_count() == 1);
}

TEST_CASE("Links are followed and pipes are written to, not replaced") {
    const TemporaryFolder folder;
    const fs::path target = folder.write("real/a.txt", "old");
    fs::create_symlink("real/a.txt", folder.path() / "link");
    write_file_atomic(folder.path() / "link", "new");
    CHECK(fs::is_symlink(folder.path() / "link"));
    CHECK(read_file(target) == "new");

    const fs::path pipe = folder.path() / "pipe";
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    const int reader = ::open(pipe.c_str(), O_RDWR | O_NONBLOCK);
    write_file_atomic(pipe, "through");
    CHECK(fs::is_fifo(pipe));
    char arrived[16] = {};
    CHECK(::read(reader, arrived, sizeof(arrived)) == 7);
    CHECK(std::string(arrived) == "through");
    ::close(reader);
}

TEST_CASE("A reader sees one version or the other, never a part") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "a";
    const std::string first(300000, '1');
    const std::string second(200000, '2');
    write_file_atomic(path, first);
    std::thread writer([&] {
        for (int i = 0; i < 100; ++i) {
            write_file_atomic(path, i % 2 == 0 ? second : first);
        }
    });
    int torn = 0;
    for (int i = 0; i < 100; ++i) {
        const std::string seen = read_file(path);
        torn += seen == first || seen == second ? 0 : 1;
    }
    writer.join();
    CHECK(torn == 0);
    CHECK(folder.file_count() == 1);
}

namespace {

/// Another process that begins to write `target`, and finishes on request, unless it is killed before.
class OtherWriter {
public:
    explicit OtherWriter(const fs::path& target) {
        int ready[2], go_on[2];
        REQUIRE((::pipe(ready) == 0 && ::pipe(go_on) == 0));
        child_ = ::fork();
        REQUIRE(child_ >= 0);
        char byte = 0;
        if (child_ == 0) {
            TemporaryFile file(target);
            const bool told = ::write(ready[1], &byte, 1) == 1 && ::read(go_on[0], &byte, 1) == 1;
            ::_exit(told && file.replace_target("whole") == 0 ? 0 : 1);
        }
        REQUIRE(::read(ready[0], &byte, 1) == 1);
        ::close(ready[0]);
        ::close(ready[1]);
        ::close(go_on[0]);
        go_on_ = go_on[1];
    }
    ~OtherWriter() { ::close(go_on_); }
    OtherWriter(const OtherWriter&) = delete;
    OtherWriter& operator=(const OtherWriter&) = delete;

    void kill() const {
        ::kill(child_, SIGKILL);
        ::waitpid(child_, nullptr, 0);
    }
    bool finish() const {
        int status = 1;
        return ::write(go_on_, "", 1) == 1 && ::waitpid(child_, &status, 0) == child_ && status == 0;
    }

private:
    ::pid_t child_ = -1;
    int go_on_ = -1;
};

}  // namespace

TEST_CASE("Leftovers of a killed writer are removed by the next one, files of a living one are not", "[hard]") {
    const TemporaryFolder folder;
    const OtherWriter killed(folder.path() / "a");
    const OtherWriter living(folder.path() / "b");
    CHECK(folder.file_count() == 2);
    killed.kill();
    write_file_atomic(folder.path() / "c", "new");
    CHECK(folder.file_count() == 2);
    CHECK(living.finish());
    CHECK(read_file(folder.path() / "b") == "whole");
    CHECK(read_file(folder.path() / "c") == "new");
    CHECK(folder.file_count() == 2);
}

TEST_CASE("Only files that are named as leftovers are removed") {
    const TemporaryFolder folder;
    for (const char* name : {".pathlight-.tmp", ".pathlight-12-3.tmp.txt", ".pathlight-a-3.tmp", "pathlight-12-3.tmp",
                             ".pathlight-1.exr", ".pathlight-12-3.tmp"})
        folder.write(name, "x");
    fs::create_directories(folder.path() / ".pathlight-12-4.tmp");
    fs::create_symlink("pathlight-12-3.tmp", folder.path() / ".pathlight-12-5.tmp");
    remove_leftovers(folder.path());
    CHECK(folder.file_count() == 7);
    CHECK_FALSE(fs::exists(folder.path() / ".pathlight-12-3.tmp"));
    remove_leftovers(folder.path() / "gone");
}

// In a container a process may well have the number of the one that was killed before it.
TEST_CASE("A name that is taken by a leftover is passed over") {
    const TemporaryFolder folder;
    const auto only_name = [&] { return fs::directory_iterator(folder.path())->path().filename().string(); };
    std::string name;
    {
        const TemporaryFile file(folder.path() / "a");
        REQUIRE(file.error() == 0);
        name = only_name();
    }
    const std::size_t counter = name.rfind('-') + 1;
    const int used = std::stoi(name.substr(counter));
    for (int next = used + 1; next < used + 4; ++next)
        folder.write(name.substr(0, counter) + std::to_string(next) + ".tmp", "left");
    TemporaryFile file(folder.path() / "a");
    CHECK(file.replace_target("new") == 0);
    CHECK(read_file(folder.path() / "a") == "new");
    CHECK(folder.file_count() == 4);
}

TEST_CASE("Who removes leftovers at any moment removes no file of a writer") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "a";
    std::atomic<bool> done{false};
    std::thread cleaner([&] {
        while (!done) remove_leftovers(folder.path());
    });
    for (int i = 0; i < 2000; ++i) {
        TemporaryFile file(path);
        CHECK(file.replace_target(std::to_string(i)) == 0);
    }
    done = true;
    cleaner.join();
    CHECK(read_file(path) == "1999");
    CHECK(folder.file_count() == 1);
}
