#include "core/io/decode_image.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string_view>
#include <type_traits>

#include <fmt/format.h>
#include <stb_image.h>

#include "core/base/memory.h"
#include "core/io/image.h"

namespace pl {
namespace {

/// Little-endian number of `size` bytes; bytes beyond the end are 0.
std::size_t number_at(std::string_view file, std::size_t at, int size) {
    std::size_t value = 0;
    for (int i = size; i-- > 0;) {
        const std::size_t place = at + static_cast<std::size_t>(i);
        value = value << 8 | (place < file.size() ? static_cast<unsigned char>(file[place]) : 0u);
    }
    return value;
}

/// The end marker must follow the start of the last scan: an earlier one belongs to a thumbnail.
bool jpeg_ends_early(std::string_view file) {
    const std::size_t scan = file.rfind("\xff\xda");
    return scan == std::string_view::npos || file.find("\xff\xd9", scan) == std::string_view::npos;
}

/// Walks the packets of a run-length encoded image: a header byte, then one texel or up to 128.
bool tga_runs_end_early(std::string_view file, std::size_t at, std::size_t texels, std::size_t texel_bytes) {
    constexpr std::size_t kRepeats = 128;
    while (texels > 0) {
        if (at >= file.size()) return true;
        const std::size_t mark = number_at(file, at, 1);
        const std::size_t length = mark % kRepeats + 1;
        at += 1 + (mark >= kRepeats ? 1 : length) * texel_bytes;
        texels -= std::min(texels, length);
    }
    return at > file.size();
}

bool tga_ends_early(std::string_view file, std::size_t texels) {
    constexpr std::size_t kHeader = 18;
    constexpr std::size_t kCoded = 8;
    const std::size_t palette = number_at(file, 5, 2) * ((number_at(file, 7, 1) + 7) / 8);
    const std::size_t first = kHeader + number_at(file, 0, 1) + (number_at(file, 1, 1) != 0 ? palette : 0);
    const std::size_t texel_bytes = (number_at(file, 16, 1) + 7) / 8;
    if ((number_at(file, 2, 1) & kCoded) != 0) return tga_runs_end_early(file, first, texels, texel_bytes);
    return file.size() < first + texels * texel_bytes;
}

/// Rows are padded to four bytes; the padding of the last one may be missing.
bool bmp_ends_early(std::string_view file, std::size_t width, std::size_t height) {
    constexpr std::size_t kOldHeader = 12;
    const std::size_t first = number_at(file, 10, 4);
    const std::size_t texel_bits = number_at(file, number_at(file, 14, 4) == kOldHeader ? 24 : 28, 2);
    const std::size_t row = (width * texel_bits + 31) / 32 * 4;
    return file.size() < first + row * (height - 1) + (width * texel_bits + 7) / 8;
}

}  // namespace

bool ends_early(ImageKind kind, std::string_view file, std::size_t width, std::size_t height) {
    if (kind == ImageKind::Jpeg) return jpeg_ends_early(file);
    if (kind == ImageKind::Tga) return tga_ends_early(file, width * height);
    if (kind == ImageKind::Bmp) return bmp_ends_early(file, width, height);
    return false;
}

namespace {

namespace fs = std::filesystem;

void require_texture_size(const fs::path& path, long long width, long long height) {
    constexpr auto kSide = static_cast<long long>(kMostTextureSide);
    if (width <= 0 || height <= 0 || width > kSide || height > kSide ||
        static_cast<std::size_t>(width * height) > kMostTexels) {
        fail_image(path, fmt::format("a texture of {}x{}: sides up to {} and {} texels are supported", width, height,
                                     kMostTextureSide, kMostTexels));
    }
    constexpr std::uint64_t kTexelBytes = 44;  // as decoded, with its alpha, as four floats, and as packed
    require_memory(path.string(), static_cast<std::uint64_t>(width * height) * kTexelBytes, ErrorKind::Input);
}

constexpr unsigned kTgaFromRight = 0x10;  // in the descriptor: columns begin at the right

template <class Sample>
using StbPixels = std::unique_ptr<Sample, decltype(&stbi_image_free)>;

template <class Sample>
std::vector<glm::vec4> unpack(const StbPixels<Sample>& pixels, std::size_t count) {
    constexpr auto kLargest = static_cast<float>(std::numeric_limits<Sample>::max());
    std::vector<glm::vec4> texels(count);
    const Sample* at = pixels.get();
    for (glm::vec4& texel : texels)
        for (int channel = 0; channel < 4; ++channel) texel[channel] = static_cast<float>(*at++) / kLargest;
    return texels;
}

/// Decoder of the kinds with 8 or 16 bits per sample.
class StbDecoder {
public:
    StbDecoder(std::string_view bytes, ImageKind kind, const fs::path& path)
        : bytes_(bytes), kind_(kind), path_(path) {
        if (bytes.size() > std::numeric_limits<int>::max()) fail_image(path, "expected a file of less than 2 GB");
    }

