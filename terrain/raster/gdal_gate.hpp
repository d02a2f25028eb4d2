#pragma once

#include <filesystem>
#include <string>

#include "materials/base/confines.hpp"

namespace diurna {

/// While it lives, what GDAL opens on this thread lies within the confines, whichever file names
/// it: sidecars, overviews, what metadata point to. Each is noted as read
/// (materials/base/files_read.hpp). Of several on a thread the youngest holds.
class GdalGate {
 public:
    explicit GdalGate(Confines confines);
    ~GdalGate();
    GdalGate(const GdalGate&) = delete;
    GdalGate& operator=(const GdalGate&) = delete;

    /// Throws InputError where GDAL has asked for a file that it may not have.
    void check() const;

 private:
    friend class GuardedDisk;
    /// Whether GDAL may have a file; remembers the first that it may not.
    bool admits(const char* name, bool reported);

    Confines confines_;
    std::filesystem::path refused_{};
    std::string why_{};
    GdalGate* before_ = nullptr;  // of this thread
};

/// Registers the drivers that readers here use and no others, closes GDAL's file systems but those
/// of the disk, of memory and of zip and gzip archives, and keeps it off the network. Once in the
/// process.
void prepare_gdal();

}  // namespace diurna
