#include "ui/script/ui_trace.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/error.h"

namespace pl::ui {
namespace {

std::string statistics(const std::vector<double>& sample) {
    if (sample.empty()) return R"({"count":0})";
    return fmt::format(R"({{"count":{},"p50":{:.2f},"p95":{:.2f},"p99":{:.2f},"max":{:.2f}}})", sample.size(),
                       percentile(sample, 0.5), percentile(sample, 0.95), percentile(sample, 0.99),
                       *std::max_element(sample.begin(), sample.end()));
}

std::string line_of(const char* name, const std::vector<double>& sample) {
    if (sample.empty()) return fmt::format("{:<28} none\n", name);
    return fmt::format("{:<28} p50 {:7.2f} ms   p95 {:7.2f} ms   p99 {:7.2f} ms   max {:7.2f} ms   n {}\n", name,
                       percentile(sample, 0.5), percentile(sample, 0.95), percentile(sample, 0.99),
                       *std::max_element(sample.begin(), sample.end()), sample.size());
}

}  // namespace

double percentile(std::vector<double> sample, double share) {
    if (sample.empty()) return 0.0;
    std::sort(sample.begin(), sample.end());
    const double rank = share * static_cast<double>(sample.size() - 1);
    const auto below = static_cast<std::size_t>(std::floor(rank));
    const std::size_t above = std::min(below + 1, sample.size() - 1);
    return std::lerp(sample[below], sample[above], rank - std::floor(rank));
}

UiTrace::UiTrace(const std::filesystem::path& path) : file_(path) {
    if (!file_) throw Error(ErrorKind::Runtime, fmt::format("{}: cannot write the trace", path.string()));
}

void UiTrace::camera_moved(double seconds, std::uint64_t generation) {
    if (generation == camera_generation_) return;
    camera_generation_ = generation;
    waiting_.push_back({seconds, generation, seconds - last_move_ > kNewMoveSeconds});
    last_move_ = seconds;
}

void UiTrace::backend_asked(double seconds, std::uint64_t generation) {
    if (generation == backend_generation_) return;
    backend_generation_ = generation;
    switches_.push_back({seconds, generation, true});
}

void UiTrace::frame_shown(double seconds, const FrameTimes& times, std::uint64_t generation) {
    work_ms_.push_back(1000.0 * times.work);
    cpu_ms_.push_back(1000.0 * times.cpu);
    if (times.interval >= 0.0) interval_ms_.push_back(1000.0 * times.interval);
    file_ << fmt::format(
                 R"({{"event":"frame","frame":{},"t":{:.6f},"work_ms":{:.3f},"cpu_ms":{:.3f},"interval_ms":{:.3f})",
                 frames_++, seconds, 1000.0 * times.work, 1000.0 * times.cpu, 1000.0 * times.interval)
          << "}\n";
    show(waiting_, "picture", picture_ms_, seconds, generation);
    show(switches_, "switch", switch_ms_, seconds, generation);
}

/// What waits for a picture of this generation.
void UiTrace::show(std::vector<Move>& waiting, const char* event, std::vector<double>& all_ms, double seconds,
                   std::uint64_t generation) {
    std::erase_if(waiting, [&](const Move& move) {
        if (move.generation > generation) return false;
        const double ms = 1000.0 * (seconds - move.seconds);
        all_ms.push_back(ms);
        if (&waiting == &waiting_ && move.is_first) first_picture_ms_.push_back(ms);
        file_ << fmt::format(R"({{"event":"{}","t":{:.6f},"latency_ms":{:.3f},"first":{})", event, seconds, ms,
                             move.is_first)
              << "}\n";
        return true;
    });
}

std::string UiTrace::finish() {
    file_
        << fmt::format(
               R"({{"event":"summary","work_ms":{},"cpu_ms":{},"interval_ms":{},"first_picture_ms":{},"picture_ms":{},"switch_ms":{})",
               statistics(work_ms_), statistics(cpu_ms_), statistics(interval_ms_), statistics(first_picture_ms_),
               statistics(picture_ms_), statistics(switch_ms_))
        << "}\n";
    file_.flush();
    return line_of("UI frame, work", work_ms_) + line_of("UI frame, computing", cpu_ms_) +
           line_of("UI frame to frame", interval_ms_) + line_of("first picture after a rest", first_picture_ms_) +
           line_of("input to picture", picture_ms_) + line_of("switch of back ends", switch_ms_);
}

}  // namespace pl::ui
