#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace diurna {

/// An HDF5 file, and so a netCDF-4 file, can have its values in other files: by links, by external
/// storage, as a virtual dataset. Throws InputError for such a file; does nothing with files of
/// other formats. To be called before netCDF opens a file.
void check_values_are_its_own(const std::filesystem::path& file);
/// The same for a file in memory; `name` names it in messages.
void check_values_are_its_own(std::span<const std::byte> bytes, const std::string& name);

/// The bytes of an empty HDF5 file that tracks the order of creation, which netCDF needs in a file
/// it is to change. Empty if the library fails.
std::vector<std::byte> hdf5_with_nothing_in_it();

}  // namespace diurna
