#pragma once

#include <filesystem>
#include <string>

#include "materials/base/confines.hpp"

namespace diurna {

/// While it exists, files that GDAL opens on this thread must be within the confines, whichever
/// file names them: sidecars, overviews, targets of metadata. Each is recorded as read
/// (materials/base/files_read.hpp). If a thread has several gates, the latest applies.
class GdalGate {
 public:
    explicit GdalGate(Confines confines);
    ~GdalGate();
    GdalGate(const GdalGate&) = delete;
    GdalGate& operator=(const GdalGate&) = delete;

    /// Throws InputError if GDAL requested a file outside.
    void check() const;

 private:
    friend class GuardedDisk;
    /// Whether GDAL may open a file; remembers the first refusal.
    bool admits(const char* name, bool reported);

    Confines confines_;
    std::filesystem::path refused_{};
    std::string why_{};
    GdalGate* before_ = nullptr;  // of this thread
};

/// Registers only the drivers that the readers here use, restricts GDAL's file systems
/// to disk, memory and zip and gzip archives, and disables network access. Once per
/// process.
void prepare_gdal();

}  // namespace diurna
