#include "terrain/raster/crs.hpp"

#include "materials/base/error.hpp"

namespace diurna {

OGRSpatialReference reference_of(const std::string& wkt) {
    OGRSpatialReference reference;
    reference.SetFromUserInput(wkt.c_str(),
                               OGRSpatialReference::SET_FROM_USER_INPUT_LIMITATIONS_get());
    reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    return reference;
}

OGRSpatialReference wgs84() {
    OGRSpatialReference reference;
    reference.SetWellKnownGeogCS("WGS84");
    reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    return reference;
}

std::string wkt_of(const OGRSpatialReference& reference) {
    char* made = nullptr;
    const char* const options[] = {"FORMAT=WKT2_2019", nullptr};
    reference.exportToWkt(&made, options);
    const std::string wkt = made ? made : "";
    CPLFree(made);
    return wkt;
}

Transformation transformation(const OGRSpatialReference& from, const OGRSpatialReference& to) {
    return Transformation(OGRCreateCoordinateTransformation(&from, &to));
}

std::vector<int> transform(OGRCoordinateTransformation& shift, std::vector<double>& x,
                           std::vector<double>& y) {
    std::vector<int> good(x.size(), 1);
    if (!x.empty()) {
        shift.Transform(static_cast<int>(x.size()), x.data(), y.data(), nullptr, good.data());
    }
    return good;
}

const GeoProjection& projection_of(const std::string& wkt, const std::string& source) {
    thread_local GeoProjection last;
    if (last.wkt == wkt && last.to_geodetic) return last;
    const OGRSpatialReference reference = reference_of(wkt), geodetic = wgs84();
    GeoProjection made{.wkt = wkt,
                       .geographic = reference.IsGeographic() != 0,
                       .to_geodetic = transformation(reference, geodetic),
                       .from_geodetic = transformation(geodetic, reference)};
    if (!made.to_geodetic || !made.from_geodetic) {
        throw InputError(
            source,
            "its coordinate reference system cannot be converted to latitude and longitude");
    }
    last = std::move(made);
    return last;
}

bool same_reference(const std::string& wkt, const std::string& other) {
    const OGRSpatialReference first = reference_of(wkt), second = reference_of(other);
    return wkt == other || first.IsSame(&second);
}

}  // namespace diurna
