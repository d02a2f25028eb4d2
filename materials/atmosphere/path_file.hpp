#pragma once

#include <filesystem>
#include <memory>

#include "materials/atmosphere/tabulated.hpp"

namespace diurna {

/// A table of the paths of a MODTRAN file: a tape7, or one convolved with a slit (.7sc, .scn), of
/// IEMSCT 1 or 2. Every run is one path, all with the same wavenumbers: from every H1 to every H2
/// over one or more ranges (ITYPE 2; ITYPE 1 if both are the same), and from some H1 to space under
/// zenith angles from 0 to at least 89° (ITYPE 3). Its bins are those covered.
///
/// Scattered sunlight is not read: it is valid for one sun position. Throws InputError, and
/// std::runtime_error for a bin without a row.
std::shared_ptr<const TabulatedPaths> read_path_table(const std::filesystem::path& file);

}  // namespace diurna
