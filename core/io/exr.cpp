// OpenEXR by the library of this name. Its types stay in this file.
#include "core/io/image.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <string_view>

#include <fmt/format.h>
#include <Iex.h>
#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>
#include <ImfTileDescription.h>

#include "core/base/error.h"
#include "core/io/exr_layers.h"
#include "core/io/files.h"
#include "core/io/primaries.h"

namespace pl {
namespace {

constexpr int kThreads = 0;
constexpr std::array<const char*, 3> kColorChannels = {"R", "G", "B"};

/// As many pixels as are read at once, but at least a row: memory grows with what the file has, whatever size its
/// header says.
constexpr int kPixelsAtOnce = 1 << 20;

/// The library makes tables of this length before anyone can look at the size.
void limit_library() {
    constexpr int kMostSide = 1 << 24;
    constexpr int kMostTileSide = 1 << 16;
    static const bool is_done = [] {
        Imf::Header::setMaxImageSize(kMostSide, kMostSide);
        Imf::Header::setMaxTileSize(kMostTileSide, kMostTileSide);
        return true;
    }();
    static_cast<void>(is_done);
}

/// Clamps to the range of half floats; NaN stays NaN.
half to_half(float value) {
    constexpr float kLargestHalf = 65504.0f;
    return half(value > kLargestHalf ? kLargestHalf : value);
}

template <class Number>
std::string encode(const Imf::Header& header, const LinearImage& image, Imf::PixelType type,
                   Number (*convert)(float)) {
    std::vector<Number> numbers;
    numbers.reserve(3 * image.pixels.size());
    for (const glm::vec3& pixel : image.pixels)
        for (int c = 0; c < 3; ++c) numbers.push_back(convert(pixel[c]));
    Imf::FrameBuffer buffer;
    for (std::size_t c = 0; c < 3; ++c)
        buffer.insert(kColorChannels[c],
                      Imf::Slice::Make(type, numbers.data() + c, header.dataWindow(), 3 * sizeof(Number)));
    Imf::StdOSStream stream;
    {
        Imf::OutputFile file(stream, header, kThreads);
        file.setFrameBuffer(buffer);
        file.writePixels(image.height);
    }
    return stream.str();
}

/// Whether the attributes of all headers end in the file: the library makes room for a text of any length.
///   [OpenEXR, "File Layout"]
bool has_whole_headers(std::string_view bytes) {
    constexpr std::size_t kVersionAt = 4;
    constexpr unsigned char kSeveralParts = 0x10;  // in the second byte of the version
    if (bytes.size() < 2 * kVersionAt) return false;
    const bool has_parts = (static_cast<unsigned char>(bytes[kVersionAt + 1]) & kSeveralParts) != 0;
    std::string_view rest = bytes.substr(2 * kVersionAt);
    const auto take_text = [&] {  // false if it is empty, as at the end of a header
        const std::size_t length = std::min(rest.find('\0'), rest.size());
        rest.remove_prefix(std::min(length + 1, rest.size()));
        return length > 0;
    };
    do {
        while (take_text()) {  // name, type, size, value
            std::uint32_t size = 0;
            take_text();
            if (rest.size() < sizeof size) return false;
            std::memcpy(&size, rest.data(), sizeof size);
            rest.remove_prefix(sizeof size);
            if (size > rest.size()) return false;
            rest.remove_prefix(size);
        }
    } while (has_parts && !rest.empty() && rest.front() != '\0');
    return true;
}

/// The reason that the library gives, without the name of the file before it.
std::string reason_of(const Iex::BaseExc& error) {
    const std::string words = error.what();
    constexpr std::string_view kBefore = "\"(string)\". ";
    const std::size_t at = words.rfind(kBefore);
    return at == std::string::npos ? words : words.substr(at + kBefore.size());
}

ExrPart part_of(const Imf::Header& header) {
    ExrPart part{.name = header.hasName() ? header.name() : "",
                 .is_deep = header.hasType() && Imf::isDeepData(header.type()),
                 .channels = {}};
    const Imf::ChannelList& channels = header.channels();
    for (auto channel = channels.begin(); channel != channels.end(); ++channel)
        part.channels.push_back(
            {.name = channel.name(),
             .is_float = channel.channel().type != Imf::UINT,
             .is_subsampled = channel.channel().xSampling != 1 || channel.channel().ySampling != 1});
    return part;
}

Primaries primaries_of(const Imf::Header& header) {
    if (!Imf::hasChromaticities(header)) return kSrgbPrimaries;
    const Imf::Chromaticities& file = Imf::chromaticities(header);
    const auto point = [](const Imath::V2f& xy) { return glm::dvec2(glm::vec2(xy.x, xy.y)); };
    return {point(file.red), point(file.green), point(file.blue), point(file.white)};
}

class ExrDecoder {
public:
    ExrDecoder(const std::string& bytes, const LinearSettings& settings) : settings_(settings) { stream_.str(bytes); }

