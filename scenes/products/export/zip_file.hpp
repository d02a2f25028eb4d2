#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace diurna {

struct ZipEntry {
    std::string name;  // with "/" between folders
    std::string content;
};

/// A ZIP archive in memory, its files uncompressed, dated 1980-01-01: the same bytes for the same
/// content (PKWARE APPNOTE 6.3.9, 4.3). Throws std::runtime_error for over 4 GB or 65535 files,
/// which would need ZIP64.
std::string zip_archive(const std::vector<ZipEntry>& entries);

}  // namespace diurna
