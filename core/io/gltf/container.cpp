#include "core/io/gltf/container.h"

#include <array>
#include <cstdint>

#include <fmt/format.h>

#include "core/base/error.h"

namespace pl {
namespace {

constexpr std::string_view kGlbMagic = "glTF";
constexpr std::size_t kGlbHeader = 12;
constexpr std::size_t kChunkHeader = 8;
constexpr std::uint32_t kJsonChunk = 0x4e4f534au;
constexpr std::uint32_t kBinaryChunk = 0x004e4942u;

std::uint32_t little_endian(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
}

/// Takes the chunks of a .glb one after the other.
class GlbReader {
public:
    GlbReader(std::string_view bytes, const std::filesystem::path& path) : bytes_(bytes), path_(path) {
        need(kGlbHeader, "a header");
        if (const std::uint32_t version = little_endian(bytes_, 4); version != 2)
            fail(4, fmt::format("expected version 2 of the container, got {}", version));
        if (const std::uint32_t length = little_endian(bytes_, 8); length != bytes_.size())
            fail(8, fmt::format("the header says {} bytes, the file has {}", length, bytes_.size()));
        at_ = kGlbHeader;
    }

    GltfParts run() {
        GltfParts parts;
        const auto [first, text] = next_chunk();
        if (first != kJsonChunk)
            fail(kGlbHeader + 4, fmt::format("expected a JSON chunk first, got the type 0x{:08x}", first));
        parts.text = text;
        while (at_ < bytes_.size()) {
            const auto [type, content] = next_chunk();
            if (type == kBinaryChunk && !parts.binary) parts.binary.emplace(content);
        }
        return parts;
    }

private:
    std::pair<std::uint32_t, std::string_view> next_chunk() {
        need(kChunkHeader, "the header of a chunk");
        const std::size_t length = little_endian(bytes_, at_);
        const std::uint32_t type = little_endian(bytes_, at_ + 4);
        at_ += kChunkHeader;
        need(length, "a chunk");
        const std::string_view content = bytes_.substr(at_, length);
        at_ += length;
        return {type, content};
    }

    void need(std::size_t count, const char* what) const {
        if (bytes_.size() - at_ < count)
            fail(at_, fmt::format("expected {} of {} bytes, got {}", what, count, bytes_.size() - at_));
    }

    [[noreturn]] void fail(std::size_t at, const std::string& what) const {
        throw Error(ErrorKind::Input, fmt::format("{}: byte {}: {}", path_.string(), at, what));
    }

    std::string_view bytes_;
    const std::filesystem::path& path_;
    std::size_t at_ = 0;
};

/// -1 for a character that is none of the 64.
int base64_digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+' || c == '-') return 62;
    return c == '/' || c == '_' ? 63 : -1;
}

/// [RFC 4648, sections 4 and 5]
std::optional<std::string> decode_base64(std::string_view text) {
    while (text.ends_with('=')) text.remove_suffix(1);
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        const int digit = base64_digit(c);
        if (digit < 0) return std::nullopt;
        bits = bits << 6 | static_cast<std::uint32_t>(digit);
        count += 6;
        if (count >= 8) {
            count -= 8;
            bytes.push_back(static_cast<char>(bits >> count & 0xffu));
        }
    }
    return count == 6 ? std::nullopt : std::optional(std::move(bytes));
}

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

}  // namespace

GltfParts split_gltf(std::string bytes, const std::filesystem::path& path) {
    if (bytes.starts_with(kGlbMagic)) return GlbReader(bytes, path).run();
    if (bytes.starts_with("\xEF\xBB\xBF")) bytes.erase(0, 3);
    return {.text = std::move(bytes)};
}

std::optional<std::string> decode_data_uri(std::string_view uri) {
    constexpr std::string_view kMark = ";base64,";
    const std::size_t mark = uri.find(kMark);
    return mark == std::string_view::npos ? std::nullopt : decode_base64(uri.substr(mark + kMark.size()));
}

std::string decode_percent(std::string_view uri) {
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool has_two = uri[i] == '%' && i + 2 < uri.size();
        const int high = has_two ? hex_digit(uri[i + 1]) : -1;
        const int low = has_two ? hex_digit(uri[i + 2]) : -1;
        if (high < 0 || low < 0) {
            text += uri[i];
            continue;
        }
        text += static_cast<char>(16 * high + low);
        i += 2;
    }
    return text;
}

}  // namespace pl
