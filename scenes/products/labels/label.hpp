#pragma once

#include <map>
#include <string>
#include <vector>

#include "render/picture/grey_picture.hpp"
#include "scenes/products/labels/label_contrast.hpp"
#include "scenes/products/labels/labelled.hpp"
#include "scenes/products/labels/object_masks.hpp"
#include "scenes/products/labels/whole_objects.hpp"
#include "terrain/place/instant.hpp"

namespace diurna {

/// One object in one picture.
struct Label {
    ObjectMask mask;
    WholeObject whole;
    Contrast temperature, radiance;  // of the apparent temperature [K]; [W m⁻² sr⁻¹]
};

/// One picture of a run and the objects visible in it.
struct LabelledPicture {
    std::string file, planes;  // the grey picture and the EXR, relative to the run's folder
    Instant instant;
    std::string observer, band;
    int width = 0, height = 0;
    bool validation = false;
    std::string plane;  // plane of the grey picture, its unit and its scale
    std::string unit;
    int bits = 8;
    GreyScale scale{};
    DisplayCounts display{};
    std::size_t beyond = 0;                           // pixels outside the scale
    std::map<std::string, std::string> attributes{};  // of the EXR: camera, sun, air
    std::vector<Label> labels{};                      // by ObjectId
};

/// Common to all pictures of a run.
struct LabelBook {
    std::vector<Labelled> objects;     // (ObjectId)
    std::vector<std::string> classes;  // class_list()
};

}  // namespace diurna
