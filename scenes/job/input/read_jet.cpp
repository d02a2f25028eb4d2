#include "scenes/job/input/read_jet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/base/error.hpp"
#include "scenes/job/input/read_hours.hpp"
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
    jet.name = section.text("name", "name of a jet of hot gas from an outlet, such as an exhaust");
    jet.outlet = read_vector(
        section, "outlet", "[x, y, z] of the outlet's centre in the mesh's axes, origin and unit");
    jet.direction =
        read_vector(section, "direction", "[x, y, z] of the flow direction, in the mesh's axes");
    if (const double length = jet.direction.norm(); length > 1e-9) {
        jet.direction /= length;
    } else {
        section.mistake("direction", "found only zeros, expected a direction");
        jet.direction = Eigen::Vector3d::UnitZ();
    }
    jet.diameter = section.number("diameter_m", "diameter of the outlet", {0.005, 5.0});
    jet.speed = section.number_or("speed_m_s", "mean speed over the outlet",
                                  {JetInput::none, "required unless flow_kg_s is given"},
                                  {0.1, fastest_jet});
    jet.flow =
        section.number_or("flow_kg_s", "mass flow of gas",
                          {JetInput::none, "required unless speed_m_s is given"}, {1e-5, 1e3});
    if (section.has("speed_m_s") == section.has("flow_kg_s")) {
        section.mistake("speed_m_s", "expected exactly one of this and flow_kg_s");
    }
    jet.kelvin =
        section.number_or("temperature_K", "temperature of the gas at the outlet",
                          {JetInput::none, "required unless lump is given"}, {200.0, 2500.0});
    jet.lump = section.text_or("lump", "lump or enclosure that has the temperature of the gas", "");
    if (section.has("temperature_K") != jet.lump.empty()) {
        section.mistake("temperature_K", "expected exactly one of this and lump");
    }
    if (!jet.lump.empty() && std::find(lumps.begin(), lumps.end(), jet.lump) == lumps.end()) {
        section.mistake("lump",
                        fmt::format("unknown '{}' in this object, which has {}", jet.lump,
                                    lumps.empty() ? std::string("none")
                                                  : fmt::format("{}", fmt::join(lumps, ", "))),
                        did_you_mean(jet.lump, lumps));
    }
    if (!std::isnan(jet.flow)) {
        const HotJet gas{.diameter = jet.diameter,
                         .speed = fastest_jet,
                         .temperature = std::isnan(jet.kelvin) ? JetInput::lump_gas : jet.kelvin};
        if (const double speed = speed_of(jet.flow, gas); speed > fastest_jet) {
            section.mistake(
                "flow_kg_s",
                fmt::format(
                    "gives {:.3g} m/s through the outlet, expected at most {:g} m/s: {:.3g} kg/s",
                    speed, fastest_jet, mass_flow(gas)));
        }
    }
    jet.hours = read_hours(section);
    jet.runs =
        section.flag_or("runs", "the jet blows only in the hours of the object's `running`", false);
    if (jet.runs && section.has("hours")) {
        section.mistake("hours", "cannot be combined with runs = true");
    }
    return jet;
}

}  // namespace diurna
