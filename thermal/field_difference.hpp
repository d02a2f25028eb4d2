#pragma once

#include "thermal/temperature_field.hpp"

namespace diurna {

/// [K] Over all facets and instants of two fields with the same ones.
struct FieldDifference {
    double rms = 0.0, worst = 0.0;
};
FieldDifference difference_of(const TemperatureField& a, const TemperatureField& b);

}  // namespace diurna
