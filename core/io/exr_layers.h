// Choice of what an EXR file shows, by the names of its channels.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace pl {

struct ExrChannel {
    std::string name;
    bool is_float = true;  ///< of either size, not a whole number
    bool is_subsampled = false;
};

struct ExrPart {
    std::string name;
    bool is_deep = false;
    std::vector<ExrChannel> channels;  ///< in the order of the file
};

/// Where the numbers of a picture are.
struct ExrLayer {
    int part = 0;
    std::string name{};                   ///< "" for the channels without a prefix
    std::array<std::string, 3> channels;  ///< red, green and blue; the same one for gray
    std::string alpha{};                  ///< "" without one
    bool is_luminance_chroma = false;
    std::string note{};  ///< which one it is, if others would have done

    bool is_gray() const { return !is_luminance_chroma && channels[0] == channels[2]; }
};

/// The first of these that there is, by the order of the parts, then of the channels: R, G and B without a prefix;
/// R, G and B of a layer "Combined", as Blender writes it; R, G and B of another layer; luminance Y with the chroma
/// RY and BY; Y alone; the only channel. Deep parts, subsampled channels and whole numbers do not count. Throws
/// Error(Input) if there is none.
ExrLayer choose_exr_layer(const std::vector<ExrPart>& parts, const std::filesystem::path& path);

}  // namespace pl
