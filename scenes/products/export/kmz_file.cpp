#include "scenes/products/export/kmz_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/base/files_read.hpp"
#include "materials/base/made_by.hpp"
#include "render/picture/colour_png.hpp"
#include "render/picture/palette.hpp"
#include "scenes/charts/html.hpp"
#include "scenes/job/world/elevation.hpp"
#include "scenes/products/export/heat_raster.hpp"
#include "scenes/products/export/zip_file.hpp"
#include "terrain/place/local_time.hpp"
#include "terrain/raster/dem_places.hpp"

namespace diurna {

namespace {

constexpr int most_pixels = 2048;  // a side

/// Pixels on latitude and longitude, and the post that each shows.
struct Overlay {
    double south, north, west, east;  // [°] outer edges
    int columns, rows;
    std::vector<std::ptrdiff_t> post;  // (row, column) from the north; −1: none
};

/// Of the posts that have facets.
Overlay overlay_of(const Dem& dem, const PostFacets& posts) {
    std::vector<Eigen::Vector2d> place;
    std::vector<float> height;
    for (std::size_t p = 0; p + 1 < posts.begin.size(); ++p) {
        if (posts.begin[p + 1] == posts.begin[p]) continue;
        const auto across = std::size_t(dem.columns);
        place.emplace_back(double(p % across), double(p / across));
        height.push_back(0.0f);
    }
    if (place.empty()) throw InputError(dem.source, "has no ground facets");
    Eigen::Vector2d low = place.front(), high = low;
    for (const Eigen::Vector2d& at : place) {
        low = low.cwiseMin(at);
        high = high.cwiseMax(at);
    }
    const auto count = [](double ways) { return std::clamp(int(ways) + 1, 2, most_pixels); };
    Overlay overlay{
        90.0, -90.0, 180.0, -180.0, count(high.x() - low.x()), count(high.y() - low.y()), {}};
    for (const Geodetic& at : geodetic_places(dem, place, height)) {
        overlay.south = std::min(overlay.south, at.latitude_deg);
        overlay.north = std::max(overlay.north, at.latitude_deg);
        overlay.west = std::min(overlay.west, at.longitude_deg);
        overlay.east = std::max(overlay.east, at.longitude_deg);
    }
    if (overlay.east - overlay.west > 180.0) {
        throw InputError(dem.source, "crosses the date line, which KML overlays cannot");
    }
    const double dx = (overlay.east - overlay.west) / (overlay.columns - 1);
    const double dy = (overlay.north - overlay.south) / (overlay.rows - 1);
    std::vector<Geodetic> pixel;
    for (int row = 0; row < overlay.rows; ++row) {
        for (int column = 0; column < overlay.columns; ++column) {
            pixel.push_back({overlay.north - dy * row, overlay.west + dx * column, 0.0});
        }
    }
    for (const Eigen::Vector2d& at : raster_places(dem, pixel)) {
        const double column = std::round(at.x()), row = std::round(at.y());
        const bool inside = column >= 0 && row >= 0 && column < dem.columns && row < dem.rows;
        overlay.post.push_back(inside ? std::ptrdiff_t(row) * dem.columns + std::ptrdiff_t(column)
                                      : -1);
    }
    overlay.south -= 0.5 * dy;
    overlay.north += 0.5 * dy;
    overlay.west -= 0.5 * dx;
    overlay.east += 0.5 * dx;
    return overlay;
}

std::string picture(const Overlay& overlay, const Plane& plane, const ColourScale& scale) {
    std::vector<std::uint8_t> pixels(4 * overlay.post.size(), 0);
    for (std::size_t k = 0; k < overlay.post.size(); ++k) {
        if (overlay.post[k] < 0) continue;
        const float kelvin = plane.pixel[std::size_t(overlay.post[k])];
        if (!std::isfinite(kelvin)) continue;
        const double t = (in_colour_unit(plane, kelvin) - scale.low) / (scale.high - scale.low);
        const Rgb colour = warm_colour(std::clamp(t, 0.0, 1.0));
        std::copy(colour.begin(), colour.end(), pixels.begin() + std::ptrdiff_t(4 * k));
        pixels[4 * k + 3] = 255;
    }
    const std::vector<std::byte> png = encode_rgba_png(overlay.columns, overlay.rows, pixels);
    return {reinterpret_cast<const char*>(png.data()), png.size()};
}

std::string picture_name(Instant when) {
    return fmt::format("pictures/{}.png", format_instant(when, true));
}

std::string kml(const Overlay& overlay, const RunHeat& heat, const Scene& scene,
                const ColourScale& scale, std::span<const Instant> instants) {
    std::string text = fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- {}, with {} -->\n"
        "<kml xmlns=\"http://www.opengis.net/kml/2.2\">\n<Document>\n<name>{}</name>\n"
        "<description>temperature of the ground, colours from {:g} to {:g} degC</description>\n",
        made_by(), made_with(), escaped(scene.name), scale.low, scale.high);
    for (std::size_t i = 0; i < instants.size(); ++i) {
        const Instant end = i + 1 < instants.size() ? instants[i + 1]
                            : i > 0
                                ? later(instants[i], seconds_between(instants[i - 1], instants[i]))
                                : later(instants[i], 3600.0);
        text += fmt::format(
            "<GroundOverlay>\n<name>{}</name>\n<TimeSpan><begin>{}</begin><end>{}</end></"
            "TimeSpan>\n"
            "<Icon><href>{}</href></Icon>\n<LatLonBox><north>{:.9f}</north><south>{:.9f}</south>"
            "<east>{:.9f}</east><west>{:.9f}</west></LatLonBox>\n</GroundOverlay>\n",
            format_local(instants[i], heat.mesh.utc_offset), format_instant(instants[i]),
            format_instant(end), picture_name(instants[i]), overlay.north, overlay.south,
            overlay.east, overlay.west);
    }
    return text + "</Document>\n</kml>\n";
}

}  // namespace

ColourScale write_kmz(const std::filesystem::path& file, const RunHeat& heat, const Scene& scene,
                      std::span<const Instant> instants) {
    const FilesRead opened;
    const std::size_t ground = ground_objects(scene, heat);
    const Dem dem = elevation_of(scene);
    check_output_file(file, opened.files());
    const PostFacets posts = facets_of_posts(dem, heat.mesh, ground);
    const Overlay overlay = overlay_of(dem, posts);
    std::vector<Plane> planes;
    for (const Instant when : instants) {
        planes.push_back({"temperature", "K", on_posts(posts, heat_at(heat, when).kelvin)});
    }
    ColourScale scale = colour_scale(planes.front());
    for (const Plane& plane : planes) {
        const ColourScale own = colour_scale(plane);
        scale = {std::min(scale.low, own.low), std::max(scale.high, own.high)};
    }
    std::vector<ZipEntry> entries{{"doc.kml", kml(overlay, heat, scene, scale, instants)}};
    for (std::size_t i = 0; i < instants.size(); ++i) {
        entries.push_back({picture_name(instants[i]), picture(overlay, planes[i], scale)});
    }
    write_whole_file(file, zip_archive(entries));
    return scale;
}

}  // namespace diurna
