#pragma once

#include <fmt/format.h>

#include <toml++/toml.h>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "materials/base/confines.hpp"
#include "materials/base/error.hpp"
#include "materials/base/key.hpp"

namespace diurna {

/// What a document and its sections share: the parsed file, the mistakes found so far, and what its
/// readers asked for. Hides the TOML library; for document.cpp and section.cpp alone.
struct DocumentState {
    struct Placed {
        std::uint32_t line = 0, column = 0;
        Mistake mistake;
        std::string path;  // "terrain.rule[0].width_m"
    };

    /// What was asked of one table.
    struct Table {
        std::set<std::string> asked;
        std::set<std::string> tested;                             // of those, by has()
        std::vector<std::pair<std::string, std::string>> chosen;  // word keys and their words
        bool free = false;                                        // its keys are anybody's choice
    };

    std::string file;
    Confines confines;
    toml::table root;
    std::vector<Placed> mistakes;
    std::map<std::string, Table> table;  // by its path: "terrain.rule[0]"
    std::vector<Key> keys;               // as they were asked for

    /// "file:line:column: path.to.key"
    std::string place(const toml::source_region& source, const std::string& path) const {
        const bool set = source.path && source.path->starts_with("--set ");
        if (set || source.begin.line == 0) return "--set " + path;  // it is not from the file
        return fmt::format("{}:{}:{}: {}", file, source.begin.line, source.begin.column, path);
    }
    void note(const toml::source_region& source, const std::string& path,
              const std::string& problem, const std::string& hint = "") {
        mistakes.push_back(
            {source.begin.line, source.begin.column, {place(source, path), problem, hint}, path});
    }
};

inline std::string joined_path(const std::string& path, const std::string& key) {
    return path.empty() ? key : key.empty() ? path : path + "." + key;
}

}  // namespace diurna
