#include "scenes/job/input/read_output.hpp"

namespace diurna {

OutputInput read_output(const Section& section) {
    return {
        .fluxes = section.flag_or(
            "fluxes",
            "write every term of the heat balance of each facet at each stored instant to "
            "temperatures.nc; the file is eight times as large, and the span is solved once more. "
            "Facets in contact exchange no heat there: their rows are those of the open share",
            false),
        .state = section.flag_or("state",
                                 "write state.nc, the thermal state of every facet at the end of "
                                 "the span, for time.state of a later run",
                                 false),
        .compression = section.choice_or(
            "compression",
            "lossless compression of OpenEXR pictures, except cubes: zip reduces them to a sixth "
            "up to two thirds and takes 10 to 50 % more time for a static view",
            ExrCompression::none,
            {{"none", ExrCompression::none},
             {"zips", ExrCompression::zips},
             {"zip", ExrCompression::zip},
             {"piz", ExrCompression::piz}})};
}

}  // namespace diurna
