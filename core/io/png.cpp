// PNG by stb, which does not support text chunks: they are added and read here.
#include "core/io/image.h"

#include <array>
#include <memory>
#include <string_view>

#include <fmt/format.h>
#include <stb_image.h>
#include <stb_image_write.h>

#include "core/base/error.h"
#include "core/io/files.h"

namespace pl {

namespace {

constexpr std::size_t kSignatureSize = 8;
constexpr std::size_t kChunkFrame = 12;  // length, type, checksum
constexpr std::size_t kHeaderEnd = kSignatureSize + kChunkFrame + 13;
constexpr std::size_t kLongestKeyword = 79;

/// CRC-32 of the PNG specification, annex D (polynomial 0xedb88320, reflected).
std::uint32_t crc32(std::string_view bytes) {
    std::uint32_t crc = 0xffffffffu;
    for (const char c : bytes) {
        crc ^= static_cast<std::uint8_t>(c);
        for (int bit = 0; bit < 8; ++bit) {
            crc = (crc >> 1) ^ ((crc & 1u) != 0u ? 0xedb88320u : 0u);
        }
    }
    return ~crc;
}

void append_u32(std::string& to, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) {
        to.push_back(static_cast<char>((value >> shift) & 0xffu));
    }
}

std::uint32_t read_u32(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        value = (value << 8) | static_cast<std::uint8_t>(bytes[at + i]);
    }
    return value;
}

std::string text_chunk(const std::string& keyword, const std::string& text) {
    const std::string body = "tEXt" + keyword.substr(0, kLongestKeyword) + '\0' + text;
    std::string chunk;
    append_u32(chunk, static_cast<std::uint32_t>(body.size() - 4));
    chunk += body;
    append_u32(chunk, crc32(body));
    return chunk;
}

void read_text_chunks(std::string_view bytes, ImageMetadata& metadata) {
    std::size_t at = kSignatureSize;
    while (at + kChunkFrame <= bytes.size()) {
        const std::size_t length = read_u32(bytes, at);
        if (length > bytes.size() - at - kChunkFrame) {
            return;
        }
        const std::string_view body = bytes.substr(at + 8, length);
        const std::size_t end = body.find('\0');
        if (bytes.substr(at + 4, 4) == "tEXt" && end != std::string_view::npos) {
            metadata.emplace_back(body.substr(0, end), body.substr(end + 1));
        }
        at += kChunkFrame + length;
    }
}

void append_bytes(void* to, void* data, int size) {
    static_cast<std::string*>(to)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

}  // namespace

std::string encode_png8(const ByteImage& image, const ImageMetadata& metadata) {
    std::string bytes;
    if (stbi_write_png_to_func(append_bytes, &bytes, image.width, image.height, 3, image.rgb.data(),
                               image.width * 3) == 0 ||
        bytes.size() < kHeaderEnd) {
        throw Error(ErrorKind::Runtime, "the PNG encoder failed");
    }
    std::string chunks;
    for (const auto& [keyword, text] : metadata) {
        chunks += text_chunk(keyword, text);
    }
    return bytes.insert(kHeaderEnd, chunks);
}

void write_png8(const std::filesystem::path& path, const ByteImage& image, const ImageMetadata& metadata) {
    require_complete(path, image.width, image.height, image.rgb.size(), 3);
    write_file_atomic(path, encode_png8(image, metadata));
}

ByteImage read_png8(const std::filesystem::path& path, ImageMetadata* metadata) {
    const std::string bytes = read_file(path);
    constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", kSignatureSize);
    if (!bytes.starts_with(kSignature)) {
        fail_image(path, "not a PNG file");
    }
    ByteImage image;
    int channels = 0;
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
        stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()), static_cast<int>(bytes.size()),
                              &image.width, &image.height, &channels, 3),
        &stbi_image_free);
    if (!pixels) {
        fail_image(path, "PNG: " + stb_failure());
    }
    const std::size_t count = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 3;
    image.rgb.assign(pixels.get(), pixels.get() + count);
    if (metadata != nullptr) {
        read_text_chunks(bytes, *metadata);
    }
    return image;
}

}  // namespace pl
