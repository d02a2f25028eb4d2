#pragma once

#include <string>

#include "scenes/cache/messages.hpp"
#include "terrain/visibility/view_factors.hpp"
#include "thermal/solve/solve_input.hpp"
#include "thermal/temperature_field.hpp"

/// What stages find as bytes, for a store on the same machine, and back: every bit is kept. What is
/// read throws std::exception where it is too short.
namespace diurna {

/// Temperatures, and what is to be reported of how they were found.
struct FoundHeat {
    TemperatureField temperature;
    Messages reported;
};

std::string bytes_of(const FacetViews& views);
std::string bytes_of(const SunExposure& sun);
std::string bytes_of(const FoundHeat& heat);

FacetViews views_of(const std::string& bytes);
SunExposure sun_of(const std::string& bytes);
FoundHeat heat_of(const std::string& bytes);

}  // namespace diurna
