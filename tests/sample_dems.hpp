#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include <catch2/catch.hpp>

namespace diurna {

/// A file of the shared sample data, or nothing, with a warning, where the folder is absent.
inline std::optional<std::filesystem::path> sample(const std::string& name) {
    const char* folder = std::getenv("DIURNA_SHARED");
    const std::filesystem::path shared = folder ? folder : DIURNA_SOURCE_DIR "/../shared";
    const auto file = shared / "data" / name;
    if (std::filesystem::exists(file)) return file;
    WARN("skipped: no " << name << " in the shared data");
    return std::nullopt;
}

}  // namespace diurna
