#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "materials/base/files_read.hpp"
#include "scenes/products/export/run_heat.hpp"

namespace diurna {

/// A VTK XML file (UnstructuredGrid, version 1.0, arrays in base64) of one instant, readable by
/// ParaView and meshio:
///
/// points     Float32 x, y, z: east, north, up [m] of the site
/// triangles  as in temperatures.nc, in its order
/// cell data  temperature_K Float32, material and object Int32 (numbers)
/// field data site_latitude_deg, site_longitude_deg, site_height_m, TimeValue [s] since 1970 (UTC)
///
/// A comment at its head describes the frame, and the meaning of the numbers.
std::string vtu_text(const RunHeat& heat, const HeatAt& at);

/// A ParaView collection of such files; `timestep` is seconds from the first instant.
///
/// - names: (instant) of the files, in its own folder
std::string pvd_text(std::span<const Instant> instants, std::span<const std::string> names);

/// Writes the collection `pvd` and, beside it, STEM_UTC.vtu for each instant: each file whole or
/// not at all, the collection last. Returns the number of files. Throws InputError, before anything
/// is written, if a file cannot be replaced or is one of the inputs, std::runtime_error if one
/// cannot be written.
std::size_t write_vtu_day(const std::filesystem::path& pvd, const RunHeat& heat,
                          std::span<const Instant> instants,
                          const std::vector<FileRead>& inputs = {});

}  // namespace diurna
