#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/run/scene_sky_view.hpp"
#include "scenes/job/run/sun_exposure.hpp"
#include "scenes/job/store/stage_keys.hpp"
#include "scenes/job/world/elevation.hpp"
#include "scenes/job/world/ground_point.hpp"
#include "terrain/ground/tin_check.hpp"
#include "terrain/place/sun.hpp"
#include "terrain/raster/dem_places.hpp"
#include "terrain/raster/geotiff.hpp"
#include "tests/support/crate.hpp"
#include "tests/support/detailed_relief.hpp"
#include "tests/support/small_scene.hpp"

// A scene on level ground of posts 30 m apart, and in its middle a raster of posts 1 m apart on
// which a wall of earth 3 m high stands, a platform and no more.

using namespace diurna;
using detailed_relief::lattice;

namespace {

constexpr double level = 300.0, wall = 3.0, platform = 2.0;  // [m]
constexpr int posts = 181;                                   // of the fine raster
constexpr int wall_column = 80;

const char* const map = "EPSG:32616";
Dem coarse_lattice() { return lattice("coarse", map, 41, 41, 750400.0, 4024600.0, 30.0); }
Dem fine_lattice() { return lattice("fine", map, posts, posts, 750914.3, 4024091.8, 1.0); }

/// The fine raster's heights: the wall runs from north to south, the platform is 21 m square.
Dem fine_raster() {
    Dem fine = fine_lattice();
    std::fill(fine.height.begin(), fine.height.end(), float(level));
    for (int row = 0; row < posts; ++row) {
        fine.height[std::size_t(row) * posts + wall_column] = float(level + wall);
    }
    for (int row = 40; row <= 60; ++row) {
        for (int column = 130; column <= 150; ++column) {
            fine.height[std::size_t(row) * posts + std::size_t(column)] = float(level + platform);
        }
    }
    return fine;
}

Geodetic place_of(const Dem& dem, const Eigen::Vector2d& post) {
    const float height = float(level);
    return geodetic_places(dem, {&post, 1}, {&height, 1}).front();
}

const Site& site() {
    static const Geodetic centre = place_of(fine_lattice(), {90.0, 90.0});
    static const Site here{centre.latitude_deg, centre.longitude_deg, level};
    return here;
}

/// East and north [m] of a post of the fine raster.
Eigen::Vector2d local(double column, double row) {
    return to_local(site(), place_of(fine_lattice(), {column, row})).head<2>();
}

const char* const detail_table = R"([[terrain.detail]]
elevation = "fine.tif"
tolerance_m = 0.02
blend_m = 15.0
)";

/// On the wall's crest.
std::string eye_table() {
    const Eigen::Vector2d crest = local(wall_column, 70.0);
    return fmt::format(
        "[[observer]]\nname = \"eye\"\nplace_m = [{:.4f}, {:.4f}]\nheight_above_ground_m = 1.7\n"
        "azimuth_deg = 90.0\nelevation_deg = 0.0\nwidth = 8\nheight = 6\nbands = [\"8-12\"]\n",
        crest.x(), crest.y());
}

struct Place {
    ScratchFolder folder{"detail"};

    Place() {
        Dem coarse = coarse_lattice();
        std::fill(coarse.height.begin(), coarse.height.end(), float(level));
        write_geotiff(folder.path / "coarse.tif", coarse, {{"height", coarse.height, "m"}});
        write(fine_raster());
        write_text(folder.path / "crate.obj", crate_mesh);
    }
    void write(const Dem& fine) const {
        write_geotiff(folder.path / "fine.tif", fine, {{"height", fine.height, "m"}});
    }

    Scene scene(const std::string& detail, const std::string& more = "") const {
        const std::string weather = DIURNA_SOURCE_DIR "/scenes/jacksboro/weather.csv";
        write_text(folder.path / "scene.toml",
                   fmt::format("[scene]\nname = \"detail\"\nsky_rays = 1024\nsun_samples = 16\n"
                               "[site]\nlatitude_deg = {:.9f}\nlongitude_deg = {:.9f}\n"
                               "[terrain]\nelevation = \"coarse.tif\"\ntolerance_m = 0.5\n"
                               "material = \"grass\"\n",
                               site().latitude_deg, site().longitude_deg) +
                       detail + more + eye_table() + "[weather]\nfile = \"" + weather +
                       "\"\ninterval = \"instant\"\n[time]\nstart = 2026-07-15T00:00:00-04:00\n"
                       "step_s = 1200.0\nframe_every_s = 21600.0\n");
        return read_scene(folder.path / "scene.toml", {}, true);
    }
    std::string refusal(const std::string& detail) const {
        try {
            prepare(scene(detail));
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }
};

/// A strip of ground east of the wall, from `near` to `far` [m] and 60 m along it.
struct Strip {
    static constexpr double near = 1.1, far = 9.1, along = 60.0;
    Eigen::Vector2d middle = local(wall_column, 90), ahead, across;
    Strip() {
        const Eigen::Vector2d north = local(wall_column, 80) - local(wall_column, 100);
        ahead = north.normalized();
        across = {ahead.y(), -ahead.x()};
    }
    std::string table() const {
        const Eigen::Vector2d centre = middle + 0.5 * (near + far) * across;
        return fmt::format(
            "[[ground]]\nname = \"strip\"\nmaterial = \"asphalt\"\nlargest_edge_m = 1.0\n"
            "rectangle_m = [{:.4f}, {:.4f}, {}, {:.4f}, {:.6f}]\n",
            centre.x(), centre.y(), along, far - near,
            std::atan2(ahead.x(), ahead.y()) * 180.0 / M_PI);
    }
};

std::vector<std::size_t> facets_of(const World& world, const std::string& name) {
    std::vector<std::size_t> found;
    for (std::size_t f = 0; f < world.facets.size(); ++f) {
        if (world.objects[std::size_t(world.facets.object[f])] == name) found.push_back(f);
    }
    return found;
}

}  // namespace

