// What all picture formats here have in common.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace pl {

/// Throws Error(Runtime) unless both sides are positive and `size` counts `per_pixel` values for each pixel.
void require_complete(const std::filesystem::path& path, int width, int height, std::size_t size,
                      std::size_t per_pixel);

/// Throws Error(Input) unless a picture of this size is plausible: sides positive, at most 2^28 pixels.
void require_plausible(const std::filesystem::path& path, long long width, long long height);

[[noreturn]] void fail_image(const std::filesystem::path& path, const std::string& why);

}  // namespace pl
