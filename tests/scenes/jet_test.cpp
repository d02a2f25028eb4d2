#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>

#include "materials/air/moist_air.hpp"
#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/base/units.hpp"
#include "scenes/job/world/targets.hpp"
#include "terrain/objects/placed_mesh.hpp"
#include "tests/support/sheet_scene.hpp"
#include "thermal/surface/hot_jet.hpp"

using namespace diurna;
namespace over_plain = diurna::testing::over_plain;

namespace {

/// A slab whose skin has 75 kJ/m2K, too thin to conduct along it, under a film of 10 W/m2K and
/// nothing else.
constexpr double capacity = 1.5e-4 * 25000.0 * 20000.0;
over_plain::Given slab() {
    return {.mesh = over_plain::level_square(3, 0.02),
            .height = 2.0,
            .albedo = 1.0,
            .black = 0.0,
            .layer = "thickness_m = 0.00015, conductivity_W_mK = 1.6",
            .ground_edge = 1.0};
}

std::filesystem::path scene_file(const std::filesystem::path& folder,
                                 const over_plain::Given& given, const std::string& tables,
                                 const std::string& more = "") {
    over_plain::write_scene(folder, given);
    std::string text = read_text(folder / "scene.toml");
    const std::string end = "material = \"sheet\"\n";
    text.insert(text.rfind(end) + end.size(), tables);
    const auto put = [&](const std::string& old, const std::string& next) {
        text.replace(text.find(old), old.size(), next);
    };
    put("largest_edge_m = 2.0", "largest_edge_m = 0.13");
    put("object_sky_rays = 1024", "object_sky_rays = 64");
    put("sky_rays = 1024", "sky_rays = 64");
    put("interval = \"instant\"", "interval = \"instant\"\nlapse = 0.0");
    const std::string heat = "density_kg_m3 = 2000.0, heat_capacity_J_kgK = 500.0";
    text.replace(text.rfind(heat), heat.size(),
                 "density_kg_m3 = 25000.0, heat_capacity_J_kgK = 20000.0");
    const std::string start = "start = 2026-03-20T00:00:00Z\n";
    text.insert(text.find(start) + start.size(), "duration_h = 24\nstep_s = 300\n");
    write_text(folder / "scene.toml", text + more);
    return folder / "scene.toml";
}

std::string jet(const std::string& keys) {
    return "[[object.part]]\nname = \"*\"\nwelded = false\n[[object.jet]]\nname = \"exhaust\"\n" +
           keys;
}

struct Blown {
    Prepared prepared;
    std::vector<NetworkObject> network;
    std::string notes() const {
        std::string all;
        for (const NetworkObject& object : network) {
            for (const std::string& note : object.notes) all += note + "\n";
        }
        return all;
    }
};
Blown blown(const over_plain::Given& given, const std::string& tables,
            const std::string& more = "") {
    const ScratchFolder folder("jet");
    Prepared prepared = prepare(read_scene(scene_file(folder.path, given, tables, more)));
    std::vector<NetworkObject> network = targets(prepared.world, prepared.scene);
    return {std::move(prepared), std::move(network)};
}

struct Run {
    Prepared prepared;
    SpanResult result;
    std::vector<float> at(const std::string& time) const {
        return result.temperature.interpolate(parse_instant("2026-03-20T" + time + ":00Z"));
    }
    /// The facet that looks up next to a place.
    std::size_t facet_at(double east, double north, bool ground) const {
        const FacetSet& facets = prepared.world.facets;
        std::size_t best = 0;
        double least = 1e9;
        for (std::size_t f = 0; f < facets.size(); ++f) {
            if ((f < prepared.world.ground_facets) != ground || facets.normal[f].z() < 0.9f) {
                continue;
            }
            const double away = std::hypot(double(facets.centroid[f].x()) - east,
                                           double(facets.centroid[f].y()) - north);
            if (away < least) {
                least = away;
                best = f;
            }
        }
        return best;
    }
};
Run run(const over_plain::Given& given, const std::string& tables, const std::string& more = "") {
    const ScratchFolder folder("jet");
    Prepared prepared = prepare(read_scene(scene_file(folder.path, given, tables, more)));
    Progress silent(ProgressStyle::silent);
    SpanResult result = solve_scene(Stages(prepared), silent);
    return {std::move(prepared), std::move(result)};
}

constexpr const char* from_above =
    "outlet = [0.0, 0.0, 0.82]\ndirection = [0, 0, -1]\ndiameter_m = 0.1\nspeed_m_s = "
    "20.0\ntemperature_K = 500.0\n";

}  // namespace

