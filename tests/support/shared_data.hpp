#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include "tests/support/passed_over.hpp"

/// Reference data that are not part of the repository: DIURNA_SHARED, or the folder `shared` beside
/// the source tree. Without it a test is skipped.
inline std::optional<std::filesystem::path> shared_data(const std::string& inside) {
    const char* named = std::getenv("DIURNA_SHARED");
    const std::filesystem::path folder =
        named != nullptr ? std::filesystem::path(named)
                         : std::filesystem::path(DIURNA_SOURCE_DIR "/../shared");
    if (std::filesystem::exists(folder / inside)) return folder / inside;
    pass_over("no reference data at " + (folder / inside).string());
    return std::nullopt;
}
