#pragma once

#include <filesystem>

#include "scenes/products/export/found.hpp"

namespace diurna {

struct InspectOptions {
    bool allow_outside = false;  // files beside a raster or a mesh may be anywhere
};

/// Content of a file, detected by its content and extension: elevation and other rasters, weather
/// of every supported format, soundings, tape7, spectra and other tables, shapes, meshes, OpenEXR
/// pictures, temperatures and states of heat, scenes, columns, manifests and labels; a run's
/// folder by its manifest. Throws InputError, one line, for other files and files that cannot be
/// read.
Found inspect(const std::filesystem::path& file, const InspectOptions& options = {});

/// The same for one kind of file each; the same errors.
Found inspect_raster(const std::filesystem::path& file, const InspectOptions& options);
Found inspect_weather(const std::filesystem::path& file);
/// A table in CSV by its header: sounding, weather, spectrum, response, refractive index, angles,
/// trajectory, places.
Found inspect_csv(const std::filesystem::path& file);
/// A BRDF of the MERL database.
Found inspect_brdf(const std::filesystem::path& file);
Found inspect_sounding(const std::filesystem::path& file);
/// A file of the Integrated Global Radiosonde Archive: its sounding, or a list of times.
Found inspect_igra(const std::filesystem::path& file);
Found inspect_tape7(const std::filesystem::path& file);
Found inspect_shapes(const std::filesystem::path& file, const InspectOptions& options);
Found inspect_mesh(const std::filesystem::path& file, const InspectOptions& options);
Found inspect_exr(const std::filesystem::path& file);
Found inspect_temperatures(const std::filesystem::path& file);
Found inspect_toml(const std::filesystem::path& file);
Found inspect_json(const std::filesystem::path& file);
/// Lists used with pictures: boxes of YOLO or KITTI, classes, names of pictures.
Found inspect_label_lines(const std::filesystem::path& file);

}  // namespace diurna
