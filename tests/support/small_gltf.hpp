#pragma once

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "tests/support/read_mesh.hpp"

// A glTF 2 of a box of 2 by 1.5 by 2, area 20 and volume 6, whose parts tests change.

namespace small_gltf {

template <class T>
std::string bytes_of(const std::vector<T>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

inline std::string base64(const std::string& text) {
    constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < text.size(); i += 3) {
        unsigned three = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            three =
                three << 8 | (i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0u);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            out += k > text.size() - i ? '=' : letters[three >> (18 - 6 * k) & 63];
        }
    }
    return out;
}

inline std::vector<float> box_places() {
    std::vector<float> places;
    for (int k = 0; k < 8; ++k) {
        places.push_back((k & 1) != 0 ? 1.f : -1.f);
        places.push_back((k & 2) != 0 ? 1.5f : 0.f);
        places.push_back((k & 4) != 0 ? 1.f : -1.f);
    }
    return places;
}

inline std::vector<std::uint16_t> box_indices() {
    return {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
            1, 3, 7, 1, 7, 5, 3, 2, 6, 3, 6, 7, 2, 0, 4, 2, 4, 6};
}

/// An array of bytes, and what an accessor says of it.
struct Data {
    std::string bytes{};
    int component = 5126;  // float
    std::size_t count = 0;
    std::string type = "VEC3";
    std::string more{};  // of the accessor, with a comma before it
    std::size_t stride = 0;
};

struct Parts {
    std::string nodes = R"([{"mesh":0}])", top = "[0]";
    std::string primitive = R"({"attributes":{"POSITION":0},"indices":1})";
    std::string more{};  // at the top level, with a comma before it
    std::vector<Data> data{{bytes_of(box_places()), 5126, 8},
                           {bytes_of(box_indices()), 5123, 36, "SCALAR"}};
};

inline std::string text_of(const Parts& parts) {
    std::string buffer, views, accessors;
    for (std::size_t i = 0; i < parts.data.size(); ++i) {
        const Data& data = parts.data[i];
        while (buffer.size() % 4) buffer += '\0';
        views += fmt::format(R"({}{{"buffer":0,"byteOffset":{},"byteLength":{}{}}})", i ? "," : "",
                             buffer.size(), data.bytes.size(),
                             data.stride ? fmt::format(",\"byteStride\":{}", data.stride) : "");
        accessors +=
            fmt::format(R"({}{{"bufferView":{},"componentType":{},"count":{},"type":"{}"{}}})",
                        i ? "," : "", i, data.component, data.count, data.type, data.more);
        buffer += data.bytes;
    }
    return fmt::format(
        R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":{}}}],"nodes":{},)"
        R"("meshes":[{{"name":"box","primitives":[{}]}}],"accessors":[{}],"bufferViews":[{}],)"
        R"("buffers":[{{"byteLength":{},"uri":"data:application/octet-stream;base64,{}"}}]{}}})",
        parts.top, parts.nodes, parts.primitive, accessors, views, buffer.size(), base64(buffer),
        parts.more);
}

inline diurna::MeshFile read(const Parts& parts) {
    return read_mesh::file_of("a.gltf", text_of(parts));
}

}  // namespace small_gltf
