#include "ui/model/file_watch.h"

#include <algorithm>
#include <system_error>

namespace pl::ui {
namespace {

std::vector<FileStamp> stamps_of(const std::vector<std::filesystem::path>& files) {
    std::vector<FileStamp> stamps;
    stamps.reserve(files.size());
    for (const std::filesystem::path& file : files) stamps.push_back(stamp_of(file));
    return stamps;
}

}  // namespace

FileStamp stamp_of(const std::filesystem::path& file) {
    std::error_code error;
    FileStamp stamp{.is_there = true, .written = std::filesystem::last_write_time(file, error)};
    if (!error) stamp.bytes = std::filesystem::file_size(file, error);
    return error ? FileStamp{} : stamp;
}

std::optional<std::size_t> ChangeDetector::look(const std::vector<FileStamp>& now) {
    const bool is_at_rest = now == last_;
    last_ = now;
    if (!is_at_rest || now == settled_) return std::nullopt;
    const auto changed = std::ranges::mismatch(now, settled_).in1 - now.begin();
    settled_ = now;
    return static_cast<std::size_t>(changed);
}

FileWatch::~FileWatch() {
    {
        const std::lock_guard lock(mutex_);
        quit_ = true;
    }
    wake_.notify_all();
    if (thread_.joinable()) thread_.join();
}

void FileWatch::watch(std::vector<std::filesystem::path> files) {
    {
        const std::lock_guard lock(mutex_);
        if (files == files_) return;
        files_ = std::move(files);
        ++order_;
        changed_.reset();
    }
    if (!thread_.joinable()) thread_ = std::thread([this] { run(); });
    wake_.notify_all();
}

std::optional<std::filesystem::path> FileWatch::take_change() {
    const std::lock_guard lock(mutex_);
    return std::exchange(changed_, std::nullopt);
}

void FileWatch::run() {
    std::unique_lock lock(mutex_);
    while (!quit_) {
        const std::uint64_t order = order_;
        const std::vector<std::filesystem::path> files = files_;
        lock.unlock();
        ChangeDetector detector(stamps_of(files));
        lock.lock();
        const auto is_over = [&] { return quit_ || order_ != order; };
        while (!wake_.wait_for(lock, kInterval, is_over)) {
            lock.unlock();
            const std::optional<std::size_t> changed = detector.look(stamps_of(files));
            lock.lock();
            if (changed && !is_over()) changed_ = files[*changed];
        }
    }
}

}  // namespace pl::ui