TEST_CASE("a jet on a plate of facets has Martin's mean film", "[scenes][jet][by_comparison]") {
    // As tests/thermal/hot_jet_test.cpp, over facets of some 0.1 m: 8 diameters above the plate.
    const Blown on = blown(slab(), jet(from_above));
    REQUIRE(on.network.size() == 1);
    REQUIRE(on.network[0].jet.size() == 1);
    const FacetSet& facets = on.prepared.world.facets;
    const double radius = 0.7;
    double film = 0.0, area = 0.0, heat = 0.0;
    for (const NetworkObject::Jet::Face& face : on.network[0].jet[0].face) {
        const std::uint32_t f = on.network[0].facet[face.facet];
        heat += face.heat * double(facets.area[f]);
        if (facets.normal[f].z() < 0.9f || facets.centroid[f].head<2>().norm() > radius) continue;
        film += face.film * double(facets.area[f]);
        area += double(facets.area[f]);
    }
    const double kelvin = 0.5 * (500.0 + 288.15), height = on.prepared.world.sea_level_height;
    const double viscosity = 1.458e-6 * std::pow(kelvin, 1.5) / (kelvin + 110.4);
    const double conductivity =
        2.64638e-3 * std::pow(kelvin, 1.5) / (kelvin + 245.4 * std::pow(10.0, -12.0 / kelvin));
    const double reynolds = 20.0 * 0.1 * standard_pressure(height) / (287.05 * kelvin) / viscosity;
    const double rho = std::sqrt(area / std::numbers::pi) / 0.1;
    CAPTURE(rho, reynolds);
    CHECK(rho == Approx(7.0).margin(0.2));
    const double nusselt = (1.0 - 1.1 / rho) / (rho * (1.0 + 0.1 * 2.0 / rho)) * 2.0 *
                           std::sqrt(reynolds * (1.0 + 0.005 * std::pow(reynolds, 0.55))) *
                           std::pow(1005.0 * viscosity / conductivity, 0.42);
    CHECK(film / area == Approx(nusselt * conductivity / 0.1).epsilon(0.02));
    const HotJet gas{.diameter = 0.1,
                     .speed = 20.0,
                     .temperature = 500.0,
                     .pressure = standard_pressure(height)};
    CHECK(heat > 0.02 * heat_flow(gas));
    CHECK(heat < heat_flow(gas));
}

TEST_CASE("a plate warms under a jet by its hours, and cools after", "[scenes][jet]") {
    // The middle: film h, wall's warmth 5 D* / H, the same for all of a small facet. While it runs
    // T goes to T_air + warmth (T_gas - T_air) as exp(-h t / C), after it back as under 10 W/m2K.
    const Run on = run(slab(), jet(std::string(from_above) + "hours = [\"06:00-07:00\"]\n"));
    const std::size_t middle = on.facet_at(0.02, 0.02, false);
    const std::vector<NetworkObject> network = targets(on.prepared.world, on.prepared.scene);
    double film = 0.0, warmth = 0.0;
    for (const NetworkObject::Jet::Face& face : network[0].jet[0].face) {
        if (network[0].facet[face.facet] != middle) continue;
        film = face.film;
        warmth = face.heat / face.film;
    }
    const double away = double(on.prepared.world.facets.centroid[middle].head<2>().norm());
    CHECK(warmth ==
          Approx(5.0 * 0.1 * std::sqrt(288.15 / 500.0) / (0.8 + 3.0 * away)).epsilon(0.03));
    CHECK(film > 30.0);
    const double wall = 290.0 + warmth * 210.0;
    const auto kelvin = [&](const char* time) { return double(on.at(time)[middle]); };
    CHECK(kelvin("05:30") == Approx(290.0).margin(0.02));
    CHECK(kelvin("06:00") == Approx(290.0).margin(0.02));
    const double half = wall - (wall - 290.0) * std::exp(-film * 1800.0 / capacity);
    CHECK(half < wall - 10.0);
    CHECK(kelvin("06:30") == Approx(half).margin(0.3));
    const double end = wall - (wall - 290.0) * std::exp(-film * 3600.0 / capacity);
    CHECK(kelvin("07:00") == Approx(end).margin(0.3));
    CHECK(kelvin("07:30") ==
          Approx(290.0 + (end - 290.0) * std::exp(-10.0 * 1800.0 / capacity)).margin(0.3));
    CHECK(kelvin("12:00") ==
          Approx(290.0 + (end - 290.0) * std::exp(-10.0 * 18000.0 / capacity)).margin(0.3));
    CHECK(on.result.report.converged);
    CHECK(on.result.report.worst_energy_closure < 1e-8);
}

