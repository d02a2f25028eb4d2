#pragma once

#include "materials/base/section.hpp"
#include "render/instrument/instrument.hpp"

namespace diurna {

/// A table [instrument]: its preset, and what the file says otherwise.
Instrument read_instrument(const Section& section);

}  // namespace diurna
