#pragma once

#include <string>

#include "scenes/job/plan/prepared.hpp"
#include "thermal/temperature_field.hpp"

namespace diurna {

/// The curves of materials, of objects and of the parts of each, as sections of a page in HTML.
std::string courses(const Prepared& prepared, const TemperatureField& field);

}  // namespace diurna
