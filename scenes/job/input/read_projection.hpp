#pragma once

#include "materials/base/section.hpp"
#include "render/view/observer.hpp"

namespace diurna {

/// Projection and field of view of a picture.
struct PictureAngles {
    Projection projection = Projection::pinhole;
    double horizontal_fov_deg = 20.0;
    double picture_width = 0.0;   // [m] orthographic
    double pixel_pitch_um = 0.0;  // if given
};

/// For a picture of given width and height [pixels]: its projection and the field of view, given
/// directly or by a lens and pixels, or the width of an orthographic picture. A pixel that would
/// look beyond 180° from the axis is a mistake.
PictureAngles read_projection(const Section& section, int width, int height);

}  // namespace diurna
