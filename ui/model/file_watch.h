// Files that other programs change: looked at from time to time, by a thread of its own, so that a slow disk or network
// never keeps the window waiting.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace pl::ui {

/// Equal as long as nobody writes the file.
struct FileStamp {
    bool is_there = false;
    std::filesystem::file_time_type written{};
    std::uintmax_t bytes = 0;

    friend bool operator==(const FileStamp&, const FileStamp&) = default;
};
FileStamp stamp_of(const std::filesystem::path& file);

/// Distinguishes a complete change from one under way: editors write in several steps.
class ChangeDetector {
public:
    explicit ChangeDetector(std::vector<FileStamp> first) : settled_(std::move(first)), last_(settled_) {}

    /// The number of the first changed file, once after each change, as soon as two looks in a row see the same. Always
    /// as many stamps as at first.
    std::optional<std::size_t> look(const std::vector<FileStamp>& now);

private:
    std::vector<FileStamp> settled_;  ///< at first, or when a change was last reported
    std::vector<FileStamp> last_;
};

class FileWatch {
public:
    static constexpr std::chrono::milliseconds kInterval{400};

    FileWatch() = default;
    ~FileWatch();
    FileWatch(const FileWatch&) = delete;
    FileWatch& operator=(const FileWatch&) = delete;

    /// Changes of these files count from now on, and no others; nothing if these are watched already. Without files there
    /// is no thread.
    void watch(std::vector<std::filesystem::path> files);
    /// A file that has changed and come to rest; once for each change of any of them.
    std::optional<std::filesystem::path> take_change();

private:
    void run();

    std::mutex mutex_;
    std::condition_variable wake_;
    std::vector<std::filesystem::path> files_;
    std::uint64_t order_ = 0;  ///< number of calls of watch()
    std::optional<std::filesystem::path> changed_;
    bool quit_ = false;
    std::thread thread_;
};

}  // namespace pl::ui
