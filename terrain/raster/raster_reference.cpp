#include "terrain/raster/raster_reference.hpp"

#include <cpl_error.h>
#include <fmt/format.h>

#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "terrain/raster/crs.hpp"

namespace diurna {

namespace {

enum class NetcdfAxis { latitude, longitude, other };

/// An axis by its unit, its standard name, or its own with a unit of degrees.
NetcdfAxis axis_of(const GDALDimension& dimension) {
    const auto values = dimension.GetIndexingVariable();
    const std::string name = small_letters(dimension.GetName());
    std::string unit, standard;
    if (values) {
        unit = small_letters(values->GetUnit());
        if (const auto attribute = values->GetAttribute("standard_name")) {
            const char* text = attribute->ReadAsString();
            standard = text != nullptr ? small_letters(text) : "";
        }
    }
    const bool degrees = unit.starts_with("degree");
    for (const auto& [axis, side, whole, part] :
         {std::tuple{NetcdfAxis::latitude, "n", "latitude", "lat"},
          std::tuple{NetcdfAxis::longitude, "e", "longitude", "lon"}}) {
        const bool by_unit =
            degrees && unit.size() > 6 &&
            (unit.ends_with(std::string("_") + side) || unit == std::string("degree") + side ||
             unit == std::string("degrees") + side ||
             unit.ends_with(axis == NetcdfAxis::latitude ? "north" : "east"));
        if (by_unit || standard == whole || (degrees && (name == whole || name == part))) {
            return axis;
        }
    }
    return NetcdfAxis::other;
}

/// The last two axes of a raster's variable, rows first; other where they cannot be looked up.
std::pair<NetcdfAxis, NetcdfAxis> netcdf_axes(GDALDataset& raster,
                                              const std::filesystem::path& file) {
    const std::pair none{NetcdfAxis::other, NetcdfAxis::other};
    const char* const drivers[] = {"netCDF", nullptr};
    const char* const variable = raster.GetRasterCount() > 0
                                     ? raster.GetRasterBand(1)->GetMetadataItem("NETCDF_VARNAME")
                                     : nullptr;
    if (variable == nullptr) return none;
    const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
    const std::string name = std::filesystem::absolute(file).lexically_normal().string();
    const GDALDatasetUniquePtr arrays(
        GDALDataset::Open(name.c_str(), GDAL_OF_MULTIDIM_RASTER | GDAL_OF_READONLY, drivers));
    const auto root = arrays ? arrays->GetRootGroup() : nullptr;
    const auto array = root ? root->ResolveMDArray(variable, "") : nullptr;
    if (!array || array->GetDimensionCount() < 2) return none;
    const auto& dimensions = array->GetDimensions();
    return {axis_of(*dimensions[dimensions.size() - 2]), axis_of(*dimensions.back())};
}

/// Of a .prj file beside dem.asc.gz: dem.prj or dem.asc.prj.
std::optional<OGRSpatialReference> reference_beside(const std::filesystem::path& file) {
    const std::filesystem::path unpacked = std::filesystem::path(file).replace_extension();
    for (std::filesystem::path beside : {std::filesystem::path(unpacked).replace_extension(".prj"),
                                         std::filesystem::path(unpacked.string() + ".prj")}) {
        if (!std::filesystem::is_regular_file(beside)) continue;
        const std::string text = read_text(beside, 1u << 16);
        const char* const lines[] = {text.c_str(), nullptr};
        OGRSpatialReference reference;
        if (reference.importFromESRI(const_cast<char**>(lines)) == OGRERR_NONE) return reference;
    }
    return std::nullopt;
}

}  // namespace

std::optional<OGRSpatialReference> raster_reference(GDALDataset& raster,
                                                    const std::filesystem::path& file) {
    const OGRSpatialReference* const own = raster.GetSpatialRef();
    const bool named = own != nullptr && !own->IsEmpty() && !own->IsLocal();
    const std::string_view driver = raster.GetDriverName();
    if (driver == "netCDF") {
        const auto [rows, columns] = netcdf_axes(raster, file);
        if (rows == NetcdfAxis::longitude && columns == NetcdfAxis::latitude) {
            throw InputError(file.string(),
                             "its values are in the order longitude, latitude; expected latitude, "
                             "longitude",
                             "ncpdq -a lat,lon IN.nc OUT.nc exchanges them");
        }
        if (!named && rows == NetcdfAxis::latitude && columns == NetcdfAxis::longitude) {
            return wgs84();
        }
    }
    if (named) return *own;
    if (driver == "AAIGrid" && small_letters(file.extension().string()) == ".gz") {
        return reference_beside(file);
    }
    return std::nullopt;
}

}  // namespace diurna
