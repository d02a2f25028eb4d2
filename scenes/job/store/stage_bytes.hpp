#pragma once

#include <string>

#include "scenes/job/store/messages.hpp"
#include "scenes/job/store/stage_store.hpp"
#include "terrain/visibility/view_factors.hpp"
#include "thermal/solve/solve_input.hpp"
#include "thermal/temperature_field.hpp"

/// Results of stages as bytes, for a cache on the same machine, and back, without loss. Reading
/// throws std::exception if the bytes are too few. What is written refers to the result.
namespace diurna {

/// Temperatures, and the messages of their computation.
struct FoundHeat {
    TemperatureField temperature;
    Messages reported;
};

StageContent content_of(const FacetViews& views);
StageContent content_of(const SunExposure& sun);
StageContent content_of(const FoundHeat& heat);

FacetViews views_of(const std::string& bytes);
SunExposure sun_of(const std::string& bytes);
FoundHeat heat_of(const std::string& bytes);

}  // namespace diurna
