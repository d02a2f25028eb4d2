#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace diurna {

struct ZipEntry {
    std::string name;  // with "/" between folders
    std::string content;
};

/// A ZIP archive in memory, its files as they are, all of 1980-01-01: the same bytes for the same
/// content (PKWARE APPNOTE 6.3.9, 4.3). Throws std::runtime_error of over 4 GB or 65535 files,
/// which it would need ZIP64 for.
std::string zip_archive(const std::vector<ZipEntry>& entries);

}  // namespace diurna
