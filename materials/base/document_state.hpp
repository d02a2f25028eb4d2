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

/// State shared by a document and its sections: the parsed file, the mistakes found so far, and the
/// keys read. Hides the TOML library; only for document.cpp and section.cpp.
struct DocumentState {
    struct Placed {
        std::uint32_t line = 0, column = 0;
        Mistake mistake;
        std::string path;  // "terrain.rule[0].width_m"
    };

    /// Keys read from one table.
    struct Table {
        std::set<std::string> asked;
        std::set<std::string> tested;                             // of those, by has()
        std::vector<std::pair<std::string, std::string>> chosen;  // word keys and their words
        bool free = false;                                        // its keys are free names
    };

    std::string file;
    Confines confines;
    toml::table root;
    std::vector<Placed> mistakes;
    std::map<std::string, Table> table;                          // by its path: "terrain.rule[0]"
    std::vector<Key> keys;                                       // in the order of reading
    std::map<std::string, std::vector<std::string>> usual_name;  // Document::name_tables

    /// A table [[observer]] by its name: "observer[1]" -> "observer.east", as --set and warnings
    /// name it; the only one -> "observer".
    struct Named {
        std::string path;   // with its name; "": it has none
        std::string alone;  // "": there are several, or it is within another table
    };
    std::map<std::string, Named> by_name;

    /// The path with names instead of numbers. Of a table that is the only one, the name is omitted
    /// unless `always`.
    std::string named(const std::string& path, bool always) const {
        for (std::size_t end = path.rfind(']'); end != std::string::npos && end > 0;
             end = path.rfind(']', end - 1)) {
            const auto found = by_name.find(path.substr(0, end + 1));
            if (found == by_name.end()) continue;
            const auto& [name, alone] = found->second;
            const bool short_form = !alone.empty() && (!always || name.empty());
            const std::string& shown = short_form ? alone : name;
            if (!shown.empty()) return shown + path.substr(end + 1);
        }
        return path;
    }
    /// "file:line:column: path.to.key"; of a setting "--set path.to.key"
    std::string place(const toml::source_region& source, const std::string& path) const {
        const bool set = source.path && source.path->starts_with("--set ");
        if (set || source.begin.line == 0) return "--set " + named(path, true);
        return fmt::format("{}:{}:{}: {}", file, source.begin.line, source.begin.column,
                           named(path, false));
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
