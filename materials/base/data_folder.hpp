#pragma once

#include <filesystem>

namespace diurna {

/// Folder of the project's own data (the material library, spectra, tables of the air, parts of
/// models), determined at the first call: the environment's DIURNA_DATA if set; else
/// share/diurna/materials beside the folder of the installed program (bin/diurna), or beside the
/// library; else, if not installed, the sources it was built from; else, for a third-party program
/// that is linked with it, /usr/local/share/diurna or /usr/share/diurna.
std::filesystem::path data_folder();

/// The sample scenes installed with those data, independent of DIURNA_DATA.
std::filesystem::path samples_folder();

}  // namespace diurna