TEST_CASE("what a jet does not reach is as it was to the last bit", "[scenes][jet]") {
    const std::string other =
        "[[object]]\nname = \"other\"\nmesh = \"mesh.obj\"\nup = \"z\"\nplace_m = [8.0, 0.0]\n"
        "height_above_ground_m = 2.0\nmaterial = \"sheet\"\nlargest_edge_m = 0.5\n"
        "[[object.part]]\nname = \"*\"\nheat_W_m2 = 100.0\n";
    const Run with = run(slab(), jet(from_above), other);
    const Run without = run(slab(), "[[object.part]]\nname = \"*\"\nwelded = false\n", other);
    const FacetSet& facets = with.prepared.world.facets;
    const std::vector<float> a = with.at("12:00"), b = without.at("12:00");
    const std::size_t grounds[]{with.prepared.world.ground_facets,
                                without.prepared.world.ground_facets};
    REQUIRE(a.size() - grounds[0] == b.size() - grounds[1]);
    std::size_t same = 0, warmed = 0;
    for (std::size_t f = grounds[0]; f < facets.size(); ++f) {
        const float before = b[f - grounds[0] + grounds[1]];
        const bool its_own = facets.centroid[f].x() < 4.0f;
        if (!its_own) {
            CHECK(a[f] == before);
            CHECK(before > 290.5f);
            ++same;
        } else if (a[f] > before + 5.0f) {
            ++warmed;
        }
        // Below the plate: what comes round its edges, where triangles are small.
        if (its_own && facets.normal[f].z() < -0.9f) CHECK(a[f] == Approx(before).margin(0.2));
    }
    CHECK(same > 20);
    CHECK(warmed > 20);
}

TEST_CASE("a jet warms the ground unless something blocks it", "[scenes][jet]") {
    const std::string downward =
        "outlet = [2.0, 0.0, -1.0]\ndirection = [0, 0, -1]\ndiameter_m = 0.1\nflow_kg_s = "
        "0.12\ntemperature_K = 600.0\n";
    const Run on = run(slab(), jet(downward));
    const std::size_t below = on.facet_at(2.0, 0.0, true), away = on.facet_at(12.0, 0.0, true);
    // A metre above the ground: 5 D* / 1 m at the stagnation point, the film of 10 W/m2K gone.
    const double warmth = 5.0 * 0.1 * std::sqrt(288.15 / 600.0);
    CHECK(double(on.at("12:00")[below]) == Approx(290.0 + warmth * 310.0).margin(12.0));
    CHECK(double(on.at("12:00")[away]) == Approx(290.0).margin(0.01));
    const FacetSet& facets = on.prepared.world.facets;
    std::size_t warm = 0;
    for (std::size_t f = 0; f < on.prepared.world.ground_facets; ++f) {
        warm += on.at("12:00")[f] > 300.0f;
    }
    CHECK(warm > 20);
    CHECK(facets.size() > warm);
    CHECK(on.result.report.worst_energy_closure < 1e-8);
    // Through the plate itself: nothing of the ground.
    const Blown blocked = blown(slab(), jet(from_above));
    for (const std::uint32_t f : blocked.network[0].facet) {
        CHECK(f >= blocked.prepared.world.ground_facets);
    }
}