    DecodedImage run() {
        read_size();
        require_texture_size(path_, image_.width, image_.height);
        require_whole();
        if (stbi_is_16_bit_from_memory(data(), size()) != 0)
            read(stbi_load_16_from_memory);
        else
            read(stbi_load_from_memory);
        if (kind_ == ImageKind::Tga && (byte_at(17) & kTgaFromRight) != 0) mirror();
        return std::move(image_);
    }

private:
    const stbi_uc* data() const { return reinterpret_cast<const stbi_uc*>(bytes_.data()); }
    int size() const { return static_cast<int>(bytes_.size()); }
    unsigned byte_at(std::size_t at) const {
        return at < bytes_.size() ? static_cast<unsigned char>(bytes_[at]) : 0u;
    }
    long long png_number_at(std::size_t at) const {
        return static_cast<long long>(byte_at(at) << 24 | byte_at(at + 1) << 16 | byte_at(at + 2) << 8 |
                                      byte_at(at + 3));
    }

    [[noreturn]] void fail(const std::string& why) const {
        fail_image(path_,
                   fmt::format("a damaged {} file, or of a variant that is not supported: {}", name_of(kind_), why));
    }

    /// The reason that the decoder gave since it was asked to load the file. The one before may be of another decoder:
    /// the search for the size tries all of them.
    template <class Load>
    auto load(Load load_from_memory, int& width, int& height) const {
        const std::string before = stb_failure();
        int channels = 0;
        auto* const loaded = load_from_memory(data(), size(), &width, &height, &channels, 4);
        if (loaded == nullptr) fail(stb_failure() == before ? "its data cannot be decoded" : stb_failure());
        return StbPixels<std::remove_pointer_t<decltype(loaded)>>(loaded, &stbi_image_free);
    }

    void read_size() {
        // The decoder does not tell a size that it cannot hold.
        constexpr std::size_t kPngSize = 16;
        if (kind_ == ImageKind::Png && bytes_.size() >= kPngSize + 8)
            require_texture_size(path_, png_number_at(kPngSize), png_number_at(kPngSize + 4));
        int channels = 0;
        if (stbi_info_from_memory(data(), size(), &image_.width, &image_.height, &channels) == 0)
            load(stbi_load_from_memory, image_.width, image_.height);
        image_.height = std::abs(image_.height);  // negative in BMP files whose rows begin at the top
        if (kind_ == ImageKind::Tga && (byte_at(1) != 0 && (byte_at(3) | byte_at(4)) != 0))
            fail("a palette that begins behind entry 0");
    }

    void require_whole() const {
        if (ends_early(kind_, bytes_, static_cast<std::size_t>(image_.width),
                       static_cast<std::size_t>(image_.height)))
            fail_image(path_, "damaged: it ends too early");
    }

    template <class Load>
    void read(Load load_from_memory) {
        int width = 0;
        int height = 0;
        const auto pixels = load(load_from_memory, width, height);
        if (width != image_.width || height != image_.height) fail("two sizes");
        image_.texels = unpack(pixels, static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    }

    /// The decoder has already turned an image upside down whose rows begin at the bottom.
    void mirror() {
        for (auto row = image_.texels.begin(); row != image_.texels.end(); row += image_.width)
            std::reverse(row, row + image_.width);
    }

    std::string_view bytes_;
    ImageKind kind_;
    const fs::path& path_;
    DecodedImage image_;
};

DecodedImage decode_linear_image(const std::string& bytes, const fs::path& path, std::vector<std::string>& warnings) {
    std::vector<float> alpha;
    const LinearImage linear = decode_linear(
        bytes, {.path = path, .require_size = require_texture_size, .warnings = &warnings, .alpha = &alpha});
    DecodedImage image{.width = linear.width, .height = linear.height, .is_ldr = false};
    image.texels.reserve(linear.pixels.size());
    for (std::size_t i = 0; i < linear.pixels.size(); ++i)
        image.texels.emplace_back(linear.pixels[i], alpha.empty() ? 1.0f : alpha[i]);
    return image;
}

}  // namespace

DecodedImage decode_image(const std::string& bytes, const fs::path& path, std::vector<std::string>& warnings) {
    const ImageKind kind = image_kind_of(bytes, path);
    return is_linear(kind) ? decode_linear_image(bytes, path, warnings) : StbDecoder(bytes, kind, path).run();
}

}  // namespace pl
