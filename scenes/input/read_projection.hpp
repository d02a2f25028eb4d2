#pragma once

#include "materials/base/section.hpp"
#include "render/view/observer.hpp"

namespace diurna {

/// How directions lie on a picture.
struct PictureAngles {
    Projection projection = Projection::pinhole;
    double horizontal_fov_deg = 20.0;
    double picture_width = 0.0;   // [m] orthographic
    double pixel_pitch_um = 0.0;  // if it is said
};

/// Of a picture of known width and height [pixels]: its projection and the field of view, said or
/// made by a lens and pixels, or the width of a picture of parallel rays. A pixel that would look
/// round the back of the sphere is a mistake.
PictureAngles read_projection(const Section& section, int width, int height);

}  // namespace diurna
