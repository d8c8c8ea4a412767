// Small glTF files, made member by member.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "core/io/json_file.h"

namespace pl::test {

inline std::string base64(const std::string& bytes) {
    constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = i; k < i + 3; ++k)
            bits = bits << 8 | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : kDigits[bits >> (18 - 6 * k) & 63u];
    }
    return text;
}

template <class Number>
std::string bytes_of(const std::vector<Number>& values) {
    std::string bytes(values.size() * sizeof(Number), '\0');
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

/// The JSON, which tests may change, and one buffer.
class GltfMaker {
public:
    GltfMaker() { root["asset"]["version"] = "2.0"; }

    Json root;
    std::string buffer;

    /// Index of a new buffer view of these bytes, at a multiple of four.
    int view(const std::string& bytes) {
        buffer.resize((buffer.size() + 3) / 4 * 4);
        root["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}});
        buffer += bytes;
        return static_cast<int>(root["bufferViews"].size()) - 1;
    }
    int accessor(Json members) {
        root["accessors"].push_back(std::move(members));
        return static_cast<int>(root["accessors"].size()) - 1;
    }
    template <class Number>
    int numbers(const std::vector<Number>& values, int component_type, const std::string& type, std::size_t count) {
        return accessor({{"bufferView", view(bytes_of(values))},
                         {"componentType", component_type},
                         {"type", type},
                         {"count", count}});
    }
    int vec3(const std::vector<float>& values) { return numbers(values, 5126, "VEC3", values.size() / 3); }
    int vec2(const std::vector<float>& values) { return numbers(values, 5126, "VEC2", values.size() / 2); }
    int indices(const std::vector<std::uint16_t>& values) { return numbers(values, 5123, "SCALAR", values.size()); }

    /// Adds a mesh of one primitive; returns its index.
    int mesh(Json primitive) {
        root["meshes"].push_back({{"primitives", Json::array({std::move(primitive)})}});
        return static_cast<int>(root["meshes"].size()) - 1;
    }
    /// Adds a node; all nodes are in the scene as long as the file has no scenes.
    int node(Json members) {
        root["nodes"].push_back(std::move(members));
        return static_cast<int>(root["nodes"].size()) - 1;
    }
    /// A node with the triangle (0,0,0) (1,0,0) (0,1,0), with texture coordinates, of a material.
    void triangle(Json material = nullptr) {
        Json primitive{{"attributes",
                        {{"POSITION", vec3({0, 0, 0, 1, 0, 0, 0, 1, 0})}, {"TEXCOORD_0", vec2({0, 0, 1, 0, 0, 1})}}}};
        if (!material.is_null()) {
            root["materials"].push_back(std::move(material));
            primitive["material"] = root["materials"].size() - 1;
        }
        node({{"mesh", mesh(std::move(primitive))}});
    }

    /// A .gltf with the buffer in its text.
    std::string text() const {
        Json file = root;
        if (!buffer.empty() && !file.contains("buffers"))
            file["buffers"] = {
                {{"byteLength", buffer.size()}, {"uri", "data:application/octet-stream;base64," + base64(buffer)}}};
        return file.dump(1);
    }
    /// The same as a .glb.
    std::string glb() const {
        Json file = root;
        file["buffers"] = {{{"byteLength", buffer.size()}}};
        std::string json = file.dump();
        json.resize((json.size() + 3) / 4 * 4, ' ');
        std::string binary = buffer;
        binary.resize((binary.size() + 3) / 4 * 4);
        const auto word = [](std::size_t value) { return bytes_of(std::vector{static_cast<std::uint32_t>(value)}); };
        return "glTF" + word(2) + word(12 + 8 + json.size() + 8 + binary.size()) + word(json.size()) + "JSON" + json +
               word(binary.size()) + std::string("BIN\0", 4) + binary;
    }
};

}  // namespace pl::test
