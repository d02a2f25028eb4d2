#pragma once

#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/plan/sequence.hpp"

namespace diurna {

/// A scene's facets at a frame, with moving objects as recorded by a rolling-shutter camera.
struct RowPlaces {
    FacetSet seen;     // each corner at the time when its row is read
    FacetSet stands;   // each object at the time when the row of its middle is read
    MoverPoses poses;  // (mover) of these
};

/// Objects move straight at constant speed while the rows are read, as in the picture.
RowPlaces row_places(const Prepared& prepared, const Sequence& sequence, std::size_t frame);

}  // namespace diurna