    LinearImage run() {
        Imf::MultiPartInputFile file(stream_, kThreads);
        std::vector<ExrPart> parts;
        for (int i = 0; i < file.parts(); ++i) parts.push_back(part_of(file.header(i)));
        const ExrLayer layer = choose_exr_layer(parts, settings_.path);
        const Imf::Header& header = file.header(layer.part);
        require_size(header);
        tell(header, layer);
        read_metadata(header);
        LinearImage image =
            layer.is_luminance_chroma ? read_luminance_chroma(header, layer) : read_colors(file, layer);
        if (!layer.is_gray()) convert_to_srgb(primaries_of(header), settings_, image);
        return image;
    }

private:
    void require_size(const Imf::Header& header) {
        const Imath::Box2i& window = header.dataWindow();
        const auto extent = [&](int axis) { return static_cast<long long>(window.max[axis]) - window.min[axis] + 1; };
        settings_.require_size(settings_.path, extent(0), extent(1));
        // Tiles are read by rows of them.
        if (header.hasTileDescription()) require_plausible(settings_.path, extent(0), header.tileDescription().ySize);
    }

    void tell(const Imf::Header& header, const ExrLayer& layer) const {
        if (!layer.note.empty()) settings_.note(layer.note);
        if (header.dataWindow() != header.displayWindow())
            settings_.note("its data window, not its display window, is the image");
    }

    void read_metadata(const Imf::Header& header) const {
        if (settings_.metadata == nullptr) return;
        for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
            const auto* const text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute());
            const std::string name = attribute.name();
            // The library adds the kind of the part.
            if (text != nullptr && name != "type") settings_.metadata->emplace_back(name, text->value());
        }
    }

    /// Reads a window by `read_rows` for some rows after others, with the window of these and the place for their pixels.
    template <class Pixel, class ReadRows, class Convert>
    static LinearImage read_in_blocks(const Imath::Box2i& window, ReadRows&& read_rows, Convert&& convert) {
        LinearImage image{
            .width = window.max.x - window.min.x + 1, .height = window.max.y - window.min.y + 1, .pixels = {}};
        const auto width = static_cast<std::size_t>(image.width);
        image.pixels.reserve(width * static_cast<std::size_t>(image.height));
        const int rows_at_once = std::clamp(kPixelsAtOnce / image.width, 1, image.height);
        std::vector<Pixel> rows(width * static_cast<std::size_t>(rows_at_once));
        for (int done = 0; done < image.height; done += rows_at_once) {
            const int count = std::min(rows_at_once, image.height - done);
            const Imath::Box2i block({window.min.x, window.min.y + done},
                                     {window.max.x, window.min.y + done + count - 1});
            read_rows(block, rows.data());
            const auto end = rows.begin() + static_cast<std::ptrdiff_t>(width) * count;
            std::transform(rows.begin(), end, std::back_inserter(image.pixels), convert);
        }
        return image;
    }

