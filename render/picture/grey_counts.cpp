#include "render/picture/grey_counts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/base/units.hpp"
#include "render/picture/colour_scale.hpp"

namespace diurna {

namespace {

/// A full scale holds at least this [W m-2 sr-1], about what starlit ground sends back: darker
/// nights are black.
constexpr double least_level = 1e-6;

double greatest_count(int bits) { return bits == 16 ? 65535.0 : 255.0; }

/// The finest of 1, 2, 5 times a power of ten that is at least `step`.
double even_step(double step) {
    const double decade = std::pow(10.0, std::floor(std::log10(step)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor * decade >= step) return factor * decade;
    }
    return 10.0 * decade;
}

}  // namespace

GreyScale grey_scale(const Frame& frame, const std::string& name, int bits) {
    const Plane& plane = frame[name];
    if (bits == 8) {
        const ColourScale ends = colour_scale(frame, name);
        const double zero = is_temperature(plane) ? kelvin(ends.low) : ends.low;
        return {zero, (ends.high - ends.low) / 255.0};
    }
    if (is_temperature(plane)) return {0.0, 0.01};
    double greatest = least_level;
    for (const float value : plane.pixel) {
        if (std::isfinite(value)) greatest = std::max(greatest, double{value});
    }
    return {0.0, even_step(greatest / 65535.0)};
}

std::size_t pixels_beyond(const Plane& plane, const GreyScale& scale, int bits) {
    std::size_t beyond = 0;
    for (const float value : plane.pixel) {
        const double count = std::round((double{value} - scale.zero) / scale.step);
        beyond += std::isfinite(count) && (count < 0.0 || count > greatest_count(bits));
    }
    return beyond;
}

GreyPicture grey_picture_of(const Frame& frame, const std::string& name, int bits) {
    const Plane& plane = frame[name];
    const GreyScale scale = grey_scale(frame, name, bits);
    const double most = greatest_count(bits);
    GreyPicture picture{
        .width = frame.width,
        .height = frame.height,
        .bits = bits,
        .count = {},
        .scale = fmt::format("{} = {:g} + {:g} count", plane.unit, scale.zero, scale.step),
        .beyond = pixels_beyond(plane, scale, bits)};
    picture.count.reserve(plane.pixel.size());
    for (const float value : plane.pixel) {
        const double count = std::round((double{value} - scale.zero) / scale.step);
        picture.count.push_back(
            static_cast<std::uint16_t>(std::isfinite(count) ? std::clamp(count, 0.0, most) : 0.0));
    }
    return picture;
}

}  // namespace diurna
