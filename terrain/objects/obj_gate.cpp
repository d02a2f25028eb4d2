#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "materials/base/error.hpp"
#include "terrain/objects/mesh_gate.hpp"
#include "terrain/objects/mesh_words.hpp"

namespace diurna {

namespace {

/// Vertices, texture places and normals: what the three numbers of a corner count.
using Counts = std::array<long long, 3>;
constexpr std::array kinds{"vertices", "texture places", "normals"};

/// Of each kind the greatest number that a face has asked for so far, and its line: what it asks
/// for may stand below it.
struct Asked {
    Counts most{};
    std::array<std::string, 3> where;
};

void check_index(const MeshLines& lines, std::string_view word, std::size_t kind,
                 const Counts& have, Asked& asked) {
    const long long index = lines.whole(word);
    if (index == 0 || -index > have[kind]) {
        throw InputError(lines.where(), fmt::format("found index {}, expected 1 to the number of "
                                                    "{}, or -1 to -{}",
                                                    index, kinds[kind], have[kind]));
    }
    if (index <= asked.most[kind]) return;
    asked.most[kind] = index;
    if (index > have[kind]) asked.where[kind] = lines.where();
}

/// "7", "7/2", "7//3" or "7/2/3"
void check_corner(const MeshLines& lines, std::string_view word, const Counts& have, Asked& asked) {
    for (std::size_t kind = 0;; ++kind) {
        const std::size_t slash = std::min(word.find('/'), word.size());
        const bool left_out = slash == 0 && kind > 0;
        if (kind > 2) throw InputError(lines.where(), "a corner of more than three indices");
        if (!left_out) check_index(lines, word.substr(0, slash), kind, have, asked);
        if (slash == word.size()) return;
        word.remove_prefix(slash + 1);
    }
}

void check_place(const MeshLines& lines) {
    const auto& words = lines.words();
    if (words.size() < 4 || words.size() > 8) {
        throw InputError(lines.where(),
                         fmt::format("found a vertex of {} numbers, expected 3", words.size() - 1));
    }
    for (std::size_t i = 1; i < words.size(); ++i) lines.coordinate(words[i]);
}

}  // namespace

void check_obj(const std::string& name, std::string_view text) {
    MeshLines lines(name, text);
    Counts have{};
    Asked asked;
    while (lines.next()) {
        const auto& words = lines.words();
        if (words.empty()) continue;
        if (words[0] == "v") {
            check_place(lines);
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
            for (std::size_t i = 1; i < words.size(); ++i) {
                check_corner(lines, words[i], have, asked);
            }
        }
    }
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
        if (asked.most[kind] <= have[kind]) continue;
        throw InputError(asked.where[kind], fmt::format("found index {}, but the file has {} {}",
                                                        asked.most[kind], have[kind], kinds[kind]));
    }
}

}  // namespace diurna
