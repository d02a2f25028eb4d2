#include <pybind11/stl.h>

#include "python/src/bind.hpp"

namespace diurna::python {

py::dict as_dict(Frame&& frame) {
    py::dict out, planes, units;
    for (Plane& plane : frame.planes) {
        units[plane.name.c_str()] = plane.unit;
        planes[plane.name.c_str()] = as_array(std::move(plane.pixel), {frame.height, frame.width});
    }
    out["planes"] = planes;
    out["units"] = units;
    out["instant"] = as_datetimes({frame.instant});
    out["observer"] = frame.observer;
    out["notes"] = frame.notes;
    out["attributes"] = frame.attributes;
    return out;
}

}  // namespace diurna::python
