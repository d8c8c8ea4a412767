// How fluid the window is: times of its frames, and how long an input takes to become a picture.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace pl {

/// Value below which a share of the sample lies, by linear interpolation between ranks; 0 for an empty sample.
double percentile(std::vector<double> sample, double share);

class UiTrace {
public:
    /// Camera moves further apart than this are separate ones.
    static constexpr double kNewMoveSeconds = 0.2;

    /// Throws Error(Runtime) if the file cannot be written.
    explicit UiTrace(const std::filesystem::path& path);

    /// The camera was moved now; pictures of at least this generation show it.
    void camera_moved(double seconds, std::uint64_t generation);

    /// Another back end was asked for now.
    void backend_asked(double seconds, std::uint64_t generation);

    /// What one frame of the window took, in seconds.
    struct FrameTimes {
        double work;      ///< from its first event to its presentation, by the clock
        double cpu;       ///< of that, what the window's thread computed
        double interval;  ///< since the frame before; negative if the window rested in between
    };
    /// A frame was shown; `generation` is that of the picture in it.
    void frame_shown(double seconds, const FrameTimes& times, std::uint64_t generation);

    /// The percentiles, also as the last line of the file.
    std::string finish();

private:
    struct Move {
        double seconds;
        std::uint64_t generation;
        bool is_first;
    };
    void show_moves(double seconds, std::uint64_t generation);
    void show_switches(double seconds, std::uint64_t generation);

    std::ofstream file_;
    std::vector<Move> waiting_;
    std::vector<Move> switches_;  ///< of the back end, whose picture is not there yet
    std::vector<double> work_ms_;
    std::vector<double> cpu_ms_;
    std::vector<double> interval_ms_;
    std::vector<double> first_picture_ms_;  ///< moves after a rest
    std::vector<double> picture_ms_;        ///< all moves
    std::vector<double> switch_ms_;
    double last_move_ = -1.0e9;
    std::uint64_t frames_ = 0;
};

}  // namespace pl
