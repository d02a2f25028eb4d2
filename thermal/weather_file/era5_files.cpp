#include "thermal/weather_file/era5_files.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/files_read.hpp"
#include "terrain/raster/zip_archive.hpp"
#include "thermal/weather_file/era5_csv.hpp"
#include "thermal/weather_file/era5_netcdf.hpp"
#include "thermal/weather_file/weather_format.hpp"

namespace diurna {

namespace {

constexpr std::size_t most_member_bytes = std::size_t{256} << 20;

bool is_netcdf_name(const std::string& name) { return small_letters(name).ends_with(".nc"); }
bool is_csv_name(const std::string& name) { return small_letters(name).ends_with(".csv"); }

Era5Series member_series(const std::filesystem::path& file, const std::string& member,
                         const std::optional<Geodetic>& site) {
    const std::vector<std::byte> bytes = zip_member(file, member, most_member_bytes);
    if (is_netcdf_name(member)) return era5_netcdf_series(file / member, bytes, site);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return era5_csv_series(file / member, text);
}

}  // namespace

Era5Series read_era5_series(const std::filesystem::path& file,
                            const std::optional<Geodetic>& site) {
    if (!is_zip(file)) {
        return weather_format(file) == WeatherFormat::era5_netcdf ? read_era5_netcdf(file, site)
                                                                  : read_era5_csv(file);
    }
    note_file_read(file);
    std::optional<Era5Series> all;
    for (const std::string& member : zip_members(file)) {
        if (!is_netcdf_name(member) && !is_csv_name(member)) continue;
        Era5Series one = member_series(file, member, site);
        if (all) {
            join_era5(*all, one);
        } else {
            all = std::move(one);
        }
    }
    if (!all) throw InputError(file.string(), "is a zip archive without netCDF or CSV");
    all->file = file;
    all->format = "ERA5 zip";
    return std::move(*all);
}

}  // namespace diurna
