#include "scenes/input/read_jet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/base/error.hpp"
#include "scenes/input/read_hours.hpp"
#include "thermal/surface/hot_jet.hpp"

namespace diurna {

namespace {

constexpr double fastest_jet = 250.0;  // [m s⁻¹] that the laws of jets are for

Eigen::Vector3d read_vector(const Section& section, const char* key, const char* says) {
    const std::vector<double> v = section.numbers(key, says, 3);
    return v.size() == 3 ? Eigen::Vector3d(v[0], v[1], v[2]) : Eigen::Vector3d::UnitZ();
}

}  // namespace

JetInput read_jet(const Section& section, std::span<const std::string> lumps) {
    JetInput jet;
    jet.where = section.where();
    jet.name = section.text("name", "of a stream of hot gas from an outlet, such as an exhaust's");
    jet.outlet = read_vector(section, "outlet",
                             "[x, y, z] of its middle, as the mesh's vertices are: its axes, its "
                             "origin and unit");
    jet.direction = read_vector(section, "direction", "[x, y, z] it blows in, in the mesh's axes");
    if (const double length = jet.direction.norm(); length > 1e-9) {
        jet.direction /= length;
    } else {
        section.mistake("direction", "found nothing but zeros, expected a way to blow");
        jet.direction = Eigen::Vector3d::UnitZ();
    }
    jet.diameter = section.number("diameter_m", "of the outlet", {0.005, 5.0});
    jet.speed = section.number_or("speed_m_s", "mean over the outlet",
                                  {JetInput::none, "needed, or flow_kg_s"}, {0.1, fastest_jet});
    jet.flow = section.number_or("flow_kg_s", "of gas", {JetInput::none, "needed, or speed_m_s"},
                                 {1e-5, 1e3});
    if (section.has("speed_m_s") == section.has("flow_kg_s")) {
        section.mistake("speed_m_s", "expected either this or flow_kg_s");
    }
    jet.kelvin = section.number_or("temperature_K", "of the gas at the outlet",
                                   {JetInput::none, "needed, or lump"}, {200.0, 2500.0});
    jet.lump = section.text_or("lump", "the lump or enclosure that the gas is as warm as", "");
    if (section.has("temperature_K") != jet.lump.empty()) {
        section.mistake("temperature_K", "expected either this or lump");
    }
    if (!jet.lump.empty() && std::find(lumps.begin(), lumps.end(), jet.lump) == lumps.end()) {
        section.mistake("lump",
                        fmt::format("no '{}' in this object, which has {}", jet.lump,
                                    lumps.empty() ? std::string("none")
                                                  : fmt::format("{}", fmt::join(lumps, ", "))),
                        did_you_mean(jet.lump, lumps));
    }
    if (!std::isnan(jet.flow)) {
        const HotJet gas{.diameter = jet.diameter,
                         .speed = fastest_jet,
                         .temperature = std::isnan(jet.kelvin) ? JetInput::lump_gas : jet.kelvin};
        if (const double speed = speed_of(jet.flow, gas); speed > fastest_jet) {
            section.mistake("flow_kg_s",
                            fmt::format("is {:.3g} m/s through the outlet, expected {:g} m/s at "
                                        "the most: {:.3g} kg/s",
                                        speed, fastest_jet, mass_flow(gas)));
        }
    }
    jet.hours = read_hours(section);
    jet.runs =
        section.flag_or("runs", "it blows in the hours of the object's `running` alone", false);
    if (jet.runs && section.has("hours")) {
        section.mistake("hours", "stands beside runs = true, expected one of the two");
    }
    return jet;
}

}  // namespace diurna
