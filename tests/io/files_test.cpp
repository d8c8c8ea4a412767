// Whole files: written completely or not at all.
#include "core/io/files.h"

#include <csignal>
#include <thread>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/catch.hpp"
#include "tests/io/input_error.h"
#include "tests/io/temporary_folder.h"

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
    write_text_file_atomic(path, "");
    CHECK(read_file(path).empty());
    CHECK(folder.file_count() == 1);
}

TEST_CASE("A byte order mark is no part of a text") {
    const TemporaryFolder folder;
    CHECK(read_text_file(folder.write("a", "\xEF\xBB\xBFtext")) == "text");
    CHECK(read_text_file(folder.write("b", "\xEF\xBB")) == "\xEF\xBB");
}

TEST_CASE("What cannot be written is told with the path and leaves nothing behind") {
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
