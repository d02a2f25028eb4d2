#pragma once

#include <filesystem>
#include <string>

#include "materials/matter/library.hpp"
#include "materials/matter/library_notes.hpp"

namespace diurna {

/// A line for each material of a library: name, albedo, emissivity, bands, inertia, description.
std::string materials_list(const MaterialLibrary& library, const LibraryNotes& notes);

/// One material: its key figures, the lines of the library file with its numbers and their sources,
/// those of the materials it is derived from, the headers of its spectra's files, and the tags.
///
/// folder  of the library file
std::string material_sheet(const Material& material, const LibraryNotes& notes,
                           const std::filesystem::path& folder);

/// materials/LIBRARY.md: a table of all of them beside the chart.
std::string materials_page(const MaterialLibrary& library, const LibraryNotes& notes);

}  // namespace diurna