TEST_CASE("a vehicle's exhaust leaves a spot on the ground that fades", "[scenes][jet]") {
    // Ground of an effusivity of 1225 under its film and radiation to surroundings as warm as the
    // air: q / h (1 - exp(x^2) erfc(x)), x = h sqrt(t) / 1225 (Carslaw & Jaeger 2.7), h of the
    // jet's film or the air's and of radiation, q what the jet brings.
    const ScratchFolder folder("jet");
    over_plain::write_scene(folder.path, {.mesh = over_plain::level_square(2),
                                          .longwave = 401.05,
                                          .albedo = 1.0,
                                          .ground_edge = 2.0});
    std::string text = read_text(folder.path / "scene.toml");
    const auto put = [&](const std::string& old, const std::string& next) {
        text.replace(text.find(old), old.size(), next);
    };
    const auto begin = text.find("[[object]]"), end = text.find("[material.");
    text.replace(
        begin, end - begin,
        "[[object]]\nname = \"it\"\nmodel = \"tracked_vehicle\"\ndetail = \"low\"\nplace_m "
        "= [0, 0]\nrunning = [\"06:00-07:00\"]\n");
    put("object_sky_rays = 1024", "object_sky_rays = 64");
    put("sky_rays = 1024", "sky_rays = 64");
    put("thickness_m = 0.001, conductivity_W_mK = 50.0",
        "thickness_m = 1.0, conductivity_W_mK = 1.5");
    put("interval = \"instant\"", "interval = \"instant\"\nlapse = 0.0");
    const std::string start = "start = 2026-03-20T00:00:00Z\n";
    text.insert(text.find(start) + start.size(), "duration_h = 24\nstep_s = 300\n");
    write_text(folder.path / "scene.toml", text);
    Prepared prepared = prepare(read_scene(folder.path / "scene.toml"));
    Progress silent(ProgressStyle::silent);
    SpanResult result = solve_scene(Stages(prepared), silent);
    const Run on{std::move(prepared), std::move(result)};
    const std::vector<NetworkObject> network = targets(on.prepared.world, on.prepared.scene);
    REQUIRE(network[0].jet.size() == 1);
    std::uint32_t spot = 0;
    double film = 0.0, heat = 0.0;
    for (const NetworkObject::Jet::Face& face : network[0].jet[0].face) {
        const std::uint32_t f = network[0].facet[face.facet];
        if (f >= on.prepared.world.ground_facets || face.heat < heat) continue;
        spot = f;
        film = face.film;
        heat = face.heat;
    }
    const Eigen::Vector3f at = on.prepared.world.facets.centroid[spot];
    const ObjectInput& input = on.prepared.scene.terrain.objects.at(0);
    const Eigen::Vector3d outlet =
        MeshFrame(*input.mesh, input.placing).place(input.target.jet.at(0).outlet);
    CHECK(at.x() == Approx(outlet.x()).margin(0.2));
    CHECK(at.y() == Approx(outlet.y() - outlet.z() * 0.82 / 0.57).margin(0.2));
    const double h = std::max(10.0, film) + 4.0 * stefan_boltzmann * std::pow(292.0, 3);
    const double x = h * std::sqrt(3600.0) / std::sqrt(1.5 * 2000.0 * 500.0);
    const double excess = heat * 210.0 / h * (1.0 - std::exp(x * x) * std::erfc(x));
    CAPTURE(film, heat, excess);
    CHECK(excess > 5.0);
    // What is left of the day before: q t h^-2 e / 2 √π T^1.5, 0.2 K after 23 hours.
    const double before = double(on.at("06:00")[spot]);
    CHECK(before == Approx(290.2).margin(0.2));
    CHECK(double(on.at("07:00")[spot]) == Approx(before + excess).margin(0.05 * excess));
    const double later = double(on.at("08:00")[spot]) - before;
    CHECK(later < 0.4 * excess);
    CHECK(later > 0.1 * excess);
    CHECK(on.result.report.converged);
}

TEST_CASE("a jet as warm as a lump, and one that has less than it would give", "[scenes][jet]") {
    const Run lump =
        run(slab(), jet("outlet = [0.0, 0.0, 0.82]\ndirection = [0, 0, -1]\ndiameter_m = "
                        "0.1\nspeed_m_s = 20.0\nlump = \"gas\"\n") +
                        "[[object.lump]]\nname = \"gas\"\ntemperature_K = 450.0\nhours = "
                        "[\"06:00-12:00\"]\n");
    const std::size_t middle = lump.facet_at(0.02, 0.02, false);
    const double away = double(lump.prepared.world.facets.centroid[middle].head<2>().norm());
    const double warmth = 5.0 * 0.1 * std::sqrt(288.15 / 600.0) / (0.8 + 3.0 * away);
    CHECK(double(lump.at("11:30")[middle]) == Approx(290.0 + warmth * 160.0).margin(2.0));
    CHECK(double(lump.at("05:30")[middle]) == Approx(290.0).margin(0.02));

    const Blown weak = blown(slab(), jet("outlet = [0.0, 0.0, 0.07]\ndirection = [0, 0, "
                                         "-1]\ndiameter_m = 0.02\nspeed_m_s = 0.1\ntemperature_K "
                                         "= 500.0\n"));
    const FacetSet& facets = weak.prepared.world.facets;
    double heat = 0.0;
    for (const NetworkObject::Jet::Face& face : weak.network[0].jet[0].face) {
        heat += face.heat * double(facets.area[weak.network[0].facet[face.facet]]);
    }
    const HotJet gas{.diameter = 0.02,
                     .speed = 0.1,
                     .temperature = 500.0,
                     .pressure = standard_pressure(weak.prepared.world.sea_level_height)};
    CHECK(heat <= heat_flow(gas) * (1.0 + 1e-12));
    CHECK(heat > 0.9 * heat_flow(gas));
    CHECK(weak.notes().find("times the available heat flow") != std::string::npos);
    const Blown shut = blown(slab(), jet("outlet = [0.0, 0.0, 0.01]\ndirection = [0, 0, "
                                         "-1]\ndiameter_m = 0.02\nspeed_m_s = 1\ntemperature_K = "
                                         "500.0\n"));
    CHECK(shut.notes().find("is blocked at its outlet") != std::string::npos);
}

