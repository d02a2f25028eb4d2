#pragma once

#include "materials/base/section.hpp"
#include "render/picture/exr.hpp"

namespace diurna {

/// The section [output]: what a run writes in addition to temperatures and pictures.
struct OutputInput {
    bool fluxes = false;  // the heat balance of every facet in temperatures.nc
    bool state = false;   // state.nc: the heat at the end, from which a run can continue
    ExrCompression compression = ExrCompression::none;  // of pictures
};

OutputInput read_output(const Section& section);

}  // namespace diurna
