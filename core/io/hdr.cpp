// Radiance HDR: a text header, a line with the size and orientation, then scanlines of mantissas with a common
// exponent, plain or as run lengths.   [Ward, "The RADIANCE Picture File Format"; "Real Pixels", Graphics Gems II]
#include "core/io/image.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include <fmt/format.h>

#include "core/io/line_reader.h"
#include "core/io/primaries.h"

namespace pl {
namespace {

using Rgbe = std::array<std::uint8_t, 4>;

struct HdrLayout {
    int width = 0, height = 0;
    bool has_columns = false;     ///< scanlines are columns
    bool is_mirrored = false;     ///< from the right to the left
    bool is_upside_down = false;  ///< from the bottom to the top
};

/// Removes and returns the first line, without its end.
std::string_view take_header_line(std::string_view& rest) {
    const std::size_t end = rest.find('\n');
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

class HdrDecoder {
public:
    HdrDecoder(std::string_view bytes, const LinearSettings& settings) : rest_(bytes), settings_(settings) {}

    LinearImage run() {
        read_header();
        const HdrLayout layout = read_layout();
        const bool columns = layout.has_columns;
        const int lines = columns ? layout.width : layout.height;
        std::vector<Rgbe> line(static_cast<std::size_t>(columns ? layout.height : layout.width));
        std::vector<Rgbe> texels;  // grows with what the file has, whatever size its header says
        for (int i = 0; i < lines; ++i) {
            read_line(line);
            texels.insert(texels.end(), line.begin(), line.end());
        }
        LinearImage image = place(texels, layout);
        convert_to_srgb(primaries_, settings_, image);
        return image;
    }

private:
    [[noreturn]] void fail(const std::string& why) const { fail_image(settings_.path, why); }
    [[noreturn]] void fail_line() const { fail("damaged: truncated, or with an invalid scanline"); }

    void read_header() {
        double exposure = 1.0;
        bool corrects = false;
        for (std::string_view line = take_header_line(rest_); !line.empty(); line = take_header_line(rest_)) {
            const std::size_t equals = line.find('=');
            const std::string_view name = line.substr(0, equals);
            const auto values = split_words(equals == std::string_view::npos ? "" : line.substr(equals + 1));
            if (name == "FORMAT" && (values.empty() || values[0] != "32-bit_rle_rgbe"))
                fail(fmt::format("expected the format 32-bit_rle_rgbe, got {}",
                                 in_quotes(values.empty() ? "" : values[0])));
            if (name == "EXPOSURE" && !values.empty()) exposure *= parse_number(values[0]).value_or(1.0);
            if (name == "COLORCORR")
                for (const std::string_view value : values) corrects = corrects || parse_number(value) != 1.0;
            if (name == "PRIMARIES") read_primaries(values);
        }
        if (exposure != 1.0)
            settings_.note(fmt::format("its exposure of {:g} is left out: texels count as stored", exposure));
        if (corrects) settings_.note("its correction of colors is left out: texels count as stored");
    }

    void read_primaries(const std::vector<std::string_view>& words) {
        std::array<double, 8> xy{};
        bool is_whole = words.size() == xy.size();
        for (std::size_t i = 0; is_whole && i < xy.size(); ++i) {
            const std::optional<double> value = parse_number(words[i]);
            is_whole = value.has_value();
            xy[i] = value.value_or(0.0);
        }
        if (is_whole)
            primaries_ = {{xy[0], xy[1]}, {xy[2], xy[3]}, {xy[4], xy[5]}, {xy[6], xy[7]}};
        else
            settings_.note("expected eight numbers for its primaries: counted as those of sRGB");
    }

    /// "-Y HEIGHT +X WIDTH": the axis of scanlines first; signs say how the coordinates go on, y up and x to the right.
    HdrLayout read_layout() {
        const std::string_view line = take_header_line(rest_);
        const auto words = split_words(line);
        const auto is_axis = [](std::string_view word, char axis) {
            return word.size() == 2 && (word[0] == '+' || word[0] == '-') && word[1] == axis;
        };
        const std::size_t y = words.size() == 4 && is_axis(words[0], 'X') ? 2 : 0;
        const std::size_t x = 2 - y;
        std::optional<std::int64_t> width, height;
        if (words.size() == 4 && is_axis(words[x], 'X') && is_axis(words[y], 'Y')) {
            width = parse_integer(words[x + 1]);
            height = parse_integer(words[y + 1]);
        }
        if (!width || !height)
            fail(fmt::format("damaged: expected the size as in \"-Y HEIGHT +X WIDTH\", got {}", in_quotes(line)));
        settings_.require_size(settings_.path, *width, *height);
        return {.width = static_cast<int>(*width),
                .height = static_cast<int>(*height),
                .has_columns = y == 2,
                .is_mirrored = words[x][0] == '-',
                .is_upside_down = words[y][0] == '+'};
    }

    std::uint8_t take_byte() {
        if (rest_.empty()) fail_line();
        const auto byte = static_cast<std::uint8_t>(rest_.front());
        rest_.remove_prefix(1);
        return byte;
    }

    void read_line(std::vector<Rgbe>& texels) {
        constexpr std::size_t kMark = 4;  // 2, 2, and the width
        const auto byte = [&](std::size_t at) { return static_cast<std::uint8_t>(rest_[at]); };
        const bool is_coded = texels.size() >= 8 && texels.size() < 32768 && rest_.size() >= kMark && byte(0) == 2 &&
                              byte(1) == 2 && byte(2) < 128;
        if (!is_coded) return read_old_line(texels);
        if (static_cast<std::size_t>(byte(2) << 8 | byte(3)) != texels.size()) fail_line();
        rest_.remove_prefix(kMark);
        for (std::size_t channel = 0; channel < 4; ++channel) read_channel(texels, channel);
    }

    /// Runs of one channel: counts above 128 repeat a value.
    void read_channel(std::vector<Rgbe>& texels, std::size_t channel) {
        constexpr std::size_t kRun = 128;
        for (std::size_t done = 0; done < texels.size();) {
            const std::size_t code = take_byte();
            const std::size_t count = code > kRun ? code - kRun : code;
            if (count == 0 || count > texels.size() - done) fail_line();
            std::uint8_t value = code > kRun ? take_byte() : 0;
            for (std::size_t i = 0; i < count; ++i) {
                if (code <= kRun) value = take_byte();
                texels[done++][channel] = value;
            }
        }
    }

    /// Plain texels; the mantissas 1, 1, 1 repeat the one before, as often as the exponent says. Each such texel that
    /// directly follows another has the next eight bits of a count.
    void read_old_line(std::vector<Rgbe>& texels) {
        constexpr int kMostShift = 24;
        int shift = 0;
        for (std::size_t done = 0; done < texels.size();) {
            Rgbe texel;
            for (std::uint8_t& value : texel) value = take_byte();
            if (texel[0] != 1 || texel[1] != 1 || texel[2] != 1) {
                texels[done++] = texel;
                shift = 0;
                continue;
            }
            const std::size_t count = std::size_t{texel[3]} << shift;
            if (done == 0 || shift > kMostShift || count > texels.size() - done) fail_line();
            for (std::size_t i = 0; i < count; ++i, ++done) texels[done] = texels[done - 1];
            shift += 8;
        }
    }

    static glm::vec3 linear(const Rgbe& texel) {
        constexpr int kBias = 128 + 8;
        if (texel[3] == 0) return glm::vec3(0.0f);
        const float unit = std::ldexp(1.0f, texel[3] - kBias);
        return unit * glm::vec3(texel[0], texel[1], texel[2]);
    }

    static LinearImage place(const std::vector<Rgbe>& texels, const HdrLayout& layout) {
        const auto width = static_cast<std::size_t>(layout.width);
        const auto height = static_cast<std::size_t>(layout.height);
        LinearImage image{.width = layout.width, .height = layout.height, .pixels = {}};
        image.pixels.reserve(texels.size());
        for (std::size_t row = 0; row < height; ++row) {
            const std::size_t y = layout.is_upside_down ? height - 1 - row : row;
            for (std::size_t column = 0; column < width; ++column) {
                const std::size_t x = layout.is_mirrored ? width - 1 - column : column;
                image.pixels.push_back(linear(texels[layout.has_columns ? x * height + y : y * width + x]));
            }
        }
        return image;
    }

    std::string_view rest_;
    const LinearSettings& settings_;
    Primaries primaries_ = kSrgbPrimaries;
};

}  // namespace

LinearImage decode_hdr(std::string_view bytes, const LinearSettings& settings) {
    if (!bytes.starts_with("#?")) fail_image(settings.path, "not a Radiance HDR file");
    return HdrDecoder(bytes, settings).run();
}

}  // namespace pl
