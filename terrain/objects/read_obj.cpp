#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "materials/base/error.hpp"
#include "terrain/objects/mesh_builder.hpp"
#include "terrain/objects/mesh_readers.hpp"
#include "terrain/objects/mesh_words.hpp"

namespace diurna {

namespace {

/// Vertices, texture places and normals: what the three numbers of a corner count.
using Counts = std::array<long long, 3>;
constexpr std::array counted{"vertices", "texture places", "normals"};
constexpr long long most_index = 0xffffffff;
constexpr const char* no_group = "defaultobject";  // of faces above any line g or o

/// Of each kind the greatest number that a face has asked for so far, and its line: what it asks
/// for may stand below it.
struct Asked {
    Counts most{};
    std::array<std::string, 3> where;
};

/// Returns the number from 0, which may be of something below.
std::uint32_t read_index(const MeshLines& lines, std::string_view word, std::size_t kind,
                         const Counts& have, Asked& asked) {
    const long long index = lines.whole(word);
    if (index == 0 || -index > have[kind]) {
        throw InputError(lines.where(), fmt::format("found index {}, expected 1 to the number of "
                                                    "{}, or -1 to -{}",
                                                    index, counted[kind], have[kind]));
    }
    if (index > asked.most[kind]) {
        if (index > most_index)
            throw InputError(lines.where(), fmt::format("found index {}", index));
        asked.most[kind] = index;
        if (index > have[kind]) asked.where[kind] = lines.where();
    }
    return static_cast<std::uint32_t>(index < 0 ? have[kind] + index : index - 1);
}

/// "7", "7/2", "7//3" or "7/2/3"; returns its vertex.
std::uint32_t read_corner(const MeshLines& lines, std::string_view word, const Counts& have,
                          Asked& asked) {
    std::uint32_t vertex = 0;
    for (std::size_t kind = 0;; ++kind) {
        const std::size_t slash = std::min(word.find('/'), word.size());
        const bool left_out = slash == 0 && kind > 0;
        if (kind > 2) throw InputError(lines.where(), "found a corner of more than three indices");
        if (!left_out) {
            const std::uint32_t index = read_index(lines, word.substr(0, slash), kind, have, asked);
            if (kind == 0) vertex = index;
        }
        if (slash == word.size()) return vertex;
        word.remove_prefix(slash + 1);
    }
}

Eigen::Vector3d read_place(const MeshLines& lines) {
    const auto& words = lines.words();
    if (words.size() < 4 || words.size() > 8) {
        throw InputError(lines.where(),
                         fmt::format("found a vertex of {} numbers, expected 3", words.size() - 1));
    }
    std::array<double, 8> number{};
    for (std::size_t i = 1; i < words.size(); ++i) number[i] = lines.coordinate(words[i]);
    return {number[1], number[2], number[3]};
}

/// The words of a line behind the first, as one name.
std::string name_of(const MeshLines& lines) {
    std::string name;
    for (std::size_t i = 1; i < lines.words().size(); ++i) {
        if (i > 1) name += ' ';
        name += lines.words()[i];
    }
    return name;
}

/// Faces as they stand in the file; their vertices may stand below them.
struct Faces {
    std::vector<std::uint32_t> corner;
    struct Face {
        std::size_t end;  // in `corner`; begins where the one before ends
        std::size_t line;
        std::uint16_t part;
    };
    std::vector<Face> face;
};

}  // namespace

MeshFile read_obj(const std::string& name, std::string_view text) {
    MeshLines lines(name, text);
    MeshBuilder mesh(name);
    Counts have{};
    Asked asked;
    std::vector<Eigen::Vector3d> place;
    Faces faces;
    std::string group = no_group, material;
    std::uint16_t part = 0;
    bool named = false;  // `part` is of group and material
    while (lines.next()) {
        const auto& words = lines.words();
        // Names may have a '#' in them, data cannot.
        const bool named_line =
            !words.empty() && (words[0] == "g" || words[0] == "o" || words[0] == "usemtl");
        if (!named_line) lines.drop_comment();
        if (words.empty()) continue;
        if (words[0] == "v") {
            place.push_back(read_place(lines));
            ++have[0];
        } else if (words[0] == "vt" || words[0] == "vn") {
            for (std::size_t i = 1; i < std::min<std::size_t>(words.size(), 4); ++i) {
                lines.coordinate(words[i]);
            }
            ++have[words[0] == "vt" ? 1 : 2];
        } else if (words[0] == "f") {
            if (words.size() < 4 || words.size() > most_corners + 1) {
                throw InputError(lines.where(),
                                 fmt::format("found a face of {} corners, expected 3 to {}",
                                             words.size() - 1, most_corners));
            }
            if (!named) part = mesh.part(group, material);
            named = true;
            for (std::size_t i = 1; i < words.size(); ++i) {
                faces.corner.push_back(read_corner(lines, words[i], have, asked));
            }
            faces.face.push_back({faces.corner.size(), lines.line(), part});
        } else if (words[0] == "g" || words[0] == "o" || words[0] == "usemtl") {
            (words[0] == "usemtl" ? material : group) = name_of(lines);
            named = false;
        } else if (words[0] == "curv" || words[0] == "surf") {
            mesh.note("free-form curves and surfaces of its mesh are skipped");
        }
    }
    for (std::size_t kind = 0; kind < counted.size(); ++kind) {
        if (asked.most[kind] <= have[kind]) continue;
        throw InputError(asked.where[kind],
                         fmt::format("found index {}, but the file has {} {}", asked.most[kind],
                                     have[kind], counted[kind]));
    }
    std::vector<std::uint32_t> corner;
    std::size_t at = 0;
    for (const auto& [end, line, of] : faces.face) {
        corner.clear();
        for (; at < end; ++at) corner.push_back(mesh.vertex(place[faces.corner[at]]));
        mesh.polygon(corner, of, fmt::format("line {}", line));
    }
    return mesh.finish();
}

}  // namespace diurna
