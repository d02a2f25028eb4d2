#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace diurna {

/// An HDF5 file, which a netCDF-4 file is, can have its values in other files: by links, by
/// external storage, as a virtual dataset. Throws InputError of one that has; does nothing with
/// files of other kinds. To be asked before netCDF opens a file.
void check_values_are_its_own(const std::filesystem::path& file);
/// The same of a file's bytes; `name` names it in messages.
void check_values_are_its_own(std::span<const std::byte> bytes, const std::string& name);

/// The bytes of an HDF5 file that holds nothing and keeps the order of what is put into it, as
/// netCDF wants of a file it is to change. Empty where the library fails.
std::vector<std::byte> hdf5_with_nothing_in_it();

}  // namespace diurna
