#include "render/picture/colour_scale.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "materials/base/units.hpp"

namespace diurna {

namespace {

/// Top of a scale of radiance at least [W m-2 sr-1]: what starlit ground sends back is about this.
constexpr double least_light = 1e-6;

}  // namespace

bool is_temperature(const Plane& plane) { return plane.unit == "K"; }

double in_colour_unit(const Plane& plane, float value) {
    return is_temperature(plane) ? celsius(double{value}) : double{value};
}

std::string colour_unit(const Plane& plane) { return is_temperature(plane) ? "°C" : plane.unit; }

ColourScale colour_scale(const Frame& frame, const std::string& plane) {
    const Plane* solid = frame.find("temperature");
    if (!solid) return colour_scale(frame[plane]);
    Plane seen = frame[plane];
    for (std::size_t p = 0; p < seen.pixel.size(); ++p) {
        if (!std::isfinite(solid->pixel[p])) seen.pixel[p] = std::nanf("");
    }
    return colour_scale(seen);
}

ColourScale colour_scale(const Plane& plane) {
    const bool temperature = is_temperature(plane);
    std::vector<float> value;
    for (const float v : plane.pixel) {
        if (std::isfinite(v) && (v > 0.0f || !temperature)) value.push_back(v);
    }
    if (value.empty()) return {0.0, 1.0};
    const auto percentile = [&](double share) {
        const auto place = static_cast<std::ptrdiff_t>(share * double(value.size() - 1));
        std::nth_element(value.begin(), value.begin() + place, value.end());
        return in_colour_unit(plane, value[static_cast<std::size_t>(place)]);
    };
    if (!temperature) return {0.0, std::max(least_light, percentile(0.99))};
    const double low = std::floor(percentile(0.01));
    return {low, std::max(low + 1.0, std::ceil(percentile(0.99)))};
}

}  // namespace diurna
