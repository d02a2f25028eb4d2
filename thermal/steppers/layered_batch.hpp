#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <vector>

#include "thermal/column/column.hpp"
#include "thermal/surface/turbulence.hpp"

namespace diurna {

/// Up to `lanes` columns of one material: temperatures relative to the reference, [node][lane].
struct LayeredBatch {
    std::size_t count = 0;
    std::vector<double> state;                // [node][lane]
    std::array<double, lanes> temperature{};  // of the surface [K]
    std::array<double, lanes> rate{};         // its change over the last step, for a first guess
    std::array<double, lanes> taken{};        // into the column at the last step's end [W m⁻²]
    std::array<NaturalFilm, lanes> natural{};
    /// (stage) [lane] absorbed sun and longwave of plates' backs [W m⁻²]; null: that of
    /// surroundings at the air's temperature.
    std::array<const double*, 2> behind{};
    bool wet_behind = false;  // the backs evaporate as the fronts do

    void resize(std::size_t nodes, std::size_t facets) {
        assert(facets <= lanes);
        count = facets;
        state.assign(nodes * lanes, 0.0);
    }
};

}  // namespace diurna
