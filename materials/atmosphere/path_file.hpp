#pragma once

#include <filesystem>
#include <memory>

#include "materials/atmosphere/tabulated.hpp"

namespace diurna {

/// A table of the paths of a MODTRAN file: a tape7, or one convolved with a slit (.7sc, .scn), of
/// IEMSCT 1 or 2, every run one path of the same wavenumbers: from every H1 to every H2 over some
/// ranges of its own (ITYPE 2; ITYPE 1 where the two are the same), and from some H1 to space under
/// zenith angles from 0 to at least 89° (ITYPE 3). Its bins are those the wavenumbers reach.
///
/// Scattered sun is not read: it belongs to one place of the sun. Throws InputError, and
/// std::runtime_error for a bin without a row.
std::shared_ptr<const TabulatedPaths> read_path_table(const std::filesystem::path& file);

}  // namespace diurna
