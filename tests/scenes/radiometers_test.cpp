#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <sstream>

#include "materials/base/files.hpp"
#include "materials/base/units.hpp"
#include "scenes/job/run/radiometers.hpp"
#include "terrain/place/sun.hpp"
#include "tests/support/sheet_scene.hpp"

// Radiometers against view factors in closed form (Howell, A Catalog of Radiation Heat Transfer
// Configuration Factors, B-3: a small plane and a rectangle parallel to it, a corner on its
// normal), and against the balance of an endless plain.

using namespace diurna;
namespace over_plain = diurna::testing::over_plain;

namespace {

constexpr double sky = 401.1;  // [W m⁻²] that of a black sky at 290 K: even in all directions

/// From a small plane to a rectangle parallel to it, a corner of which lies on its normal at a
/// distance of 1; odd in both sides.
double view_of_corner(double x, double y) {
    const double rx = std::sqrt(1.0 + x * x), ry = std::sqrt(1.0 + y * y);
    return (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry)) / (2.0 * std::numbers::pi);
}
/// To the square of a metre that begins there.
double view_of_square(double x, double y) {
    return view_of_corner(x + 1.0, y + 1.0) - view_of_corner(x, y + 1.0) -
           view_of_corner(x + 1.0, y) + view_of_corner(x, y);
}

/// (column) of the row at a time of 2026-03-20.
std::map<std::string, double> row_at(const std::string& csv, const std::string& time) {
    std::istringstream lines(csv);
    std::string head, line;
    std::getline(lines, head);
    while (std::getline(lines, line)) {
        if (!line.starts_with("2026-03-20T" + time)) continue;
        std::map<std::string, double> row;
        std::istringstream names(head), values(line);
        std::string name, value;
        while (std::getline(names, name, ',') && std::getline(values, value, ',')) {
            if (name != "time") row[name] = std::stod(value);
        }
        return row;
    }
    return {};
}

struct Measured {
    Prepared prepared;
    SpanResult heat;
    std::map<std::string, std::string> csv{};  // by radiometer

    double kelvin(bool ground, bool up, double from, double to, Instant when) const {
        const std::vector<float> all = heat.temperature.interpolate(when);
        const FacetSet& facets = prepared.world.facets;
        double sum = 0.0, area = 0.0;
        for (std::size_t f = 0; f < facets.size(); ++f) {
            const double away = double(facets.centroid[f].head<2>().cwiseAbs().maxCoeff());
            if ((f < prepared.world.ground_facets) != ground || away < from || away > to) continue;
            if (up != (facets.normal[f].z() > 0.0f)) continue;
            sum += double(facets.area[f]) * double(all[f]);
            area += double(facets.area[f]);
        }
        return sum / area;
    }
};

/// A black plate of 4 m square 2 m above a plain, or a grey one.
Measured measured(double albedo, double emissivity) {
    const ScratchFolder folder("radiometers");
    over_plain::write_scene(folder.path, {.mesh = over_plain::level_square(4),
                                          .beam = 800.0,
                                          .longwave = sky,
                                          .albedo = albedo,
                                          .black = emissivity});
    std::string text = read_text(folder.path / "scene.toml");
    text +=
        "[[radiometer]]\nname = \"below\"\nplace_m = [0, 0]\nheight_above_ground_m = 1.0\n"
        "[[radiometer]]\nname = \"open\"\nplace_m = [110.0, 110.0]\n"
        "[[radiometer]]\nname = \"leaning\"\nplace_m = [110.0, 110.0]\nnormal = [0, 3, 3]\n";
    write_text(folder.path / "scene.toml", text);
    Prepared prepared = prepare(read_scene(folder.path / "scene.toml"));
    const Stages stages(prepared);
    Progress silent(ProgressStyle::silent);
    SpanResult heat = solve_scene(stages, silent);
    HeatReport report;
    write_radiometers(stages, heat, folder.path, report);
    CHECK(report.rows.size() == 3);  // a row each
    std::map<std::string, std::string> csv;
    for (const char* const name : {"below", "open", "leaning"}) {
        csv[name] = read_text(folder.path / fmt::format("radiometer_{}.csv", name));
    }
    return {std::move(prepared), std::move(heat), std::move(csv)};
}

double black(double kelvin) { return stefan_boltzmann * std::pow(kelvin, 4); }

}  // namespace

TEST_CASE("a radiometer below a black plate sees it by its view factor",
          "[scenes][radiometer][by_closed_form]") {
    const Measured of = measured(0.0, 1.0);
    const auto below = row_at(of.csv.at("below"), "12:00:00");
    REQUIRE(below.size() == 14);
    // Square by square: where the plate shades the ground it is cooler than at its edges.
    const std::vector<float> kelvin =
        of.heat.temperature.interpolate(parse_instant("2026-03-20T12:00:00Z"));
    const FacetSet& facets = of.prepared.world.facets;
    double expected = sky, warmest = 0.0, seen = 0.0;
    for (std::size_t f = of.prepared.world.ground_facets; f < facets.size(); ++f) {
        if (facets.normal[f].z() > 0.0f) continue;  // half a square each
        const double view = 0.5 * view_of_square(std::floor(double(facets.centroid[f].x())),
                                                 std::floor(double(facets.centroid[f].y())));
        seen += view;
        expected += view * (black(double(kelvin[f])) - sky);
        warmest = std::max(warmest, black(double(kelvin[f])));
    }
    CHECK(seen == Approx(0.831).margin(1e-3));  // of a square at half its half side
    CHECK(warmest > sky + 40.0);                // by the sun above: else nothing would be shown
    CHECK(below.at("longwave_down_W_m2") == Approx(expected).margin(0.005 * (warmest - sky)));
    // The sun stands above the plate; nothing reflects.
    CHECK(below.at("sun_in_view") == 0.0);
    CHECK(below.at("shortwave_down_W_m2") == 0.0);
}

