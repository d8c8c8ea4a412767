// Fnv1a: files and pictures hold its values, which must not change.
#include "core/base/hash.h"

#include <random>
#include <string>

#include "tests/support/catch.hpp"

using namespace pl;

namespace {

/// As published: byte by byte.   [Fowler, Noll, Vo, "FNV-1a", 64 bit]
std::uint64_t by_bytes(const std::string& bytes) {
    std::uint64_t state = 0xcbf29ce484222325u;
    for (const char byte : bytes) state = (state ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
    return state;
}

std::string bytes_of(std::uint64_t value) {
    std::string bytes;
    for (int i = 0; i < 8; ++i) bytes.push_back(static_cast<char>(value >> (8 * i)));
    return bytes;
}

}  // namespace

TEST_CASE("FNV-1a: published values") {
    CHECK(by_bytes("") == 0xcbf29ce484222325u);
    CHECK(by_bytes("a") == 0xaf63dc4c8601ec8cu);
    CHECK(by_bytes("foobar") == 0x85944171f73967e8u);
}

TEST_CASE("FNV-1a: numbers are their eight bytes, however many of them are 0") {
    std::mt19937_64 random(1);
    Fnv1a hash;
    std::string bytes;
    for (int i = 0; i < 1000; ++i) {
        const std::uint64_t value = i % 9 == 0 ? 0 : random() >> (8 * (i % 8));
        hash.add(value);
        bytes += bytes_of(value);
        REQUIRE(hash.value() == by_bytes(bytes));
    }
}

TEST_CASE("FNV-1a: -0 counts as 0, and a text begins with its length") {
    Fnv1a plus, minus, text;
    plus.add(0.0f);
    minus.add(-0.0f);
    CHECK(plus.value() == minus.value());
    CHECK(plus.value() == by_bytes(bytes_of(0)));
    text.add(std::string_view("ab"));
    CHECK(text.value() == by_bytes(bytes_of(2) + "ab"));
}
