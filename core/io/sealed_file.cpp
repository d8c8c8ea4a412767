#include "core/io/sealed_file.h"

#include <fmt/ranges.h>

#include "core/base/hash.h"
#include "core/io/files.h"

namespace pl {
namespace {

constexpr std::size_t kMagicBytes = 8;
constexpr std::size_t kSizeOffset = kMagicBytes + sizeof(std::uint32_t);
constexpr std::size_t kPrefixBytes = kSizeOffset + sizeof(std::uint64_t);
constexpr std::size_t kChecksumBytes = sizeof(std::uint64_t);

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& why) {
    throw Error(ErrorKind::Input, fmt::format("{}: {}", path.string(), why));
}

std::uint64_t checksum_of(std::string_view bytes) {
    Fnv1a hash;
    hash.add(bytes);
    return hash.value();
}

}  // namespace

BinaryWriter begin_sealed(const SealedKind& kind) {
    BinaryWriter writer;
    writer.raw(kind.magic);
    writer.number(kind.version);
    writer.number(std::uint64_t{0});
    return writer;
}

void write_sealed(const std::filesystem::path& path, BinaryWriter writer) {
    writer.patch(kSizeOffset, writer.bytes().size() + kChecksumBytes);
    writer.number(checksum_of(writer.bytes()));
    write_file_atomic(path, writer.bytes());
}

std::string_view sealed_content(std::string_view bytes, const std::filesystem::path& path, const SealedKind& kind) {
    if (!bytes.starts_with(kind.magic))
        fail(path, fmt::format("not a {}: expected a file that begins with {}, got {:02x}", kind.title,
                               kind.magic.substr(0, kMagicBytes - 1), fmt::join(bytes.substr(0, kMagicBytes), " ")));
    if (bytes.size() < kPrefixBytes + kChecksumBytes)
        fail_damaged(path, kind.word,
                     fmt::format("expected at least {} bytes, got {}", kPrefixBytes + kChecksumBytes, bytes.size()));
    BinaryReader prefix(bytes.substr(kMagicBytes), path, kind.word);
    std::uint32_t version = 0;
    prefix.number(version);
    if (version != kind.version)
        fail(path, fmt::format("{} of another version: expected {}, got {}", kind.title, kind.version, version));
    std::uint64_t size = 0;
    prefix.number(size);
    if (size != bytes.size())
        fail_damaged(path, kind.word, fmt::format("expected {} bytes, got {}", size, bytes.size()));
    const std::string_view guarded = bytes.substr(0, bytes.size() - kChecksumBytes);
    std::uint64_t checksum = 0;
    BinaryReader(bytes.substr(guarded.size()), path, kind.word).number(checksum);
    if (checksum != checksum_of(guarded))
        fail_damaged(path, kind.word,
                     fmt::format("expected the checksum {:016x}, got {:016x}", checksum, checksum_of(guarded)));
    return guarded.substr(kPrefixBytes);
}

}  // namespace pl
