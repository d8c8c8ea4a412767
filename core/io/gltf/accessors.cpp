#include "core/io/gltf/accessors.h"

#include <array>
#include <cmath>
#include <cstring>
#include <type_traits>

#include <fmt/format.h>

#include "core/io/line_reader.h"

namespace pl {
namespace {

constexpr std::uint64_t kMostElements32 = 0xffffffffu;

enum class ComponentType : std::uint32_t {
    Int8 = 5120,
    Uint8 = 5121,
    Int16 = 5122,
    Uint16 = 5123,
    Uint32 = 5125,
    Float32 = 5126
};

std::size_t size_of(ComponentType type) {
    switch (type) {
    case ComponentType::Int8:
    case ComponentType::Uint8: return 1;
    case ComponentType::Int16:
    case ComponentType::Uint16: return 2;
    case ComponentType::Uint32:
    case ComponentType::Float32: break;
    }
    return 4;
}

ComponentType component_type(const GltfFile& file, const std::string& pointer) {
    const auto type = static_cast<ComponentType>(file.whole(pointer, 0, 5120, 5126));
    constexpr std::uint32_t kNotUsed = 5124;
    if (static_cast<std::uint32_t>(type) == kNotUsed)
        file.fail(pointer, "expected 5120, 5121, 5122, 5123, 5125 or 5126, got 5124");
    return type;
}

std::size_t components_of(std::string_view type) {
    struct Known {
        std::string_view type;
        std::size_t components;
    };
    constexpr std::array<Known, 5> kKnown = {{{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}}};
    for (const Known& known : kKnown)
        if (known.type == type) return known.components;
    return 0;
}

template <class Stored>
Stored load(const char* at) {
    Stored value;
    std::memcpy(&value, at, sizeof value);
    return value;
}

/// [glTF 2.0, section 3.11]
template <class Stored>
float normalized(Stored value) {
    const float scaled = static_cast<float>(value) / static_cast<float>(std::numeric_limits<Stored>::max());
    return std::max(scaled, -1.0f);
}

template <class Number, class Stored>
Number convert(Stored value, bool is_normalized) {
    if constexpr (std::is_same_v<Number, float> && std::is_integral_v<Stored>)
        return is_normalized ? normalized(value) : static_cast<float>(value);
    else
        return static_cast<Number>(value);
}

/// Elements in bytes of the file: `size` bytes each, `stride` bytes apart.
struct Elements {
    std::string_view bytes;
    std::uint64_t count;
    std::size_t components;
    ComponentType type;
    std::size_t stride;
    bool is_normalized;

    template <class Number, class Stored>
    void read_as(std::vector<Number>& to) const {
        for (std::uint64_t i = 0; i < count; ++i) {
            const char* const at = bytes.data() + i * stride;
            for (std::size_t c = 0; c < components; ++c)
                to.push_back(convert<Number>(load<Stored>(at + c * sizeof(Stored)), is_normalized));
        }
    }

    template <class Number>
    std::vector<Number> read() const {
        std::vector<Number> to;
        to.reserve(count * components);
        switch (type) {
        case ComponentType::Int8: read_as<Number, std::int8_t>(to); break;
        case ComponentType::Uint8: read_as<Number, std::uint8_t>(to); break;
        case ComponentType::Int16: read_as<Number, std::int16_t>(to); break;
        case ComponentType::Uint16: read_as<Number, std::uint16_t>(to); break;
        case ComponentType::Uint32: read_as<Number, std::uint32_t>(to); break;
        case ComponentType::Float32: read_as<Number, float>(to); break;
        }
        return to;
    }
};

/// Reads one accessor.
class AccessorReader {
public:
    AccessorReader(GltfFile& file, std::uint32_t accessor, std::string_view type)
        : file_(file), at_(fmt::format("/accessors/{}", accessor)), count_(accessor_count(file, accessor)),
          components_(components_of(type)), type_(component_type(file, at_ + "/componentType")),
          is_normalized_(file.json().boolean(at_ + "/normalized").value_or(false)) {
        if (const std::string got = accessor_type(file, accessor); got != type)
            file.fail(at_ + "/type", fmt::format("expected {} for this use, got {}", type, in_quotes(got)));
    }

    ComponentType type() const { return type_; }

    template <class Number>
    std::vector<Number> read() {
        std::vector<Number> values = base<Number>();
        if (file_.json().has(at_ + "/sparse")) replace(values);
        return values;
    }

