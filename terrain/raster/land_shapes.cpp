#include "terrain/raster/land_shapes.hpp"

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>
#include <ogrsf_frmts.h>

#include <cmath>

#include "materials/base/error.hpp"
#include "materials/base/plain_text.hpp"
#include "terrain/raster/crs.hpp"
#include "terrain/raster/gdal_file.hpp"
#include "terrain/raster/quiet_gdal.hpp"
#include "terrain/raster/written_height.hpp"

namespace diurna {

namespace {

constexpr std::size_t most_ring_corners = 1'000'000;
struct NoPlace {
    std::string corner;
};

/// Throws NoPlace for a corner that is none on Earth: without it, the shape would be another.
std::vector<Geodetic> corners_of(const OGRLineString& line, OGRCoordinateTransformation& shift) {
    std::vector<double> x, y;
    for (int i = 0; i < line.getNumPoints(); ++i) {
        x.push_back(line.getX(i));
        y.push_back(line.getY(i));
    }
    const std::vector<int> good = transform(shift, x, y);
    std::vector<Geodetic> corners;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const bool on_earth = good[i] && std::abs(x[i]) <= 360.0 && std::abs(y[i]) <= 90.0;
        if (!on_earth) {
            const int k = static_cast<int>(i);
            throw NoPlace{fmt::format("{:g}, {:g}", line.getX(k), line.getY(k))};
        }
        corners.push_back({y[i], x[i], 0.0});
    }
    return corners;
}

std::vector<Geodetic> ring_of(const OGRLineString& line, OGRCoordinateTransformation& shift) {
    auto ring = corners_of(line, shift);
    if (ring.size() > 1 && ring.front().latitude_deg == ring.back().latitude_deg &&
        ring.front().longitude_deg == ring.back().longitude_deg) {
        ring.pop_back();
    }
    return ring;
}

/// Appends the polygons and lines of a geometry, however nested.
void append(std::vector<LandShape>& shapes, const OGRGeometry& geometry, const LandShape& like,
            OGRCoordinateTransformation& shift) {
    switch (wkbFlatten(geometry.getGeometryType())) {
        case wkbPolygon: {
            const OGRPolygon& polygon = *geometry.toPolygon();
            LandShape shape = like;
            if (polygon.getExteriorRing() == nullptr) return;
            shape.ring = ring_of(*polygon.getExteriorRing(), shift);
            for (int i = 0; i < polygon.getNumInteriorRings(); ++i) {
                shape.hole.push_back(ring_of(*polygon.getInteriorRing(i), shift));
            }
            if (shape.ring.size() >= 3) shapes.push_back(std::move(shape));
            return;
        }
        case wkbLineString: {
            LandShape shape = like;
            shape.line = true;
            shape.ring = corners_of(*geometry.toLineString(), shift);
            if (shape.ring.size() >= 2) shapes.push_back(std::move(shape));
            return;
        }
        case wkbMultiPolygon:
        case wkbMultiLineString:
        case wkbGeometryCollection:
            for (const OGRGeometry* part : *geometry.toGeometryCollection()) {
                append(shapes, *part, like, shift);
            }
            return;
        default:
            return;  // points and curves lay down no ground
    }
}

int field_index(OGRLayer& layer, const std::string& field, const std::string& where) {
    if (field.empty()) return -1;
    const int found = layer.GetLayerDefn()->GetFieldIndex(field.c_str());
    if (found >= 0) return found;
    std::vector<std::string> names;
    for (int i = 0; i < layer.GetLayerDefn()->GetFieldCount(); ++i) {
        names.emplace_back(layer.GetLayerDefn()->GetFieldDefn(i)->GetNameRef());
    }
    const std::string hint = did_you_mean(field, names);
    throw InputError(where, fmt::format("has no field \"{}\"", field),
                     hint.empty() ? fmt::format("fields: {}", fmt::join(names, ", ")) : hint);
}

/// [m]; NaN where the field is empty. Throws InputError(where) for a text that is no height.
double height_of(const OGRFeature& feature, int field, const std::string& where) {
    if (!feature.IsFieldSetAndNotNull(field)) return std::nan("");
    if (feature.GetFieldDefnRef(field)->GetType() != OFTString) {
        return feature.GetFieldAsDouble(field);
    }
    const std::string text = feature.GetFieldAsString(field);
    if (text.find_first_not_of(" \t") == std::string::npos) return std::nan("");
    const auto height = written_height(text);
    if (!height) {
        throw InputError(where,
                         fmt::format("found '{}', expected a height such as 12.5, \"12.5 m\" or "
                                     "\"41 ft\"",
                                     plain(text.substr(0, 40))),
                         "correct it in the file, or leave it empty and set height_m");
    }
    return *height;
}

/// Layers that are read: the one named, all, or the only one that has features with shapes.
std::vector<OGRLayer*> layers_of(GDALDataset& data, const std::string& layer,
                                 const std::filesystem::path& file) {
    std::vector<OGRLayer*> all, shaped;
    std::vector<std::string> names;
    for (OGRLayer* one : data.GetLayers()) {
        all.push_back(one);
        const bool shapes = one->GetGeomType() != wkbNone &&
                            wkbFlatten(one->GetGeomType()) != wkbPoint &&
                            one->GetFeatureCount() != 0;
        if (!shapes) continue;
        shaped.push_back(one);
        names.emplace_back(one->GetName());
    }
    if (layer == "*") return all;
    if (!layer.empty()) {
        for (OGRLayer* one : all) {
            if (layer == one->GetName()) return {one};
        }
        const std::string hint = did_you_mean(layer, names);
        throw InputError(file.string(), fmt::format("has no layer \"{}\"", layer),
                         hint.empty() ? fmt::format("layers: {}", fmt::join(names, ", ")) : hint);
    }
    if (shaped.size() > 1) {
        throw InputError(
            file.string(),
            fmt::format("has {} layers of shapes: {}", shaped.size(), fmt::join(names, ", ")),
            fmt::format("select one: layer = \"{}\", or layer = \"*\" for all", names.front()));
    }
    return shaped.empty() ? all : shaped;
}

}  // namespace

