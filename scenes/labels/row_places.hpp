#pragma once

#include "scenes/plan/prepared.hpp"
#include "scenes/plan/sequence.hpp"

namespace diurna {

/// A scene's facets at a frame, as a camera finds what goes.
struct RowPlaces {
    FacetSet seen;     // each corner where it is when the row that it falls on is read
    FacetSet stands;   // each object as it stands when the row that its middle falls on is read
    MoverPoses poses;  // (mover) of these
};

/// Objects go straight on at an even speed while the rows are read, as they do for the picture.
RowPlaces row_places(const Prepared& prepared, const Sequence& sequence, std::size_t frame);

}  // namespace diurna
