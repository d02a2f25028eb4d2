#include "render/instrument/display.hpp"

#include <algorithm>
#include <cmath>

namespace diurna {

namespace {

/// What becomes of each count, 0 to 255.
using Curve = std::vector<double>;

Curve straight(std::size_t counts, double black, double white) {
    Curve curve(counts);
    for (std::size_t c = 0; c < counts; ++c) {
        curve[c] = std::clamp(255.0 * (double(c) - black) / (white - black), 0.0, 255.0);
    }
    return curve;
}

/// The count that a share of the pixels do not exceed.
double at_share(std::span<const double> histogram, double share, double pixels) {
    double sum = 0.0;
    for (std::size_t c = 0; c < histogram.size(); ++c) {
        sum += histogram[c];
        if (sum >= share * pixels && sum > 0.0) return double(c);
    }
    return double(histogram.size() - 1);
}

Curve evened_out(std::span<const double> histogram, double most) {
    Curve curve(histogram.size());
    double sum = 0.0;
    for (std::size_t c = 0; c < histogram.size(); ++c) {
        const double here = std::min(histogram[c], most);
        curve[c] = sum + 0.5 * here;
        sum += here;
    }
    for (double& place : curve) place *= 255.0 / sum;
    return curve;
}

}  // namespace

std::vector<std::uint8_t> displayed(std::span<const std::uint16_t> counts,
                                    const Electronics& electronics) {
    const std::size_t values = std::size_t{1} << electronics.bits;
    std::vector<double> histogram(values, 0.0);
    for (const std::uint16_t count : counts) histogram[count] += 1.0;
    const double pixels = double(counts.size());
    Curve curve;
    if (electronics.display == Display::plateau) {
        curve = evened_out(histogram, std::max(1.0, electronics.plateau * pixels));
    } else if (electronics.display == Display::linear) {
        const double black = at_share(histogram, electronics.low, pixels);
        const double white = at_share(histogram, electronics.high, pixels);
        curve = straight(values, black, std::max(white, black + 1.0));
    } else {
        curve = straight(values, electronics.level - 0.5 * electronics.span,
                         electronics.level + 0.5 * electronics.span);
    }
    std::vector<std::uint8_t> picture;
    picture.reserve(counts.size());
    for (const std::uint16_t count : counts) {
        const double place = electronics.black_hot ? 255.0 - curve[count] : curve[count];
        picture.push_back(static_cast<std::uint8_t>(std::lround(place)));
    }
    return picture;
}

}  // namespace diurna
