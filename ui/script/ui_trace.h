// The responsiveness of the window: times of its frames, and latencies from an input to its picture.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace pl::ui {

/// Value below which this share of the sample lies, by linear interpolation between ranks; 0 for an empty sample.
double percentile(std::vector<double> sample, double share);

class UiTrace {
public:
    /// A move after a longer rest begins a new motion.
    static constexpr double kNewMoveSeconds = 0.2;

    /// Throws Error(Runtime) if the file cannot be written.
    explicit UiTrace(const std::filesystem::path& path);

    /// The number of the newest camera edit: a new one is a move, shown by pictures of at least this generation.
    void camera_moved(double seconds, std::uint64_t generation);

    /// The number of the newest request for another back end, in the same way.
    void backend_asked(double seconds, std::uint64_t generation);

    /// Durations of one frame of the window, in seconds.
    struct FrameTimes {
        double work;      ///< from its first event to its presentation, by the clock
        double cpu;       ///< processor time of the window's thread
        double interval;  ///< since the previous frame; negative after a rest of the window
    };
    /// A frame was shown; `generation`: of its picture.
    void frame_shown(double seconds, const FrameTimes& times, std::uint64_t generation);

    /// The percentiles, also as the last line of the file.
    std::string finish();

private:
    struct Move {
        double seconds;
        std::uint64_t generation;
        bool is_first;
    };
    void show(std::vector<Move>& waiting, const char* event, std::vector<double>& all_ms, double seconds,
              std::uint64_t generation);

    std::ofstream file_;
    std::vector<Move> waiting_;
    std::vector<Move> switches_;  ///< of back ends, whose first picture is still to come
    std::vector<double> work_ms_;
    std::vector<double> cpu_ms_;
    std::vector<double> interval_ms_;
    std::vector<double> first_picture_ms_;  ///< moves after a rest
    std::vector<double> picture_ms_;        ///< all moves
    std::vector<double> switch_ms_;
    std::uint64_t camera_generation_ = 0;
    std::uint64_t backend_generation_ = 0;
    double last_move_ = -1.0e9;
    std::uint64_t frames_ = 0;
};

}  // namespace pl::ui