TEST_CASE("what only the detail shows casts its shadow and hides its sky", "[scenes][detail]") {
    const Place place;
    const Strip strip;
    const Prepared prepared = prepare(place.scene(detail_table, strip.table()));
    const FacetSet& facets = prepared.world.facets;
    const std::vector<std::size_t> ground = facets_of(prepared.world, "strip");
    REQUIRE(ground.size() > 500);
    double area = 0.0;
    for (const std::size_t f : ground) area += facets.area[f];
    CHECK(area == Approx(Strip::along * (Strip::far - Strip::near)).epsilon(2e-3));
    CHECK(prepared.world.ground_check.worst_on_detail <= 0.02 + 1e-3);

    const Instant evening = parse_instant("2026-07-15T17:40:00-04:00");
    const SunExposure sun = scene_sun_exposure(prepared, {evening});
    double shaded = 0.0;
    for (const std::size_t f : ground) shaded += facets.area[f] * (1.0 - sun.fraction[f]);
    // h / tan(elevation), what of it lies across the wall; the foot is 1.1 m off its crest.
    const Eigen::Vector3d towards = sun_direction(sun_position(site(), evening));
    const double elevation = std::asin(towards.z());
    const double across =
        -towards.head<2>().normalized().dot(strip.across) * wall / std::tan(elevation);
    CAPTURE(degrees(elevation), across);
    REQUIRE(across > 3.0);
    REQUIRE(across < 8.0);
    CHECK(shaded / Strip::along == Approx(across - Strip::near).margin(0.15));

    // A horizontal place before a wall without end sees (1 + cos γ) / 2 of the sky, tan γ = h / d.
    const FacetViews views = scene_sky_view(prepared);
    double off = 0.0, worst = 0.0;
    for (const std::size_t f : ground) {
        const Eigen::Vector2d to = facets.centroid[f].head<2>().cast<double>() - strip.middle;
        const double distance = to.dot(strip.across);
        const double sky = 0.5 * (1.0 + std::cos(std::atan2(wall, distance)));
        off += (views.sky[f] - sky) / double(ground.size());
        worst = std::max(worst, std::abs(views.sky[f] - sky));
    }
    CHECK(std::abs(off) < 3e-3);
    CHECK(worst < 0.03);

    // Without the detail the plain is bare.
    const Prepared plain = prepare(place.scene("", strip.table()));
    const SunExposure bare = scene_sun_exposure(plain, {evening});
    for (const std::size_t f : facets_of(plain.world, "strip")) {
        REQUIRE(bare.fraction[f] == Approx(1.0f).margin(1e-4));
    }
    CHECK(plain.world.on_detail.empty());

    // Kept stages know which facets have their light by rays.
    const std::string marked = visibility_key(prepared);
    World unmarked = prepared.world;
    std::fill(unmarked.on_detail.begin(), unmarked.on_detail.end(), 0);
    RayScene rays(unmarked.facets, {}, unmarked.copies);
    const Prepared other(prepared.parts, std::make_shared<const ScenePlace>(
                                             ScenePlace{std::move(unmarked), std::move(rays)}));
    CHECK(visibility_key(other) != marked);
}