std::vector<ShapeLayer> shape_layers(const std::filesystem::path& file,
                                     const std::optional<Confines>& confines) {
    const QuietGdal gdal;
    const GdalGate gate(confines ? *confines : confines_of(file));
    const auto data = open_gdal_file(file, GdalUse::shapes, gdal, gate);
    std::vector<ShapeLayer> layers;
    for (OGRLayer* one : data->GetLayers()) {
        layers.push_back({one->GetName(), one->GetFeatureCount()});
    }
    return layers;
}

std::vector<LandShape> read_shapes(const std::filesystem::path& file, const std::string& kind_field,
                                   const std::string& height_field,
                                   const std::optional<Confines>& confines,
                                   const std::string& layer_name) {
    const QuietGdal gdal;
    const GdalGate gate(confines ? *confines : confines_of(file));
    const auto data = open_gdal_file(file, GdalUse::shapes, gdal, gate);
    // A CRS that is to be fetched, or read of another file, would be WGS84 in place of it.
    if (!gdal.because().empty()) {
        throw InputError(file.string(), "cannot be read" + gdal.because());
    }
    std::vector<LandShape> shapes;
    std::size_t corners = 0, features = 0;
    for (OGRLayer* layer : layers_of(*data, layer_name, file)) {
        const int kind = field_index(*layer, kind_field, file.string());
        const int height = field_index(*layer, height_field, file.string());
        const OGRSpatialReference* named = layer->GetSpatialRef();
        if (!named || named->IsEmpty()) {
            throw InputError(file.string(), "has no coordinate reference system");
        }
        OGRSpatialReference own = *named;
        own.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
        const Transformation shift = transformation(own, wgs84());
        if (!shift) throw InputError(file.string(), "its CRS cannot be converted to WGS84");
        for (const auto& feature : *layer) {
            ++features;
            if (feature->GetGeometryRef() == nullptr) continue;
            LandShape like;
            like.feature = features;
            if (kind >= 0) like.kind = plain(feature->GetFieldAsString(kind));
            if (height >= 0) {
                like.height = height_of(
                    *feature, height,
                    fmt::format("{}: feature {}: {}", file.string(), features, height_field));
            }
            const std::size_t before = shapes.size();
            try {
                append(shapes, *feature->GetGeometryRef(), like, *shift);
            } catch (const NoPlace& none) {
                throw InputError(
                    file.string(),
                    fmt::format("shape {} has a corner at {}, which is not a place on Earth",
                                features, none.corner));
            }
            for (std::size_t i = before; i < shapes.size(); ++i) corners += shapes[i].ring.size();
            if (corners > most_ring_corners) {
                throw InputError(file.string(), "has more than a million corners");
            }
        }
    }
    if (shapes.empty()) {
        throw InputError(file.string(),
                         fmt::format("has no polygon or line ({} features)", features));
    }
    return shapes;
}

}  // namespace diurna
