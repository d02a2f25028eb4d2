#pragma once

#include "materials/base/section.hpp"
#include "render/instrument/instrument.hpp"

namespace diurna {

/// A table [instrument]: its preset, and the values that the file changes.
Instrument read_instrument(const Section& section);

}  // namespace diurna
