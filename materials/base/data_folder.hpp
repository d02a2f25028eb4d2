#pragma once

#include <filesystem>

namespace diurna {

/// Where the project's own data lie (the material library, spectra, tables of the air, parts of
/// models), found when it is first asked for: the environment's DIURNA_DATA if set; else
/// share/diurna/materials beside the folder the program was installed into (bin/diurna), or beside
/// the library that it is part of; else, never installed, the sources it was built from; else, a
/// program of others that is linked with it, /usr/local/share/diurna or /usr/share/diurna.
std::filesystem::path data_folder();

/// The sample scenes that came with those data, wherever DIURNA_DATA points.
std::filesystem::path samples_folder();

}  // namespace diurna
