#include "render/picture/palette.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "materials/base/units.hpp"

namespace diurna {

namespace {

/// IEC 61966-2-1, of linear light.
double encoded(double light) {
    return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
}

std::uint8_t to_byte(double component) {
    return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(component, 0.0, 1.0)));
}

/// CIE L*C*h (D65) to sRGB components before rounding; outside [0, 1] where it cannot be shown.
std::array<double, 3> srgb(double lightness, double chroma, double hue_deg) {
    const double fy = (lightness + 16.0) / 116.0;
    const double fx = fy + chroma * std::cos(radians(hue_deg)) / 500.0;
    const double fz = fy - chroma * std::sin(radians(hue_deg)) / 200.0;
    const auto unfold = [](double f) {
        return f > 6.0 / 29.0 ? f * f * f : (f - 4.0 / 29.0) * 3.0 * 36.0 / 841.0;
    };
    const double x = 0.95047 * unfold(fx), y = unfold(fy), z = 1.08883 * unfold(fz);
    return {encoded(3.2404542 * x - 1.5371385 * y - 0.4985314 * z),
            encoded(-0.9692660 * x + 1.8760108 * y + 0.0415560 * z),
            encoded(0.0556434 * x - 0.2040259 * y + 1.0572252 * z)};
}

}  // namespace

Rgb warm_colour(double t) {
    const double lightness = 8.0 + 87.0 * t;
    const double hue_deg = 285.0 + 165.0 * t;
    double chroma = 14.0 + 50.0 * std::sin(std::numbers::pi * std::min(1.0, 0.05 + 0.9 * t));
    std::array<double, 3> rgb{};
    for (;; chroma -= 0.5) {
        rgb = srgb(lightness, chroma, hue_deg);
        const auto [least, most] = std::minmax_element(rgb.begin(), rgb.end());
        if ((*least >= 0.0 && *most <= 1.0) || chroma <= 0.0) break;
    }
    return {to_byte(rgb[0]), to_byte(rgb[1]), to_byte(rgb[2])};
}

Rgb grey_of_light(double t) {
    const std::uint8_t grey = to_byte(encoded(std::max(0.0, t)));
    return {grey, grey, grey};
}

}  // namespace diurna
