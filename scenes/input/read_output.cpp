#include "scenes/input/read_output.hpp"

namespace diurna {

OutputInput read_output(const Section& section) {
    return {.fluxes = section.flag_or("fluxes",
                                      "every term of the heat balance in temperatures.nc, of each "
                                      "facet at each kept instant; eight times its size, and one "
                                      "more pass over the span. What lies in a contact exchanges "
                                      "nothing there: its rows are those of the open share",
                                      false),
            .state = section.flag_or("state",
                                     "state.nc, the heat in every facet at the span's end, for "
                                     "time.state of a run that goes on from there",
                                     false),
            .compression = section.choice_or(
                "compression",
                "of OpenEXR pictures but cubes, without loss: zip makes them a sixth to two thirds "
                "and takes a tenth to half as long again as a picture of a static view",
                ExrCompression::none,
                {{"none", ExrCompression::none},
                 {"zips", ExrCompression::zips},
                 {"zip", ExrCompression::zip},
                 {"piz", ExrCompression::piz}})};
}

}  // namespace diurna
