#pragma once

#include <filesystem>
#include <string>

#include "scenes/job/plan/prepared.hpp"
#include "thermal/temperature_field.hpp"

namespace diurna {

/// The terms of the heat balance of ground, objects and parts over the day, means over area, as a
/// section of a page in HTML: from the fluxes in temperatures.nc of a run's folder, for `field`. ""
/// if the file has none.
std::string heat_terms_of_day(const std::filesystem::path& folder, const Prepared& prepared,
                              const TemperatureField& field);

}  // namespace diurna