TEST_CASE("a radiometer in the open measures the balance of an endless plain",
          "[scenes][radiometer][by_closed_form]") {
    const double albedo = 0.3, emissivity = 0.8;
    const Measured of = measured(albedo, emissivity);
    const Instant when = parse_instant("2026-03-20T12:00:00Z");
    const auto open = row_at(of.csv.at("open"), "12:00:00");
    REQUIRE(open.size() == 14);
    const double ground = of.kelvin(true, true, 16.0, 200.0, when);
    const double up = emissivity * black(ground) + (1.0 - emissivity) * sky;
    CHECK(open.at("sun_in_view") == 1.0);
    CHECK(open.at("shortwave_down_W_m2") == Approx(800.0).epsilon(1e-3));  // the sun at the zenith
    // 1.1 m above the weather's ground: 3 W/m2 less each 100 m (thermal/weather/sky_by_height.hpp).
    CHECK(open.at("longwave_down_W_m2") == Approx(sky - 0.04).margin(0.03));
    CHECK(open.at("shortwave_up_W_m2") == Approx(albedo * 800.0).epsilon(2e-3));
    CHECK(open.at("longwave_up_W_m2") == Approx(up).epsilon(1e-3));
    // By the equation of time the sun stands 1.9 degrees east of the zenith.
    const Eigen::Vector3d to_sun = sun_direction(sun_position(of.prepared.world.site, when));
    const std::array<std::pair<const char*, Eigen::Vector3d>, 4> sides = {
        {{"north", {0, 1, 0}}, {"east", {1, 0, 0}}, {"south", {0, -1, 0}}, {"west", {-1, 0, 0}}}};
    double shortwave = 0.06 * (800.0 + albedo * 800.0), longwave = 0.06 * (sky + up);
    for (const auto& [side, normal] : sides) {
        INFO(side);
        const double lit = 0.5 * albedo * 800.0 + 800.0 * std::max(0.0, normal.dot(to_sun));
        CHECK(open.at(fmt::format("shortwave_from_{}_W_m2", side)) == Approx(lit).margin(2.0));
        CHECK(open.at(fmt::format("longwave_from_{}_W_m2", side)) ==
              Approx(0.5 * (sky + up)).epsilon(2e-3));
        shortwave += 0.22 * lit;
        longwave += 0.22 * 0.5 * (sky + up);
    }
    // Höppe (1992), by hand.
    const double radiant =
        std::pow((0.7 * shortwave + 0.97 * longwave) / 0.97 / stefan_boltzmann, 0.25);
    CHECK(open.at("mean_radiant_temperature_K") == Approx(radiant).margin(0.2));

    const auto leaning = row_at(of.csv.at("leaning"), "12:00:00");
    REQUIRE(leaning.size() == 7);
    const double above = 0.5 * (1.0 + std::cos(radians(45.0)));  // of its view, the sky
    CHECK(leaning.at("sun_W_m2") == Approx(800.0 * std::cos(radians(45.0))).epsilon(5e-3));
    CHECK(leaning.at("reflected_W_m2") == Approx((1.0 - above) * albedo * 800.0).epsilon(0.015));
    CHECK(leaning.at("longwave_W_m2") == Approx(above * sky + (1.0 - above) * up).epsilon(1e-3));
}

TEST_CASE("radiometers that cannot stand where they are put are refused",
          "[scenes][radiometer][faults]") {
    const ScratchFolder folder("radiometers");
    over_plain::write_scene(
        folder.path,
        {.mesh = over_plain::block(-2, 2, -2, 2, 3.0), .height = 0.0, .longwave = sky});
    const std::string text = read_text(folder.path / "scene.toml");
    write_text(folder.path / "scene.toml",
               text + "[[radiometer]]\nname = \"within\"\nplace_m = [0, 0]\n");
    CHECK_THROWS_WITH(prepare(read_scene(folder.path / "scene.toml")),
                      Catch::Contains("radiometer \"within\"") && Catch::Contains("inside"));
    write_text(folder.path / "scene.toml",
               text + "[[radiometer]]\nname = \"r\"\nplace_m = [5, 5]\nnormal = [0, 0, 0]\n");
    CHECK_THROWS_WITH(read_scene(folder.path / "scene.toml"), Catch::Contains("no direction"));
    // One line each, which names what is right.
    for (const char* normal :
         {"\"up\"", "[1e300, 1e300, 0]", "[nan, 0, 1]", "[1, 0]", "[0, \"a\", 1]", "3"}) {
        write_text(folder.path / "scene.toml",
                   text + "[[radiometer]]\nname = \"r\"\nplace_m = [5, 5]\nnormal = " + normal);
        CAPTURE(normal);
        try {
            read_scene(folder.path / "scene.toml");
            FAIL("read without a mistake");
        } catch (const InputError& error) {
            CHECK(error.mistakes().size() == 1);
            CHECK_THAT(error.what(), Catch::Contains("expected \"six\" or an array of 3 numbers"));
        }
    }
    write_text(folder.path / "scene.toml",
               text + "[[radiometer]]\nname = \"r\"\nplace_m = [5, 5]\nheight_above_sea_m = 5e4\n");
    CHECK_THROWS_WITH(read_scene(folder.path / "scene.toml"),
                      Catch::Contains("found 50000, expected a number up to 20000"));
    write_text(folder.path / "scene.toml",
               text + "[[radiometer]]\nname = \"r\"\nplace_m = [5, 5]\nnormal = \"six\"\n");
    CHECK_FALSE(read_scene(folder.path / "scene.toml").radiometers.at(0).normal);
}
