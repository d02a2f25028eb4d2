#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "materials/base/error.hpp"
#include "terrain/objects/mesh_builder.hpp"
#include "terrain/objects/mesh_readers.hpp"
#include "terrain/objects/mesh_words.hpp"

namespace diurna {

namespace {

constexpr std::size_t head_bytes = 84, facet_bytes = 50;

MeshFile read_binary(const std::string& name, std::string_view text, std::size_t facets) {
    MeshBuilder mesh(name);
    const std::uint16_t part = mesh.part("", "");
    double largest = 0.0;
    for (std::size_t i = 0; i < facets; ++i) {
        std::array<float, 12> value{};
        std::memcpy(value.data(), text.data() + head_bytes + facet_bytes * i, sizeof value);
        for (std::size_t k = 3; k < 12; ++k) {  // after the normal, which is not used
            const double number = std::abs(double(value[k]));
            largest = std::max(largest, number);
            if (number <= most_coordinate) continue;  // false of NaN, too
            throw InputError(
                name, fmt::format("facet {} has a coordinate of {:g}", i + 1, double(value[k])));
        }
        const auto vertex = [&](std::size_t k) {
            return mesh.vertex({double(value[k]), double(value[k + 1]), double(value[k + 2])});
        };
        const std::uint32_t a = vertex(3), b = vertex(6), c = vertex(9);
        mesh.triangle({a, b, c}, part);
    }
    mesh.stored_as_float(largest);
    return mesh.finish();
}

MeshFile read_text_stl(const std::string& name, std::string_view text) {
    MeshLines lines(name, text);
    MeshBuilder mesh(name);
    std::string solid;
    std::array<std::uint32_t, 3> corner{};
    int corners = -1;  // of the facet; none has begun
    bool ended = true;
    while (lines.next()) {
        const auto& words = lines.words();
        if (words.empty()) continue;
        if (is_keyword(words[0], "solid")) {
            ended = false;
            solid = words.size() > 1 ? std::string(words[1]) : "";
        }
        if (is_keyword(words[0], "endsolid")) ended = true;
        if (is_keyword(words[0], "facet")) corners = 0;
        if (is_keyword(words[0], "vertex")) {
            if (words.size() != 4) {
                throw InputError(lines.where(), fmt::format("found a vertex of {} numbers, "
                                                            "expected 3",
                                                            words.size() - 1));
            }
            const double x = lines.coordinate(words[1]), y = lines.coordinate(words[2]),
                         z = lines.coordinate(words[3]);
            if (corners >= 0 && corners < 3) corner[std::size_t(corners)] = mesh.vertex({x, y, z});
            ++corners;
        }
        if (is_keyword(words[0], "endfacet")) {
            if (corners != 3) {
                throw InputError(lines.where(),
                                 fmt::format("found a facet of {} corners, expected 3", corners));
            }
            corners = -1;
            mesh.triangle(corner, mesh.part(solid, ""));
        }
    }
    if (corners >= 0 || !ended)
        throw InputError(name, "ends within a solid", "copy the file again");
    return mesh.finish();
}

}  // namespace

MeshFile read_stl(const std::string& name, std::string_view text) {
    std::uint32_t facets = 0;
    if (text.size() >= head_bytes) std::memcpy(&facets, text.data() + 80, sizeof facets);
    if (text.size() >= head_bytes && head_bytes + facet_bytes * facets == text.size()) {
        return read_binary(name, text, facets);
    }
    const std::size_t begin = text.find_first_not_of(" \t\r\n");
    if (begin != std::string_view::npos && is_keyword(text.substr(begin, 5), "solid")) {
        return read_text_stl(name, text);
    }
    throw InputError(name,
                     text.size() < head_bytes
                         ? fmt::format("has {} bytes, less than an STL header", text.size())
                         : fmt::format("declares {} facets, but its {} bytes contain {}", facets,
                                       text.size(), (text.size() - head_bytes) / facet_bytes));
}

}  // namespace diurna