TEST_CASE("mistakes of a jet are reported", "[scenes][jet]") {
    const auto reported = [](const std::string& keys) {
        const ScratchFolder folder("jet");
        std::string all;
        try {
            read_scene(scene_file(folder.path, slab(), jet(keys)));
        } catch (const InputError& error) {
            for (const Mistake& mistake : error.mistakes()) all += mistake.line() + "\n";
        }
        return all;
    };
    CHECK(reported(from_above).empty());
    const std::string both =
        reported(std::string(from_above) + "flow_kg_s = 0.1\nlump = \"gas\"\n");
    CHECK(both.find("speed_m_s: expected exactly one of this and flow_kg_s") != std::string::npos);
    CHECK(both.find("temperature_K: expected exactly one of this and lump") != std::string::npos);
    CHECK(both.find("unknown 'gas' in this object") != std::string::npos);
    CHECK(reported("outlet = [0, 0]\ndirection = [0, 0, 0]\ndiameter_m = 0.1\nspeed_m_s = "
                   "1\ntemperature_K = 400.0\n")
              .find("only zeros") != std::string::npos);
    CHECK(reported(std::string(from_above) + "runs = true\nhours = [\"06:00-07:00\"]\n")
              .find("cannot be combined with runs = true") != std::string::npos);
    // A pipe of 0.1 m passes 1.38 kg/s of air of 500 K (0.706 kg/m3) at 250 m/s.
    CHECK(reported("outlet = [0, 0, 1]\ndirection = [0, 0, -1]\ndiameter_m = 0.1\nflow_kg_s = "
                   "100.0\ntemperature_K = 500.0\n")
              .find("expected at most 250 m/s: 1.39 kg/s") != std::string::npos);
    CHECK(reported(std::string(from_above) + "hours = []\n").find("hours: found no hours") !=
          std::string::npos);
    CHECK(
        reported(std::string(from_above) + "hours = [\"06:00-07:00 2\"]\n").find("share 0 to 1") !=
        std::string::npos);
    CHECK(reported(std::string(from_above) +
                   "hours = [\"22:00-02:00\", \"2026-03-21 01:00-03:00\"]\n")
              .find("'2026-03-21 01:00-03:00' overlaps '22:00-02:00'") != std::string::npos);
    CHECK(
        reported(std::string(from_above) + "hours = [\"22:00-02:00\", \"02:00-03:00\"]\n").empty());
    CHECK(reported(std::string(from_above) + "[[object.jet]]\nname = \"exhaust\"\n" + from_above)
              .find("'exhaust' is defined twice") != std::string::npos);
    // What is out of its range is reported once.
    const std::string slow = reported(
        "outlet = [0, 0, 1]\ndirection = [0, 0, -1]\ndiameter_m = "
        "0.1\nspeed_m_s = 0\ntemperature_K = 500.0\n");
    CHECK(std::count(slow.begin(), slow.end(), '\n') == 1);
}

TEST_CASE("a jet whose hours lie outside the span is reported", "[scenes][jet]") {
    const Blown never =
        blown(slab(), jet(std::string(from_above) + "hours = [\"2026-09-01 06:00-07:00\"]\n"));
    CHECK(never.notes().find("no hour of the jet \"exhaust\" of \"sheet\" is within the span") !=
          std::string::npos);
    const Blown now =
        blown(slab(), jet(std::string(from_above) + "hours = [\"2026-03-20 06:00-07:00\"]\n"));
    CHECK(now.notes().find("is within the span") == std::string::npos);
}