    LinearImage read_colors(Imf::MultiPartInputFile& file, const ExrLayer& layer) const {
        Imf::InputPart part(file, layer.part);
        const auto read_rows = [&](const Imath::Box2i& block, glm::vec4* rows) {
            Imf::FrameBuffer buffer;
            const auto insert = [&](const std::string& channel, float* first) {
                buffer.insert(channel, Imf::Slice::Make(Imf::FLOAT, first, block, sizeof(glm::vec4)));
            };
            // Gray has one channel, which serves all three colors: a buffer has each channel once.
            for (std::size_t c = 0; c < 3; ++c) insert(layer.channels[c], &rows->x + c);
            if (!layer.alpha.empty()) insert(layer.alpha, &rows->w);
            part.setFrameBuffer(buffer);
            part.readPixels(block.min.y, block.max.y);
        };
        return read_in_blocks<glm::vec4>(part.header().dataWindow(), read_rows, [&](const glm::vec4& pixel) {
            keep_alpha(layer, pixel.w);
            return layer.is_gray() ? glm::vec3(pixel.z) : glm::vec3(pixel);
        });
    }

    void keep_alpha(const ExrLayer& layer, float alpha) const {
        if (settings_.alpha != nullptr && !layer.alpha.empty()) settings_.alpha->push_back(alpha);
    }

    /// The library converts them, in half precision.
    LinearImage read_luminance_chroma(const Imf::Header& header, const ExrLayer& layer) {
        if (layer.part != 0) fail_image(settings_.path, "expected luminance and chroma in the first part");
        stream_.seekg(0);
        Imf::RgbaInputFile file(stream_, layer.name, kThreads);
        const auto read_rows = [&](const Imath::Box2i& block, Imf::Rgba* rows) {
            const auto width = static_cast<std::uintptr_t>(block.max.x - block.min.x + 1);
            // The library adds the place in the window.
            const std::uintptr_t origin =
                static_cast<std::uintptr_t>(block.min.x) + static_cast<std::uintptr_t>(block.min.y) * width;
            file.setFrameBuffer(
                reinterpret_cast<Imf::Rgba*>(reinterpret_cast<std::uintptr_t>(rows) - origin * sizeof(Imf::Rgba)), 1,
                width);
            file.readPixels(block.min.y, block.max.y);
        };
        return read_in_blocks<Imf::Rgba>(header.dataWindow(), read_rows, [&](const Imf::Rgba& pixel) {
            keep_alpha(layer, pixel.a);
            return glm::vec3(pixel.r, pixel.g, pixel.b);
        });
    }

    const LinearSettings& settings_;
    Imf::StdISStream stream_;
};

}  // namespace

std::string encode_exr(const LinearImage& image, const ImageMetadata& metadata, ExrNumbers numbers) {
    const bool is_half = numbers == ExrNumbers::Half;
    try {
        Imf::Header header(image.width, image.height);
        header.compression() = Imf::ZIP_COMPRESSION;
        for (const char* name : kColorChannels)
            header.channels().insert(name, Imf::Channel(is_half ? Imf::HALF : Imf::FLOAT));
        for (const auto& [name, value] : metadata) header.insert(name, Imf::StringAttribute(value));
        return is_half ? encode<half>(header, image, Imf::HALF, to_half)
                       : encode<float>(header, image, Imf::FLOAT, [](float value) { return value; });
    } catch (const Iex::BaseExc& error) {
        throw Error(ErrorKind::Runtime, fmt::format("the EXR encoder failed: {}", error.what()));
    }
}

void write_exr(const std::filesystem::path& path, const LinearImage& image, const ImageMetadata& metadata,
               ExrNumbers numbers) {
    require_complete(path, image.width, image.height, image.pixels.size(), 1);
    write_file_atomic(path, encode_exr(image, metadata, numbers));
}

LinearImage decode_exr(const std::string& bytes, const LinearSettings& settings) {
    if (!bytes.starts_with("\x76\x2f\x31\x01")) fail_image(settings.path, "not an EXR file");
    if (!has_whole_headers(bytes)) fail_image(settings.path, "damaged: its header is not whole");
    limit_library();
    try {
        return ExrDecoder(bytes, settings).run();
    } catch (const Iex::BaseExc& error) {
        fail_image(settings.path, "a damaged exr file, or of a variant that is not supported: " + reason_of(error));
    }
}

}  // namespace pl
