#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

/// Every file beneath a folder, by its name there.
inline std::map<std::string, std::string> contents(const std::filesystem::path& folder) {
    std::map<std::string, std::string> found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (!entry.is_regular_file()) continue;
        std::ostringstream text;
        text << std::ifstream(entry.path(), std::ios::binary).rdbuf();
        found[std::filesystem::relative(entry.path(), folder).string()] = text.str();
    }
    return found;
}
