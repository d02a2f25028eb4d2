#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "materials/base/error.hpp"
#include "terrain/objects/mesh_gate.hpp"
#include "terrain/objects/mesh_words.hpp"

namespace diurna {

namespace {

constexpr std::size_t head_bytes = 84, facet_bytes = 50;

void check_binary(const std::string& name, std::string_view text, std::size_t facets) {
    for (std::size_t i = 0; i < facets; ++i) {
        std::array<float, 12> value{};
        std::memcpy(value.data(), text.data() + head_bytes + facet_bytes * i, sizeof value);
        for (std::size_t k = 3; k < 12; ++k) {  // after the normal, which nobody reads
            if (std::abs(value[k]) <= most_coordinate) continue;  // false of NaN, too
            throw InputError(
                name, fmt::format("facet {} has a coordinate of {:g}", i + 1, double(value[k])));
        }
    }
}

void check_text(const std::string& name, std::string_view text) {
    MeshLines lines(name, text);
    int corners = -1;  // of the facet; none has begun
    bool ended = true;
    while (lines.next()) {
        const auto& words = lines.words();
        if (words.empty()) continue;
        if (words[0] == "solid") ended = false;
        if (words[0] == "endsolid") ended = true;
        if (words[0] == "facet") corners = 0;
        if (words[0] == "vertex") {
            if (words.size() != 4) {
                throw InputError(lines.where(), fmt::format("found a vertex of {} numbers, "
                                                            "expected 3",
                                                            words.size() - 1));
            }
            for (std::size_t i = 1; i < 4; ++i) lines.coordinate(words[i]);
            ++corners;
        }
        if (words[0] == "endfacet") {
            if (corners != 3) {
                throw InputError(lines.where(),
                                 fmt::format("found a facet of {} corners, expected 3", corners));
            }
            corners = -1;
        }
    }
    if (corners >= 0 || !ended) throw InputError(name, "ends within a solid", "is it whole?");
}

}  // namespace

void check_stl(const std::string& name, std::string_view text) {
    std::uint32_t facets = 0;
    if (text.size() >= head_bytes) std::memcpy(&facets, text.data() + 80, sizeof facets);
    if (text.size() >= head_bytes && head_bytes + facet_bytes * facets == text.size()) {
        check_binary(name, text, facets);
        return;
    }
    const std::size_t begin = text.find_first_not_of(" \t\r\n");
    if (begin != std::string_view::npos && text.substr(begin).starts_with("solid")) {
        check_text(name, text);
        return;
    }
    throw InputError(
        name, text.size() < head_bytes
                  ? fmt::format("has {} bytes, fewer than the head of an STL file", text.size())
                  : fmt::format("claims {} facets, its {} bytes hold {}", facets, text.size(),
                                (text.size() - head_bytes) / facet_bytes));
}

}  // namespace diurna
