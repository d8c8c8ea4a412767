// The paths of one pixel of a picture, with and without guidance by the same random numbers.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/diagnose/record_path.h"
#include "core/session/session.h"

namespace pl::diagnose {

/// Passes of a picture by the baseline method and, where a field is learned, guided by it. The paths of a pass and pixel have the
/// same random numbers in both.
struct PassPair {
    PassReplay plain;                                  ///< without a field
    std::optional<PassReplay> guided{};                ///< numbered as `plain`
    MethodId guided_method = MethodId::Reinforcement;  ///< of `guided`
    bool shows_guided = false;                         ///< the picture is by that method
};
/// Of a film. `guided` is by the method of field_owner(), if that has a field in this session. Throws Error(Usage) if the view traces
/// no paths.
PassPair pass_pair(const Session& session, FilmSlot slot);

/// Which passes of a pixel are of interest.
enum class PassChoice { Brightest, Newest };

/// Passes searched for the brightest at most, newest first.
inline constexpr std::uint32_t kMostSearchedPasses = 1u << 14;

struct PixelPathsRequest {
    std::uint32_t pixel = 0;   ///< row-major
    std::uint32_t count = 32;  ///< of passes
    PassChoice choice = PassChoice::Brightest;

    friend bool operator==(const PixelPathsRequest&, const PixelPathsRequest&) = default;
};

/// Paths of the same passes, in the same order: by the light that the method of the picture brought, brightest first.
struct PixelPaths {
    std::uint32_t pixel = 0;
    std::uint32_t samples = 0;            ///< of the pixel in the picture
    std::uint32_t searched = 0;           ///< passes that these were chosen from
    std::vector<std::uint32_t> passes{};  ///< numbers within the picture
    std::vector<PathRecord> plain{};
    std::vector<PathRecord> guided{};  ///< empty without a field
};

/// Traces by record_path(), in any thread. A picture that has fewer passes than requested is continued by the passes
/// that follow. Guided paths sample from the field as it was when the replay was taken. Stopped early, it returns the
/// best so far.
PixelPaths trace_pixel(PassPair& passes, const PixelPathsRequest& request, const StopFlag* stop = nullptr);

/// Luminance of the radiance that a path brought to its pixel.
float path_light(const PathRecord& path);

/// Indices of paths, brightest first; of equal ones the first.
std::vector<std::size_t> by_light(const std::vector<PathRecord>& paths);

}  // namespace pl::diagnose