    [[noreturn]] void fail(const std::string& what) const { file_.fail(at_, what); }

private:
    template <class Number>
    std::vector<Number> base() {
        const std::optional<std::uint32_t> view = file_.index(at_ + "/bufferView", "bufferViews");
        if (!view) {
            if (count_ > kMostZeroElements) {
                file_.fail(at_ + "/count", fmt::format("expected at most {} elements without a buffer view, got {}",
                                                       kMostZeroElements, count_));
            }
            return std::vector<Number>(count_ * components_, Number{0});
        }
        const std::uint64_t offset = file_.whole(at_ + "/byteOffset", 0, 0, kMostElements32);
        const std::size_t size = components_ * size_of(type_);
        const std::size_t stride = file_.view_stride(*view);
        return elements(at_, *view, offset,
                        {{}, count_, components_, type_, stride == 0 ? size : stride, is_normalized_})
            .template read<Number>();
    }

    /// The elements with their bytes, if these are inside of the view.
    Elements elements(const std::string& at, std::uint32_t view, std::uint64_t offset, Elements wanted) {
        const std::string_view bytes = file_.view_bytes(view);
        const std::size_t size = wanted.components * size_of(wanted.type);
        const std::uint64_t end = offset + (wanted.count - 1) * wanted.stride + size;
        if (end > bytes.size()) {
            file_.fail(at,
                       fmt::format("expected at most the {} bytes of its buffer view, got {} elements up to byte {}",
                                   bytes.size(), wanted.count, end));
        }
        wanted.bytes = bytes.substr(offset);
        return wanted;
    }

    /// Replaces the elements that `sparse` lists.
    template <class Number>
    void replace(std::vector<Number>& values) {
        const std::string at = at_ + "/sparse";
        const std::uint64_t count = file_.whole(at + "/count", 0, 1, count_);
        const auto part = [&](const std::string& of, std::size_t components, ComponentType type, bool normalized) {
            const std::uint32_t view = file_.required_index(of + "/bufferView", "bufferViews");
            const std::uint64_t offset = file_.whole(of + "/byteOffset", 0, 0, kMostElements32);
            return elements(of, view, offset, {{}, count, components, type, components * size_of(type), normalized});
        };
        const ComponentType index_type = component_type(file_, at + "/indices/componentType");
        if (index_type == ComponentType::Float32)
            file_.fail(at + "/indices/componentType", "expected an unsigned integer, got 5126");
        const auto indices = part(at + "/indices", 1, index_type, false).template read<std::uint32_t>();
        const auto replaced = part(at + "/values", components_, type_, is_normalized_).template read<Number>();
        for (std::size_t i = 0; i < indices.size(); ++i) {
            if (indices[i] >= count_)
                file_.fail(at + "/indices", fmt::format("expected indices below {}, got {}", count_, indices[i]));
            std::copy_n(replaced.begin() + static_cast<std::ptrdiff_t>(i * components_), components_,
                        values.begin() + static_cast<std::ptrdiff_t>(indices[i] * components_));
        }
    }

    GltfFile& file_;
    std::string at_;
    std::uint64_t count_;
    std::size_t components_;
    ComponentType type_;
    bool is_normalized_;
};

}  // namespace

std::uint64_t accessor_count(const GltfFile& file, std::uint32_t accessor) {
    return file.whole(fmt::format("/accessors/{}/count", accessor), 0, 1, kMostElements32);
}

std::string accessor_type(const GltfFile& file, std::uint32_t accessor) {
    return file.json().text(fmt::format("/accessors/{}/type", accessor)).value_or("none");
}

std::vector<float> read_floats(GltfFile& file, std::uint32_t accessor, std::string_view type) {
    AccessorReader reader(file, accessor, type);
    std::vector<float> values = reader.read<float>();
    const auto bad = std::find_if(values.begin(), values.end(), [](float value) { return !std::isfinite(value); });
    if (bad != values.end())
        reader.fail(fmt::format("expected finite numbers, got {} as component {}", *bad, bad - values.begin()));
    return values;
}

std::vector<std::uint32_t> read_integers(GltfFile& file, std::uint32_t accessor, std::string_view type) {
    AccessorReader reader(file, accessor, type);
    if (reader.type() != ComponentType::Uint8 && reader.type() != ComponentType::Uint16 &&
        reader.type() != ComponentType::Uint32) {
        reader.fail(fmt::format("expected unsigned integers (5121, 5123, 5125), got the component type {}",
                                static_cast<std::uint32_t>(reader.type())));
    }
    return reader.read<std::uint32_t>();
}

}  // namespace pl
