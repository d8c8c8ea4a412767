// Checks shared by all picture formats.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace pl {

/// Throws Error(Runtime) unless width and height are positive and `size` = width x height x `per_pixel`.
void require_complete(const std::filesystem::path& path, int width, int height, std::size_t size,
                      std::size_t per_pixel);

/// Throws Error(Input) unless width and height are positive, with at most 2^28 pixels; MemoryError if these do not fit the memory.
void require_plausible(const std::filesystem::path& path, long long width, long long height);

/// The reason of the last failure of stb_image, "unknown" where it gives none.
std::string stb_failure();

[[noreturn]] void fail_image(const std::filesystem::path& path, const std::string& why);

}  // namespace pl
