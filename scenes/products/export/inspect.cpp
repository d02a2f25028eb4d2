#include "scenes/products/export/inspect.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "materials/air/igra.hpp"
#include "materials/air/sounding_table.hpp"
#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "scenes/job/plan/sweep_folder.hpp"
#include "terrain/raster/raster_names.hpp"
#include "terrain/raster/zip_archive.hpp"
#include "thermal/temperature_mesh.hpp"
#include "thermal/temperature_names.hpp"
#include "thermal/weather_file/foreign_columns.hpp"
#include "thermal/weather_file/read_weather.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

/// The first bytes.
std::string head_of(const fs::path& file) {
    std::ifstream in = open_file(file, std::uintmax_t{1} << 44);
    std::string head(4096, '\0');
    in.read(head.data(), std::streamsize(head.size()));
    head.resize(std::size_t(std::max<std::streamsize>(0, in.gcount())));
    return head;
}

Found inspect_netcdf(const fs::path& file, const InspectOptions& options) {
    const std::string title = netcdf_title(file);
    if (title == temperatures_title) return inspect_temperatures(file);
    if (title.starts_with("diurna")) {
        return {.kind = "thermal state",
                .fact = {{"title", {title}}},
                .table = {},
                .next = "use it as state in [time] of a scene with the same mesh and this start"};
    }
    try {
        return inspect_weather(file);
    } catch (const InputError&) {
        return inspect_raster(file, options);
    }
}

/// Weather of a text format of its own, or a table in CSV.
Found inspect_table(const fs::path& file, const InspectOptions& options) {
    if (small_letters(file.extension().string()) == ".dat" && !header_beside(file).empty()) {
        return inspect_raster(file, options);
    }
    return weather_format(file) != WeatherFormat::csv ? inspect_weather(file) : inspect_csv(file);
}

/// Whether it is a table whose columns are recognised as weather.
bool is_recognised_weather(const fs::path& file) {
    try {
        return !recognised_columns_of(file).empty();
    } catch (const InputError&) {
        return false;
    }
}

/// Lists beside pictures, soundings, or a tape7 by such a name.
Found inspect_text(const fs::path& file) {
    const std::string text = read_text(file);
    if (is_igra(text)) return inspect_igra(file);
    if (is_sounding_list(text)) return inspect_sounding(file);
    if (is_recognised_weather(file)) return inspect_weather(file);
    try {
        return inspect_label_lines(file);
    } catch (const InputError& no_labels) {
        try {
            return inspect_tape7(file);
        } catch (const InputError&) {
            throw no_labels;
        }
    }
}

/// What has another name or none: a tape7 has the name that its user gave it.
Found inspect_other(const fs::path& file) {
    const std::string name = small_letters(file.filename().string());
    try {
        return inspect_tape7(file);
    } catch (const InputError&) {
        for (const char* part : {"tape7", "tp7", ".fl7", ".7sc", ".scn"}) {
            if (name.find(part) != std::string::npos) throw;
        }
    }
    throw InputError(file.string(), "has an unknown format",
                     "known: elevation, weather, soundings, tape7, spectra, shapes, meshes, "
                     "OpenEXR, temperatures.nc, TOML, manifests, labels");
}

}  // namespace

Found inspect(const fs::path& file, const InspectOptions& options) {
    if (fs::is_directory(file)) {
        if (fs::is_regular_file(file / "manifest.json")) {
            return inspect_json(file / "manifest.json");
        }
        const fs::path sweep = sweep_around(file);
        if (!sweep.empty()) {
            throw InputError(file.string(), "is a part of a sweep, which is described as a whole",
                             fmt::format("diurna inspect {}", sweep.string()));
        }
        throw InputError(
            file.string(),
            is_sweep_folder(file)
                ? "is the folder of a sweep that is not complete: it has no manifest.json yet"
                : "is a folder without manifest.json, so not a run's folder",
            variant_hint(file));
    }
    const std::string head = head_of(file), ends = small_letters(file.extension().string());
    if (head.empty()) throw InputError(file.string(), "is empty");
    if (head.starts_with("\x76\x2f\x31\x01")) return inspect_exr(file);
    if (head.starts_with("CDF") || head.starts_with("\x89HDF")) {
        return inspect_netcdf(file, options);
    }
    if (is_one_of(ends, {".obj", ".ply", ".stl", ".gltf", ".glb"})) {
        return inspect_mesh(file, options);
    }
    if (ends == ".toml") return inspect_toml(file);
    if (is_one_of(ends, {".json", ".geojson"})) return inspect_json(file);
    if (ends == ".txt") return inspect_text(file);
    if (is_one_of(ends, {".html", ".htm"})) return inspect_sounding(file);
    if (is_one_of(ends, {".csv", ".epw", ".dat", ".tab"})) return inspect_table(file, options);
    if (is_one_of(ends,
                  {".shp", ".gpkg", ".kml", ".kmz", ".fgb", ".geojsonl", ".geojsons", ".ndjson"}) ||
        holds_shapes(file)) {
        return inspect_shapes(file, options);
    }
    if (ends == ".binary") return inspect_brdf(file);
    if (is_weather_zip(file)) return inspect_weather(file);
    const bool packed = head.starts_with("PK\x03\x04") || head.starts_with("\x1f\x8b");
    const bool raster = packed || head.starts_with("\x89PNG") || head.starts_with("\xFF\xD8\xFF") ||
                        head.starts_with("II*") || head.starts_with("MM") ||
                        head.starts_with("II+");
    if (raster ||
        is_one_of(ends, {".tif", ".tiff", ".asc", ".hgt", ".dem", ".dt0", ".dt1", ".dt2", ".img",
                         ".bil", ".bip", ".bsq", ".flt", ".envi", ".hdr"}) ||
        !header_beside(file).empty()) {
        return inspect_raster(file, options);
    }
    return inspect_other(file);
}

}  // namespace diurna
