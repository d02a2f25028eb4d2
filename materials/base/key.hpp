#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace diurna {

/// Least and greatest value of a number, both allowed: {} any number, {.least = 0.0} zero or more.
struct Range {
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    double least = -infinity, most = infinity;
};

/// What a reader declares about a key when it reads it from a document
/// (materials/base/section.hpp); scenes/KEYS.md and the schema are made from these.
struct Key {
    /// `tested`: only its presence was tested; `files`: a text or an array of texts.
    enum class Kind {
        tested,
        number,
        whole,
        text,
        name,
        word,
        flag,
        moment,
        numbers,
        texts,
        files,
        rows,
        values,
        table,
        tables
    };

    std::string table{};  // path of its table: "terrain.rule[0]"; the root is ""
    std::string path{};   // of the key in every such table: "terrain.rule[].slope_deg"; "NAME"
                          // is a key that the file's author may choose
    Kind kind = Kind::tested;
    std::string says{};      // in one line what it means
    bool required = false;   // its absence is a mistake
    std::string fallback{};  // value if absent; "": nothing to report
    Range range{};           // of a number
    std::size_t count = 0;   // of an array of numbers, or of each of its rows; 0: any; 1 of
                             // tables that may be one table
    std::vector<std::string> words{};  // all allowed words; the kind of thing that a name refers to
    /// The words chosen so far in the same table, by their keys: ("kind", "gloss"), ...
    std::vector<std::pair<std::string, std::string>> chosen{};
};

}  // namespace diurna
