#pragma once

#include "materials/base/section.hpp"
#include "scenes/input/read_observer.hpp"

namespace diurna {

/// How directions lie on an observer's picture of known width and height [pixels]: its projection
/// and the field of view, said or made by a lens and pixels, or the width of a picture of parallel
/// rays. A pixel that would look round the back of the sphere is a mistake.
void read_projection(const Section& section, ObserverInput& observer);

}  // namespace diurna
