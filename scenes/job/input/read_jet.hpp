#pragma once

#include <Eigen/Core>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "materials/base/section.hpp"
#include "thermal/solve/clock_hours.hpp"

namespace diurna {

/// Hot gas from an outlet of an object that blows over surfaces in its path
/// (thermal/surface/hot_jet.hpp).
struct JetInput {
    static constexpr double none = std::numeric_limits<double>::quiet_NaN();
    static constexpr double lump_gas = 600.0;  // [K] for the density of a lump's gas
    std::string name;
    Eigen::Vector3d outlet = Eigen::Vector3d::Zero();      // its middle, in the mesh's coordinates
    Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  // in the mesh's axes, unit
    double diameter = 0.1;                                 // [m]
    double speed = none;                                   // [m s⁻¹], or
    double flow = none;                                    // [kg s⁻¹]
    double kelvin = none;                                  // of the gas, or
    std::string lump;                                      // at this lump's temperature
    bool runs = false;                                     // only while the object runs
    std::vector<ClockHours::Window> hours{};
    std::string where{};
};

/// A table `jet` of an object or a part file. Mistakes are noted.
///
/// lumps  allowed names of lumps and enclosures
JetInput read_jet(const Section& section, std::span<const std::string> lumps);

}  // namespace diurna
