#include "thermal/weather_file/weather_format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "materials/base/csv.hpp"
#include "materials/base/error.hpp"
#include "terrain/raster/zip_archive.hpp"
#include "thermal/weather_file/era5.hpp"
#include "thermal/weather_file/pvgis.hpp"
#include "thermal/weather_file/surfrad.hpp"
#include "thermal/weather_file/text_lines.hpp"
#include "thermal/weather_file/weather_text.hpp"

namespace diurna {

namespace {

/// The first bytes of a file, or of the weather in a zip archive; empty if it cannot be read (the
/// readers tell why).
std::string head_of(const std::filesystem::path& file) {
    constexpr std::size_t enough = 8192;
    if (!weather_member(file).empty()) {
        const std::string text = weather_text(file).substr(0, enough);
        return text.starts_with(byte_order_mark) ? text.substr(byte_order_mark.size()) : text;
    }
    std::string head(enough, '\0');
    std::ifstream in(file, std::ios::binary);
    in.read(head.data(), std::streamsize(enough));
    head.resize(std::size_t(std::max<std::streamsize>(0, in.gcount())));
    return head.starts_with(byte_order_mark) ? head.substr(byte_order_mark.size()) : head;
}

std::string line_of(const std::string& text, int number) {
    std::size_t begin = 0;
    for (; number > 0 && begin != std::string::npos; --number) {
        begin = text.find('\n', begin);
        if (begin != std::string::npos) ++begin;
    }
    return begin == std::string::npos ? "" : text.substr(begin, text.find('\n', begin) - begin);
}

bool is_netcdf(const std::string& head) {
    return head.starts_with("CDF") || head.starts_with("\x89HDF");
}

/// Whether a line of columns has a variable of ERA5.
bool has_era5_name(const std::string& header) {
    const std::vector<std::string> cells = csv_cells(header);
    return std::any_of(cells.begin(), cells.end(), is_era5_name);
}

WeatherFormat format_of_content(const std::string& head) {
    if (is_netcdf(head)) return WeatherFormat::era5_netcdf;
    const std::string first = line_of(head, 0), second = line_of(head, 1);
    if (first.starts_with("LOCATION,")) return WeatherFormat::epw;
    if (second.starts_with("Date (MM/DD/YYYY),Time (HH:MM)")) return WeatherFormat::tmy3;
    const std::string small = small_letters(first);
    if (small.starts_with("source,location id,") && small.find("time zone") != std::string::npos) {
        return WeatherFormat::psm;
    }
    if (is_pvgis(first)) return WeatherFormat::pvgis;
    if (second.find("ObservationTime(") != std::string::npos) return WeatherFormat::solar_anywhere;
    if (first.starts_with("*U0001") || first.starts_with("*C0001")) return WeatherFormat::bsrn;
    if (is_surfrad_place(second)) return WeatherFormat::surfrad;
    if (first.find("valid_time") != std::string::npos && has_era5_name(first)) {
        return WeatherFormat::era5_csv;
    }
    return WeatherFormat::csv;
}

}  // namespace

bool is_era5_zip(const std::filesystem::path& file) {
    if (!is_zip(file)) return false;
    const std::vector<std::string> members = zip_members(file);
    const bool spreadsheet =
        std::find(members.begin(), members.end(), "[Content_Types].xml") != members.end();
    if (spreadsheet) return false;
    const auto any = [&](const char* ends) {
        return std::any_of(members.begin(), members.end(),
                           [&](const auto& name) { return small_letters(name).ends_with(ends); });
    };
    if (any(".nc")) return true;
    // Several tables are the store's, one may be anybody's.
    if (weather_member(file).empty()) return any(".csv");
    return format_of_content(head_of(file)) == WeatherFormat::era5_csv;
}

bool is_weather_zip(const std::filesystem::path& file) {
    return is_era5_zip(file) || !weather_member(file).empty();
}

WeatherFormat weather_format(const std::filesystem::path& file) {
    const std::string head = head_of(file);
    const WeatherFormat found = format_of_content(head);
    const std::string extension = file.extension().string();
    const auto refuse = [&](const char* what) {
        throw InputError(file.string(), fmt::format("is named {} but is {}", extension, what));
    };
    if (head.empty()) return found;
    if (found == WeatherFormat::era5_csv && is_zip(file)) return WeatherFormat::era5_zip;
    if (head.starts_with("PK\x03\x04")) {
        const bool named_as_sheet = extension == ".xlsx" || extension == ".ods";
        if (!named_as_sheet && is_era5_zip(file)) return WeatherFormat::era5_zip;
        throw InputError(
            file.string(), "is a spreadsheet, or an archive without one weather file",
            "save a sheet as CSV with commas between cells, or unpack the file from the archive");
    }
    const std::size_t first = head.find_first_not_of(" \t\r\n");
    if (first != std::string::npos && head[first] == '{') {
        throw InputError(file.string(), "is JSON, a format that is not supported for weather",
                         "PVGIS, Open-Meteo and NASA POWER also offer CSV");
    }
    if (extension == ".epw" && found != WeatherFormat::epw) {
        refuse("not an EPW file: those begin with LOCATION");
    }
    if (extension == ".nc" && found != WeatherFormat::era5_netcdf) refuse("not a netCDF file");
    if (extension == ".dat" && found == WeatherFormat::csv && head.find(',') == std::string::npos) {
        refuse("neither a SURFRAD nor a BSRN file");
    }
    return found;
}

}  // namespace diurna
