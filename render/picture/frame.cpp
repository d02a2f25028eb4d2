#include "render/picture/frame.hpp"

#include <algorithm>

#include "materials/base/error.hpp"

namespace diurna {

const Plane* Frame::find(std::string_view name) const {
    const auto found = std::find_if(planes.begin(), planes.end(),
                                    [&](const Plane& plane) { return plane.name == name; });
    return found == planes.end() ? nullptr : &*found;
}

const Plane& Frame::operator[](std::string_view name) const {
    if (const Plane* plane = find(name)) return *plane;
    std::vector<std::string> names;
    for (const Plane& plane : planes) names.push_back(plane.name);
    throw InputError("frame of " + observer, "has no plane '" + std::string(name) + "'",
                     did_you_mean(name, names));
}

Frame band_frame(const Frame& frame, const std::string& band, bool truth) {
    // Planes without a dot, and those of the normal, belong to no band.
    const auto of_no_band = [](const std::string& name) {
        return name.find('.') == std::string::npos || name.starts_with("normal.");
    };
    Frame part{.width = frame.width,
               .height = frame.height,
               .instant = frame.instant,
               .observer = frame.observer,
               .planes = {},
               .notes = frame.notes,
               .attributes = frame.attributes};
    // Notes of a band have its name behind a dot.
    std::erase_if(part.notes, [&](const auto& note) {
        const std::size_t dot = note.first.find('.');
        return dot != std::string::npos && note.first.substr(dot + 1) != band;
    });
    for (const Plane& plane : frame.planes) {
        const bool wanted =
            of_no_band(plane.name) ? truth : plane.name.substr(plane.name.find('.') + 1) == band;
        if (wanted) part.planes.push_back(plane);
    }
    return part;
}

std::string frame_name(const Frame& frame, const std::string& band) {
    std::string name = frame.observer + "_" + band + "_" + format_instant(frame.instant, true);
    for (char& c : name) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                           (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '_';
        if (!plain) c = '-';
    }
    return name;
}

}  // namespace diurna
