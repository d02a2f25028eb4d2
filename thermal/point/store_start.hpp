#pragma once

#include "thermal/surface/standing_water.hpp"

namespace diurna {

/// Water and snow on a facet at the start of a day that is repeated: those at the end of the pass
/// before. If hoar or snow grows or melts from day to day, no periodic day exists, and the amount
/// after `most_store_days` days is fixed as the start; temperatures then have a period.
struct StoreStart {
    static constexpr int most_store_days = 8;
    static constexpr double settled = 1e-3;  // [mm]

    bool held = false;    // the start is fixed
    double growth = 0.0;  // [mm] change over the last pass

    /// passes   of the day so far, the last included
    /// stood    amount at the start of the last pass
    /// left     amount at its end; becomes the next start
    /// returns  whether the store at the start has converged
    bool next(int passes, const Standing& stood, Standing& left) {
        growth = apart(left, stood);
        if (held) {
            left = stood;
            return true;
        }
        if (growth <= settled) return true;
        held = passes >= most_store_days;
        return false;
    }
};

}  // namespace diurna
