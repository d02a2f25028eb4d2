#include "terrain/raster/dem_heights.hpp"

#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>

#include "materials/base/csv.hpp"
#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "terrain/raster/band_mask.hpp"
#include "terrain/raster/height_unit.hpp"

namespace diurna {

namespace {

constexpr double lowest = -12e3, highest = 9e3;  // heights on Earth [m], with some room

constexpr const char* unit_hint =
    "set terrain.height_unit to m, dm, cm, km, ft, us_ft or geopotential";

/// The unit that a band's file names; "" if it names none.
std::string named_unit(GDALRasterBand& band) {
    if (const std::string unit = band.GetUnitType(); !unit.empty()) return unit;
    for (const char* key : {"units", "Units", "UNITS", "unit", "GRIB_UNIT"}) {
        if (const char* unit = band.GetMetadataItem(key)) return unit;
    }
    for (const char* key : {"standard_name", "long_name"}) {
        const char* name = band.GetMetadataItem(key);
        if (name != nullptr && small_letters(name) == "geopotential") return "m2 s-2";
    }
    return "";
}

/// The unit of heights that a CRS has as a vertical axis; 0 if it has none.
double vertical_unit(const OGRSpatialReference* reference) {
    if (reference == nullptr || reference->IsVertical() == 0) return 0.0;
    return reference->GetTargetLinearUnits("VERT_CS");
}

/// "US survey foot" of a map in feet; "" of one in metres or degrees.
std::string map_unit(const OGRSpatialReference* reference) {
    if (reference == nullptr || reference->IsProjected() == 0) return "";
    const char* name = nullptr;
    const double metres = reference->GetLinearUnits(&name);
    return metres == 1.0 || name == nullptr ? "" : name;
}

/// 9999, 65535 and the like, which programs write where nothing was measured.
bool is_code(double value) {
    const std::string digits = fmt::format("{:g}", value);
    return digits.find_first_not_of('9') == std::string::npos || value == 65535.0;
}

/// The remedy for a height above all places on Earth.
std::string too_high_hint(GDALDataset& raster, GDALRasterBand& band, const std::string& file,
                          float stored) {
    const std::string no_data =
        fmt::format("if {0:g} means no data: gdal_translate -a_nodata {0:g} IN OUT.tif", stored);
    // An EHdr header without PIXELTYPE means numbers without a sign: -12 is read as 65524.
    constexpr float sign_bit = 32768.0f, range = 65536.0f;
    const bool unsigned_ehdr = std::string_view(raster.GetDriverName()) == "EHdr" &&
                               band.GetRasterDataType() == GDT_UInt16;
    if (unsigned_ehdr && stored >= sign_bit) {
        const auto header = std::filesystem::path(file).filename().replace_extension(".hdr");
        return fmt::format(
            "if its heights have a sign ({:.0f} is {:.0f} then), write PIXELTYPE SIGNEDINT into "
            "{}{}",
            stored, stored - range, header.string(), is_code(stored) ? "; " + no_data : "");
    }
    return is_code(stored) ? no_data : unit_hint;
}

/// "Zunits FEET" of an old ESRI .prj beside the raster, which GDAL passes over; "" without one.
std::string unit_beside(const std::string& file) {
    for (const std::filesystem::path& beside :
         {std::filesystem::path(file).replace_extension(".prj"),
          std::filesystem::path(file).replace_extension(".PRJ")}) {
        std::error_code none;
        if (!std::filesystem::is_regular_file(beside, none)) continue;
        std::istringstream text(read_text(beside, 1u << 16));
        for (std::string word, unit; text >> word;) {
            if (small_letters(word) != "zunits" || !(text >> unit)) continue;
            const std::string small = small_letters(unit);
            return small == "no" || small == "none" ? "" : unit;
        }
    }
    return "";
}

/// What a raster's heights are multiplied by, and the unit for messages.
struct TakenUnit {
    double metres;
    std::string name;
};

/// The unit of the heights; notes what is converted.
TakenUnit unit_of_heights(GDALDataset& raster, GDALRasterBand& band, const DemOptions& options,
                          Dem& dem) {
    const auto converted = [&](double metres, const std::string& name) {
        if (metres != 1.0) {
            dem.notes.push_back(fmt::format(
                "{}: heights have the unit {} and were converted to metres (factor {:.7g})",
                dem.source, name, metres));
        }
        return TakenUnit{metres, name};
    };
    if (options.unit) return converted(*options.unit, "of height_unit");
    if (const std::string named = named_unit(band); !named.empty()) {
        const auto unit = height_unit(named);
        const double vertical = vertical_unit(raster.GetSpatialRef());
        if (unit && vertical > 0.0 && std::abs(vertical / unit->metres - 1.0) > 1e-4) {
            dem.warnings.push_back({dem.source,
                                    fmt::format("its heights have the unit {}, but the vertical "
                                                "axis of its CRS has {:.7g} m; the unit {} is used",
                                                unit->name, vertical, unit->name),
                                    unit_hint});
        }
        if (!unit) {
            throw InputError(dem.source,
                             fmt::format("its heights have the unit '{}', expected metre, foot, "
                                         "US survey foot, km or m2 s-2",
                                         named.substr(0, 40)),
                             unit_hint);
        }
        return converted(unit->metres, unit->name);
    }
    const OGRSpatialReference* reference = raster.GetSpatialRef();
    if (const double metres = vertical_unit(reference); metres > 0.0) {
        return converted(metres, "of the vertical axis of its CRS");
    }
    if (const std::string named = unit_beside(dem.source); !named.empty()) {
        double per_metre = 0.0;  // a number: units in a metre
        if (parse_number(named, per_metre) && per_metre > 0.0) {
            return converted(1.0 / per_metre, "of Zunits in its .prj");
        }
        const auto unit = height_unit(named);
        if (!unit) {
            throw InputError(dem.source,
                             fmt::format("Zunits of its .prj are '{}', expected METERS or FEET",
                                         named.substr(0, 40)),
                             unit_hint);
        }
        return converted(unit->metres, unit->name + std::string(" (Zunits of its .prj)"));
    }
    if (const std::string map = map_unit(reference); !map.empty()) {
        dem.warnings.push_back(
            {dem.source,
             fmt::format("its map unit is {} and its heights have no unit; they are read as metres",
                         map),
             unit_hint});
    }
    return {1.0, "metre"};
}

}  // namespace

void read_heights(GDALDataset& raster, const PostWindow& window, const DemOptions& options,
                  Dem& dem, const QuietGdal& gdal) {
    GDALRasterBand& band = *raster.GetRasterBand(1);
    const TakenUnit unit = unit_of_heights(raster, band, options, dem);
    const double scale = band.GetScale() * unit.metres, offset = band.GetOffset() * unit.metres;
    const std::size_t columns = static_cast<std::size_t>(window.columns);
    dem.height.resize(columns * window.rows);
    std::vector<std::uint8_t> valid(columns);
    if (band.RasterIO(GF_Read, window.column, window.row, window.columns, window.rows,
                      dem.height.data(), window.columns, window.rows, GDT_Float32, 0,
                      0) != CE_None) {
        throw InputError(dem.source, "is damaged" + gdal.because());
    }
    int declared = 0;
    const auto nodata = static_cast<float>(band.GetNoDataValue(&declared));
    BandMask mask(band, dem.source);
    for (int row = 0; row < window.rows; ++row) {
        mask.read(window.column, window.row + row, valid);
        for (std::size_t column = 0; column < columns; ++column) {
            float& height = dem.height[columns * std::size_t(row) + column];
            const bool is_void = !std::isfinite(height) || valid[column] == 0 ||
                                 (declared && height == nodata) || height == -32768.0f ||
                                 height == -32767.0f || height == 32767.0f || height == -9999.0f ||
                                 scale * height + offset < lowest;
            if (is_void) {
                height = std::numeric_limits<float>::quiet_NaN();
                continue;
            }
            const float stored = height;
            height = static_cast<float>(scale * height + offset);
            if (height > highest) {
                throw InputError(
                    dem.source,
                    fmt::format("found a height of {:.0f} m with the unit {}, higher than any "
                                "place on Earth",
                                height, unit.name),
                    too_high_hint(raster, band, dem.source, stored));
            }
        }
    }
}

}  // namespace diurna
