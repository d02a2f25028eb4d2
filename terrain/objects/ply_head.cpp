#include "terrain/objects/ply_head.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "materials/base/error.hpp"

namespace diurna {

namespace {

PlyType type_named(const MeshLines& lines, std::string_view word) {
    static const std::map<std::string_view, PlyType> named{
        {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
        {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
        {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
        {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
        {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
        {"float64", PlyType::float64}};
    const auto found = named.find(word);
    if (found != named.end()) return found->second;
    throw InputError(
        lines.where(),
        fmt::format("found type '{}', expected a PLY type such as float", word.substr(0, 40)));
}

PlyProperty read_property(const MeshLines& lines, const std::string& element) {
    const auto& words = lines.words();
    const bool list = words.size() == 5 && is_keyword(words[1], "list");
    if (!list && words.size() != 3) {
        throw InputError(lines.where(),
                         "expected property TYPE NAME, or property list TYPE TYPE "
                         "NAME");
    }
    PlyProperty property{.name = std::string(words.back()),
                         .type = type_named(lines, words[list ? 3 : 1]),
                         .list = list};
    if (list) property.count = type_named(lines, words[2]);
    const std::string& name = property.name;
    if (element == "vertex" && !list && name.size() == 1 && name[0] >= 'x' && name[0] <= 'z') {
        property.axis = name[0] - 'x';
    }
    property.corners =
        element == "face" && list && (name == "vertex_indices" || name == "vertex_index");
    property.strip =
        element == "tristrips" && list && (name == "vertex_indices" || name == "vertex_index");
    return property;
}

/// Reads on to the line end_header.
PlyHead read_lines_of_head(MeshLines& lines, std::size_t bytes) {
    PlyHead head;
    bool format = false;
    if (!lines.next() || lines.words().size() != 1 || lines.words()[0] != "ply") {
        throw InputError(lines.where(), "expected a line 'ply'");
    }
    while (lines.next()) {
        const auto& words = lines.words();
        if (words.empty() || is_keyword(words[0], "comment") || is_keyword(words[0], "obj_info"))
            continue;
        if (is_keyword(words[0], "end_header")) {
            if (!format) throw InputError(lines.where(), "no line 'format' before it");
            return head;
        }
        if (is_keyword(words[0], "format") && words.size() == 3) {
            head.text = words[1] == "ascii";
            head.big = words[1] == "binary_big_endian";
            format = head.text || head.big || words[1] == "binary_little_endian";
            if (!format) {
                throw InputError(lines.where(), fmt::format("found format '{}'", words[1]),
                                 "ascii, binary_little_endian or binary_big_endian");
            }
        } else if (is_keyword(words[0], "element") && words.size() == 3) {
            const long long rows = lines.whole(words[2]);
            if (rows < 0 || std::size_t(rows) > bytes) {
                throw InputError(lines.where(),
                                 fmt::format("declares {} {}, but the file has only {} bytes", rows,
                                             words[1], bytes));
            }
            for (const PlyElement& other : head.element) {
                if (other.name != words[1]) continue;
                throw InputError(lines.where(),
                                 fmt::format("element {} occurs twice", words[1].substr(0, 40)));
            }
            head.element.push_back({std::string(words[1]), std::size_t(rows), {}});
            if (words[1] == "vertex") head.vertices = rows;
        } else if (is_keyword(words[0], "property") && !head.element.empty()) {
            PlyElement& element = head.element.back();
            element.property.push_back(read_property(lines, element.name));
        } else {
            throw InputError(lines.where(), fmt::format("found '{}' in the head of a PLY file",
                                                        words[0].substr(0, 40)));
        }
    }
    throw InputError(lines.where(), "no line 'end_header'");
}

/// Vertices have a place and faces corners.
void check_head(const std::string& name, const PlyHead& head) {
    const auto with = [&](const char* element, auto&& is) {
        std::ptrdiff_t count = 0;
        for (const PlyElement& e : head.element) {
            if (e.name != element) continue;
            count += std::count_if(e.property.begin(), e.property.end(), is);
        }
        return count;
    };
    if (with("vertex", [](const PlyProperty& p) { return p.axis >= 0; }) != 3) {
        throw InputError(name, "its vertices do not have x, y and z exactly once");
    }
    const auto faces = with("face", [](const PlyProperty&p) { return p.corners; }),
               strips = with("tristrips", [](const PlyProperty&p) { return p.strip; });
    if (faces + strips == 1) return;
    const bool has_faces = std::any_of(head.element.begin(), head.element.end(),
                                       [](const PlyElement& e) { return e.name == "face"; });
    if (!has_faces) {
        throw InputError(name, "has points but no faces (a point cloud), expected a mesh",
                         "make a surface first, for example with MeshLab or CloudCompare; for "
                         "ground make a raster with pdal writers.gdal");
    }
    throw InputError(name, "its faces do not have exactly one list vertex_indices",
                     "expected property list uchar int vertex_indices");
}

}  // namespace

PlyHead read_ply_head(const std::string& name, MeshLines& lines, std::size_t bytes) {
    PlyHead head = read_lines_of_head(lines, bytes);
    check_head(name, head);
    return head;
}

std::size_t bytes_of(PlyType type) {
    constexpr std::size_t size[] = {1, 1, 2, 2, 4, 4, 4, 8};
    return size[std::size_t(type)];
}

}  // namespace diurna
