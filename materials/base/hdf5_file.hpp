#pragma once

#include <filesystem>

namespace diurna {

/// An HDF5 file, which a netCDF-4 file is, can have its values in other files: by links, by
/// external storage, as a virtual dataset. Throws InputError of one that has; does nothing with
/// files of other kinds. To be asked before netCDF opens a file.
void check_values_are_its_own(const std::filesystem::path& file);

}  // namespace diurna
