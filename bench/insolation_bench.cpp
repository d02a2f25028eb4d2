// What a mesh's tolerance does to the sun it takes in: beam per facet against the mean over the
// raster's own triangles under it, by the facet's own normal with rays, and as `ReliefVisibility`
// carries it. rms by area over the ground, share of the beam on a level plane at 900 W/m², for
// three suns.

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <map>

#include "terrain/ground/ground_mesh.hpp"
#include "terrain/raster/dem_places.hpp"
#include "terrain/raster/read_dem.hpp"
#include "terrain/relief/relief_sun.hpp"
#include "terrain/visibility/relief_visibility.hpp"
#include "terrain/visibility/sun_fraction.hpp"

using namespace diurna;

namespace {

/// Cosine of incidence on the raster's triangle at a place between posts.
double incidence(const HeightField& relief, double x, double y, const Eigen::Vector3d& sun) {
    const int column = std::min(int(x), relief.columns() - 2);
    const int row = std::min(int(y), relief.rows() - 2);
    const double a = relief.up(row, column), b = relief.up(row, column + 1);
    const double c = relief.up(row + 1, column), d = relief.up(row + 1, column + 1);
    const Eigen::Vector2d rise =
        x - column >= y - row ? Eigen::Vector2d(b - a, d - b) : Eigen::Vector2d(d - c, c - a);
    const Eigen::Vector2d slope = relief.jacobian({x, y}).transpose().inverse() * rise;
    return std::max(0.0, Eigen::Vector3d(-slope.x(), -slope.y(), 1.0).normalized().dot(sun));
}

/// Each facet's mean beam over the fine relief under it; NaN where there is none.
std::vector<double> fine_means(const HeightField& relief, const FacetSet& facets,
                               const std::vector<float>& lit, const Eigen::Vector3d& sun) {
    std::vector<double> means(facets.size(), std::nan(""));
    for (std::size_t f = 0; f < facets.size(); ++f) {
        std::array<Eigen::Vector2d, 3> p;
        for (std::size_t k = 0; k < 3; ++k) {
            p[k] = relief.post(facets.vertex[facets.corner[f][k]].head<2>().cast<double>());
        }
        const Eigen::Vector2d low = p[0].cwiseMin(p[1]).cwiseMin(p[2]);
        const Eigen::Vector2d high = p[0].cwiseMax(p[1]).cwiseMax(p[2]);
        double sum = 0.0;
        int count = 0;
        // Four times as dense as posts, so that a triangle between posts has some too.
        for (double y = std::ceil(4 * low.y() - 0.5) / 4 + 0.125; y <= high.y(); y += 0.25) {
            for (double x = std::ceil(4 * low.x() - 0.5) / 4 + 0.125; x <= high.x(); x += 0.25) {
                const auto turn = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
                    return (b.x() - a.x()) * (y - a.y()) - (x - a.x()) * (b.y() - a.y());
                };
                const double a = turn(p[0], p[1]), b = turn(p[1], p[2]), c = turn(p[2], p[0]);
                if (!((a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0))) continue;
                const auto row = std::min(relief.rows() - 1, int(std::lround(y)));
                const auto column = std::min(relief.columns() - 1, int(std::lround(x)));
                if (row < 0 || column < 0 || x < 0.0 || y < 0.0) continue;
                sum += lit[std::size_t(row) * relief.columns() + column] *
                       incidence(relief, x, y, sun);
                ++count;
            }
        }
        if (count > 0) means[f] = sum / count;
    }
    return means;
}

}  // namespace

int main(int argc, char** argv) {
    const std::filesystem::path file =
        argc > 1 ? argv[1] : DIURNA_SOURCE_DIR "/scenes/jacksboro/elevation.tif";
    const Dem dem = read_dem(file, {.voids = VoidPolicy::fill});
    const Geodetic centre = dem_centre(dem);
    const Site site{centre.latitude_deg, centre.longitude_deg, centre.height};
    const HeightField relief = height_field(dem, site);
    fmt::print("case,method,setting,facets,threads,wall_s,error,unit\n");
    for (const double tolerance : {40.0, 20.0, 10.0, 5.0, 2.0, 1.0}) {
        const GroundMesh mesh = ground_mesh(dem, tolerance);
        FacetSet facets;
        append_facets(facets, local_vertices(dem, site, mesh.place, mesh.height), mesh.triangle,
                      std::vector<MaterialId>(mesh.triangle.size()), ObjectId{0});
        const RayScene rays(facets);
        const ReliefVisibility light(facets, rays, relief, facets.size());
        std::map<std::string, double> squares;
        double area = 0.0;
        for (const double elevation_deg : {15.0, 35.0, 60.0}) {
            const Eigen::Vector3d sun = direction(90.0 + 2.0 * elevation_deg, elevation_deg);
            std::vector<float> lit(relief.size()), carried(facets.size()), own(facets.size());
            sun_fraction(relief, sun, lit);
            const std::vector<double> exact = fine_means(relief, facets, lit, sun);
            light.sun_fraction(sun, carried);
            sun_fraction(facets, rays, sun, own);
            for (std::size_t f = 0; f < facets.size(); ++f) {
                if (std::isnan(exact[f])) continue;
                const double cosine = std::max(0.0f, facets.normal[f].dot(sun.cast<float>()));
                const double a = facets.area[f];
                squares["own_normal"] += a * std::pow(cosine * own[f] - exact[f], 2);
                squares["carried_mean"] += a * std::pow(cosine * carried[f] - exact[f], 2);
                area += a;
            }
        }
        for (const auto& [method, sum] : squares) {
            fmt::print("{},{},tolerance {} m,{},1,0,{:.1f},W m-2\n", file.stem().string(), method,
                       tolerance, facets.size(), 900.0 * std::sqrt(sum / area));
        }
    }
}
