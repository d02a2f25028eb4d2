#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "materials/base/files_read.hpp"
#include "scenes/export/run_heat.hpp"

namespace diurna {

/// A VTK XML file (UnstructuredGrid, version 1.0, arrays in base64) of one instant, as ParaView and
/// meshio open it:
///
/// points     Float32 x, y, z: east, north, up [m] of the site
/// triangles  as in temperatures.nc, in its order
/// cell data  temperature_K Float32, material and object Int32 (numbers)
/// field data site_latitude_deg, site_longitude_deg, site_height_m, TimeValue [s] since 1970 (UTC)
///
/// A comment at its head reports the frame, and what the numbers are called.
std::string vtu_text(const RunHeat& heat, const HeatAt& at);

/// A ParaView collection of such files; `timestep` is seconds from the first instant.
///
/// - names: (instant) of the files, in its own folder
std::string pvd_text(std::span<const Instant> instants, std::span<const std::string> names);

/// The collection `pvd` and, beside it, STEM_UTC.vtu for each instant: each file whole or not at
/// all, the collection last. Returns their number. Throws InputError, before anything is written,
/// where a file cannot take its place or is one of the inputs, std::runtime_error where one cannot
/// be written.
std::size_t write_vtu_day(const std::filesystem::path& pvd, const RunHeat& heat,
                          std::span<const Instant> instants,
                          const std::vector<FileRead>& inputs = {});

}  // namespace diurna