TEST_CASE("objects on a detail are placed at its heights", "[scenes][detail]") {
    const Place place;
    const Eigen::Vector2d on = local(140.0, 50.0), crest = local(wall_column, 70.0);
    const std::string more = fmt::format(
        "[[object]]\nname = \"crate\"\nmesh = \"crate.obj\"\nmaterial = \"painted_steel\"\n"
        "place_m = [{:.4f}, {:.4f}]\n",
        on.x(), on.y());
    const Scene scene = place.scene(detail_table, more);
    const Prepared prepared = prepare(scene);
    const Dem dem = elevation_of(scene);
    CHECK(ground_point(dem, site(), crest, "crest").z() == Approx(wall).margin(0.01));
    REQUIRE(prepared.sequences.size() == 1);
    CHECK(prepared.sequences.front().pose.front().position.z() == Approx(wall + 1.7).margin(0.01));
    double foot = 1e9;
    for (const std::size_t f : facets_of(prepared.world, "crate")) {
        for (const std::uint32_t v : prepared.world.facets.corner[f]) {
            foot = std::min(foot, double(prepared.world.facets.vertex[v].z()));
        }
    }
    CHECK(foot == Approx(platform).margin(0.01));
}

TEST_CASE("a detail's faults are reported in one line each", "[scenes][detail][stress]") {
    const Place place;
    Dem fine = fine_raster();
    fine.height[7000] = std::nanf("");
    place.write(fine);
    CHECK(place.refusal(detail_table)
              .find("fine.tif: no elevation at 1 post (0.0031 %) (voids = \"fill\" interpolates "
                    "them") != std::string::npos);
    {
        const Prepared filled =
            prepare(place.scene(std::string(detail_table) + "voids = \"fill\"\n"));
        CHECK(filled.world.filled_facets > 0);
        CHECK(filled.world.filled_facets < 40);
    }

    fine = fine_raster();
    fine.transform[0] += 1e5;
    place.write(fine);
    const std::string outside = place.refusal(detail_table);
    CHECK(outside.find("fine.tif: is entirely outside ") != std::string::npos);
    CHECK(outside.find("coarse.tif") != std::string::npos);
    CHECK(std::count(outside.begin(), outside.end(), '\n') == 0);

    fine = fine_raster();
    for (float& height : fine.height) height /= 0.3048f;
    place.write(fine);
    const auto step_reported = [](const Prepared& prepared) {
        return std::count_if(prepared.notes.begin(), prepared.notes.end(), [](const auto& note) {
            return note.find("in the blending strip") != std::string::npos;
        });
    };
    const Scene feet = place.scene(std::string(detail_table) + "height_unit = \"ft\"\n");
    CHECK(step_reported(prepare(feet)) == 0);
    CHECK(ground_point(elevation_of(feet), site(), local(wall_column, 70.0), "crest").z() ==
          Approx(wall).margin(0.01));
    CHECK(step_reported(prepare(place.scene(detail_table))) == 1);  // taken for metres
}

TEST_CASE("of several rasters of land cover the first that knows a material wins",
          "[scenes][detail][land]") {
    const Place place;
    const auto classes = [&](const char* name, Dem raster, float inner, float outer) {
        for (int row = 0; row < raster.rows; ++row) {
            for (int column = 0; column < raster.columns; ++column) {
                raster
                    .height[std::size_t(row) * std::size_t(raster.columns) + std::size_t(column)] =
                    column < raster.columns / 2 ? inner : outer;
            }
        }
        write_geotiff(place.folder.path / name, raster, {{"class", raster.height}});
    };
    // 100 m of 1 m cells about the site, its west of class 1, its east of a class without material;
    // a kilometre of seconds of arc all about.
    classes("near.tif", lattice("near", map, 100, 100, 750954.8, 4024051.3, 1.0), 1.0f, 2.0f);
    classes("far.tif",
            lattice("far", "EPSG:4326", 40, 40, site().longitude_deg - 20.0 / 3600.0,
                    site().latitude_deg + 20.0 / 3600.0, 1.0 / 3600.0),
            7.0f, 7.0f);
    const Prepared prepared =
        prepare(place.scene("mesh = \"grid\"\n" + std::string(detail_table) +
                            "[[terrain.land_cover]]\nfile = \"near.tif\"\n"
                            "[terrain.land_cover.material]\n1 = \"asphalt\"\n"
                            "[[terrain.land_cover]]\nfile = \"far.tif\"\n"
                            "[terrain.land_cover.material]\n7 = \"sand\"\n1 = \"water\"\n"));
    const World& world = prepared.world;
    const Dem near = lattice("near", map, 100, 100, 750954.8, 4024051.3, 1.0);
    double asphalt = 0.0, sand = 0.0;
    for (std::size_t f = 0; f < world.ground_facets; ++f) {
        const MaterialId of = world.facets.material[f];
        const double plan = double{world.facets.area[f]} * world.facets.normal[f].z();
        if (of == prepared.scene.materials.find("asphalt")) asphalt += plan;
        if (of == prepared.scene.materials.find("sand")) sand += plan;
    }
    CHECK(asphalt == Approx(50.0 * 100.0).epsilon(0.03));
    // 40 by 40 seconds of arc less that: 30.83 m by 24.85 m each at 36.3 degrees north.
    CHECK(sand == Approx(40.0 * 30.82 * 40.0 * 24.91 - 5000.0).epsilon(0.03));
}
