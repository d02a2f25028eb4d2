#include "scenes/products/export/heat_raster.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/base/files_read.hpp"
#include "scenes/job/world/elevation.hpp"
#include "terrain/raster/dem_places.hpp"
#include "terrain/raster/geotiff.hpp"

namespace diurna {

namespace {

constexpr double touching = 0.01;  // [postings]

using Corners = std::array<Eigen::Vector2d, 3>;  // (column, row)

/// Whether a place lies in a triangle seen from above, or so near beside it.
bool touches(const Corners& corner, const Eigen::Vector2d& place, double turn) {
    for (std::size_t k = 0; k < 3; ++k) {
        const Eigen::Vector2d along = corner[(k + 1) % 3] - corner[k], to = place - corner[k];
        const double inside = turn * (along.x() * to.y() - along.y() * to.x());
        if (inside < -touching * along.norm()) return false;
    }
    return true;
}

/// Calls visit(post) for every post that a triangle touches.
template <class Visit>
void visit_posts(const Dem& dem, const Corners& corner, const Visit& visit) {
    const Eigen::Vector2d low = corner[0].cwiseMin(corner[1]).cwiseMin(corner[2]);
    const Eigen::Vector2d high = corner[0].cwiseMax(corner[1]).cwiseMax(corner[2]);
    if (!low.allFinite() || !high.allFinite()) return;
    const Eigen::Vector2d p = corner[1] - corner[0], q = corner[2] - corner[0];
    const double area = p.x() * q.y() - p.y() * q.x();
    if (area == 0.0) return;  // upright
    const auto from = [](double x) { return std::max(0.0, std::ceil(x - touching)); };
    const auto to = [](double x, int count) { return std::min(count - 1.0, x + touching); };
    for (double row = from(low.y()); row <= to(high.y(), dem.rows); ++row) {
        for (double column = from(low.x()); column <= to(high.x(), dem.columns); ++column) {
            if (!touches(corner, {column, row}, area > 0.0 ? 1.0 : -1.0)) continue;
            visit(std::size_t(row) * std::size_t(dem.columns) + std::size_t(column));
        }
    }
}

std::vector<Eigen::Vector2d> vertex_places(const Dem& dem, const TemperatureMesh& mesh) {
    std::vector<Geodetic> places;
    for (const Eigen::Vector3f& v : mesh.facets.vertex) {
        places.push_back(to_geodetic(mesh.site, v.cast<double>()));
    }
    return raster_places(dem, places);
}

/// Whether a name of the scene can stand in the file as that: what CF does not allow is "_" there.
bool is_written_as(const std::string& name, const std::string& written) {
    if (name.empty()) return written == "_";
    return std::equal(name.begin(), name.end(), written.begin(), written.end(),
                      [](char a, char b) { return a == b || b == '_'; });
}

}  // namespace

PostFacets facets_of_posts(const Dem& dem, const TemperatureMesh& mesh,
                           std::size_t ground_objects) {
    const std::vector<Eigen::Vector2d> place = vertex_places(dem, mesh);
    const FacetSet& facets = mesh.facets;
    PostFacets posts;
    posts.begin.assign(dem.height.size() + 1, 0);
    const auto each = [&](const auto& visit) {
        for (std::size_t f = 0; f < facets.size(); ++f) {
            if (static_cast<std::size_t>(facets.object[f]) >= ground_objects) continue;
            const auto& [a, b, c] = facets.corner[f];
            visit_posts(dem, {place[a], place[b], place[c]},
                        [&](std::size_t post) { visit(post, static_cast<std::uint32_t>(f)); });
        }
    };
    each([&](std::size_t post, std::uint32_t) { ++posts.begin[post + 1]; });
    for (std::size_t p = 1; p < posts.begin.size(); ++p) posts.begin[p] += posts.begin[p - 1];
    posts.facet.resize(posts.begin.back());
    std::vector<std::size_t> next(posts.begin.begin(), posts.begin.end() - 1);
    each([&](std::size_t post, std::uint32_t facet) { posts.facet[next[post]++] = facet; });
    return posts;
}

std::vector<float> on_posts(const PostFacets& posts, std::span<const float> kelvin) {
    std::vector<float> value(posts.begin.size() - 1, std::nanf(""));
    for (std::size_t p = 0; p < value.size(); ++p) {
        const std::size_t count = posts.begin[p + 1] - posts.begin[p];
        if (count == 0) continue;
        double sum = 0.0;
        for (std::size_t k = posts.begin[p]; k < posts.begin[p + 1]; ++k) {
            sum += kelvin[posts.facet[k]];
        }
        value[p] = static_cast<float>(sum / static_cast<double>(count));
    }
    return value;
}

std::size_t ground_objects(const Scene& scene, const RunHeat& heat) {
    std::vector<std::string> names{"ground"};
    for (const GroundPolygon& polygon : scene.terrain.polygons) names.push_back(polygon.name);
    const std::vector<std::string>& written = heat.mesh.objects;
    const bool same = names.size() <= written.size() &&
                      std::equal(names.begin(), names.end(), written.begin(), is_written_as);
    if (!same) {
        throw InputError(heat.file.string(),
                         fmt::format("belongs to another scene than {}: the ground is {}",
                                     scene.file.string(), fmt::join(written, ", ")));
    }
    return names.size();
}

std::size_t write_heat_geotiff(const std::filesystem::path& file, const RunHeat& heat,
                               const Scene& scene, std::span<const Instant> instants) {
    const FilesRead opened;
    const std::size_t ground = ground_objects(scene, heat);
    const Dem dem = elevation_of(scene);
    check_output_file(file, opened.files());
    const PostFacets posts = facets_of_posts(dem, heat.mesh, ground);
    if (posts.facet.empty()) {
        throw InputError(
            heat.file.string(),
            fmt::format("has no ground on {}: check that it belongs to that scene", dem.source));
    }
    std::vector<std::vector<float>> values;
    std::vector<RasterBand> bands;
    for (const Instant when : instants) {
        values.push_back(on_posts(posts, heat_at(heat, when).kelvin));
    }
    for (std::size_t i = 0; i < instants.size(); ++i) {
        bands.push_back({format_instant(instants[i]), values[i], "K"});
    }
    write_geotiff(file, dem, bands, TiffLayout::cloud);
    return static_cast<std::size_t>(std::count_if(values.front().begin(), values.front().end(),
                                                  [](float v) { return std::isfinite(v); }));
}

}  // namespace diurna
