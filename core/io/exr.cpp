// OpenEXR by tinyexr.
#include "core/io/image.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string_view>

#include <fmt/format.h>
#include <tinyexr.h>

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/image_checks.h"

namespace pl {

namespace {

constexpr std::size_t kMostAttributes = 100;                       // the library reads back up to 128
constexpr std::array<const char*, 3> kChannels = {"B", "G", "R"};  // files hold channels in alphabetical order

/// Copies and frees a message of the library.
std::string take_message(const char* message) {
    const std::string text = message != nullptr ? message : "unknown error";
    if (message != nullptr) {
        FreeEXRErrorMessage(message);
    }
    return text;
}

void copy_name(char (&to)[256], std::string_view name) {
    name = name.substr(0, sizeof(to) - 1);
    std::copy(name.begin(), name.end(), to);
    to[name.size()] = '\0';
}

std::vector<EXRAttribute> to_attributes(const ImageMetadata& metadata) {
    std::vector<EXRAttribute> attributes;
    for (const auto& [name, value] : metadata) {
        if (attributes.size() == kMostAttributes) {
            break;
        }
        EXRAttribute attribute{};
        copy_name(attribute.name, name);
        copy_name(attribute.type, "string");
        // The library does not modify it.
        attribute.value = reinterpret_cast<unsigned char*>(const_cast<char*>(value.data()));
        attribute.size = static_cast<int>(value.size());
        attributes.push_back(attribute);
    }
    return attributes;
}

/// The planes B, G, R, [plane][row][column].
std::array<std::vector<float>, 3> to_planes(const LinearImage& image) {
    std::array<std::vector<float>, 3> planes;
    for (std::size_t c = 0; c < 3; ++c) {
        planes[c].reserve(image.pixels.size());
        for (const glm::vec3& pixel : image.pixels) {
            planes[c].push_back(pixel[static_cast<int>(2 - c)]);
        }
    }
    return planes;
}

/// Clamps to the range of half floats; NaN stays NaN.
void limit_to_half(std::array<std::vector<float>, 3>& planes) {
    constexpr float kLargestHalf = 65504.0f;
    for (std::vector<float>& plane : planes) {
        for (float& value : plane) {
            if (value > kLargestHalf) {
                value = kLargestHalf;
            }
        }
    }
}

struct HeaderOwner {
    EXRHeader header;
    HeaderOwner() { InitEXRHeader(&header); }
    ~HeaderOwner() { FreeEXRHeader(&header); }
    HeaderOwner(const HeaderOwner&) = delete;
    HeaderOwner& operator=(const HeaderOwner&) = delete;
};

struct ImageOwner {
    EXRImage image;
    bool loaded = false;
    ImageOwner() { InitEXRImage(&image); }
    ~ImageOwner() {
        if (loaded) {  // after a failure the library has already freed the pixels
            FreeEXRImage(&image);
        }
    }
    ImageOwner(const ImageOwner&) = delete;
    ImageOwner& operator=(const ImageOwner&) = delete;
};

/// Value of an attribute of type string. The library returns a single null character for an empty one.
std::string text_of(const EXRAttribute& attribute) {
    const std::string text(reinterpret_cast<const char*>(attribute.value), static_cast<std::size_t>(attribute.size));
    return text.substr(0, text.find('\0'));
}

void read_header(const std::filesystem::path& path, const std::string& bytes, EXRHeader& header) {
    const auto* const data = reinterpret_cast<const unsigned char*>(bytes.data());
    EXRVersion version{};
    if (ParseEXRVersionFromMemory(&version, data, bytes.size()) != TINYEXR_SUCCESS) {
        fail_image(path, "not an EXR file");
    }
    if (version.tiled != 0 || version.multipart != 0 || version.non_image != 0) {
        fail_image(path, "expected an EXR file of scanlines with one part");
    }
    const char* message = nullptr;
    if (ParseEXRHeaderFromMemory(&header, &version, data, bytes.size(), &message) != TINYEXR_SUCCESS) {
        fail_image(path, "EXR header: " + take_message(message));
    }
    const EXRBox2i& window = header.data_window;
    require_plausible(path, static_cast<long long>(window.max_x) - window.min_x + 1,
                      static_cast<long long>(window.max_y) - window.min_y + 1);
    for (int c = 0; c < header.num_channels; ++c) {
        if (header.channels[c].x_sampling != 1 || header.channels[c].y_sampling != 1) {
            fail_image(path, "subsampled channels are not supported");
        }
        // Only half is converted; the other types stay as in the file.
        if (header.pixel_types[c] == TINYEXR_PIXELTYPE_HALF) {
            header.requested_pixel_types[c] = TINYEXR_PIXELTYPE_FLOAT;
        }
    }
}

int channel_index(const std::filesystem::path& path, const EXRHeader& header, const char* name) {
    for (int c = 0; c < header.num_channels; ++c) {
        if (std::strcmp(header.channels[c].name, name) == 0) {
            if (header.requested_pixel_types[c] != TINYEXR_PIXELTYPE_FLOAT) {
                fail_image(path, fmt::format("channel {}: expected floats", name));
            }
            return c;
        }
    }
    fail_image(path, fmt::format("expected the channels R, G and B, {} is missing", name));
}

}  // namespace

void write_exr(const std::filesystem::path& path, const LinearImage& image, const ImageMetadata& metadata,
               ExrNumbers numbers) {
    require_complete(path, image.width, image.height, image.pixels.size(), 1);
    std::array<std::vector<float>, 3> planes = to_planes(image);
    if (numbers == ExrNumbers::Half) {
        limit_to_half(planes);
    }
    std::array<unsigned char*, 3> plane_data{};
    std::array<EXRChannelInfo, 3> channels{};
    std::array<int, 3> types{};
    std::array<int, 3> stored_types{};
    for (std::size_t c = 0; c < 3; ++c) {
        plane_data[c] = reinterpret_cast<unsigned char*>(planes[c].data());
        copy_name(channels[c].name, kChannels[c]);
        types[c] = TINYEXR_PIXELTYPE_FLOAT;
        stored_types[c] = numbers == ExrNumbers::Half ? TINYEXR_PIXELTYPE_HALF : TINYEXR_PIXELTYPE_FLOAT;
    }
    std::vector<EXRAttribute> attributes = to_attributes(metadata);

    EXRImage exr_image;
    InitEXRImage(&exr_image);
    exr_image.images = plane_data.data();
    exr_image.width = image.width;
    exr_image.height = image.height;
    exr_image.num_channels = 3;

    EXRHeader header;  // not a HeaderOwner: it points to local objects
    InitEXRHeader(&header);
    header.num_channels = 3;
    header.channels = channels.data();
    header.pixel_types = types.data();
    header.requested_pixel_types = stored_types.data();
    header.compression_type = TINYEXR_COMPRESSIONTYPE_ZIP;
    header.num_custom_attributes = static_cast<int>(attributes.size());
    header.custom_attributes = attributes.data();

    unsigned char* memory = nullptr;
    const char* message = nullptr;
    const std::size_t size = SaveEXRImageToMemory(&exr_image, &header, &memory, &message);
    const std::unique_ptr<unsigned char, decltype(&std::free)> owner(memory, &std::free);
    if (size == 0) {
        throw Error(ErrorKind::Runtime,
                    fmt::format("{}: cannot be written: {}", path.string(), take_message(message)));
    }
    write_file_atomic(path, {reinterpret_cast<const char*>(memory), size});
}

LinearImage read_exr(const std::filesystem::path& path, ImageMetadata* metadata) {
    const std::string bytes = read_file(path);
    HeaderOwner owner;
    EXRHeader& header = owner.header;
    read_header(path, bytes, header);
    std::array<std::size_t, 3> channel{};
    for (std::size_t c = 0; c < 3; ++c) {
        channel[c] = static_cast<std::size_t>(channel_index(path, header, kChannels[2 - c]));
    }
    ImageOwner image;
    image.image.num_channels = header.num_channels;  // without it the library leaks them on failure
    const char* message = nullptr;
    const auto* const data = reinterpret_cast<const unsigned char*>(bytes.data());
    image.loaded = LoadEXRImageFromMemory(&image.image, &header, data, bytes.size(), &message) == TINYEXR_SUCCESS;
    if (!image.loaded) {
        fail_image(path, "EXR pixels: " + take_message(message));
    }
    LinearImage result{.width = image.image.width, .height = image.image.height, .pixels = {}};
    result.pixels.resize(static_cast<std::size_t>(result.width) * static_cast<std::size_t>(result.height));
    for (std::size_t c = 0; c < 3; ++c) {
        const auto* const plane = reinterpret_cast<const float*>(image.image.images[channel[c]]);
        for (std::size_t i = 0; i < result.pixels.size(); ++i) {
            result.pixels[i][static_cast<int>(c)] = plane[i];
        }
    }
    for (int i = 0; metadata != nullptr && i < header.num_custom_attributes; ++i) {
        const EXRAttribute& attribute = header.custom_attributes[i];
        if (std::strcmp(attribute.type, "string") == 0) {
            metadata->emplace_back(attribute.name, text_of(attribute));
        }
    }
    return result;
}

}  // namespace pl
