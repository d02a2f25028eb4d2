#pragma once

#include <map>
#include <string>
#include <vector>

/// Names of files that differ, or that only one of two folders has: their contents by name.
inline std::vector<std::string> differing(const std::map<std::string, std::string>& a,
                                          const std::map<std::string, std::string>& b) {
    std::vector<std::string> names;
    for (const auto& [name, text] : a) {
        if (!b.contains(name) || b.at(name) != text) names.push_back(name);
    }
    for (const auto& [name, text] : b) {
        if (!a.contains(name)) names.push_back(name);
    }
    return names;
}
