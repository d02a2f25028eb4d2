#include "render/instrument/optics.hpp"

#include <algorithm>
#include <cmath>

namespace diurna {

LensField lens_field(const Instrument& instrument, const Response& response, int width, int height,
                     double focal_length) {
    const Lens& lens = instrument.lens;
    LensField field;
    field.light.reserve(std::size_t(width) * std::size_t(height));
    field.background.reserve(field.light.capacity());
    const double half_diagonal = 0.5 * std::hypot(width, height);
    const double per_pixel = instrument.detector.pitch / focal_length;
    for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column) {
            const double away = std::hypot(column + 0.5 - 0.5 * width, row + 0.5 - 0.5 * height);
            const double tangent = away * per_pixel;
            const double cos2 = 1.0 / (1.0 + tangent * tangent);
            const double oblique = lens.cos4 ? cos2 * cos2 : 1.0;
            const double beyond = std::max(0.0, 2.0 * away / half_diagonal - 1.0);
            const double cut = std::min(1.0, lens.vignetting * beyond * beyond);
            const double place = away / half_diagonal / lens.narcissus_radius;
            field.light.push_back(static_cast<float>(oblique * (1.0 - cut)));
            field.background.push_back(static_cast<float>(
                oblique * ((1.0 - cut) * response.lens + cut * response.walls) + response.beside -
                lens.narcissus * std::exp(-place * place) * (response.walls - response.cold)));
        }
    }
    return field;
}

void spread_glare(double share, std::span<float> light) {
    if (share <= 0.0 || light.empty()) return;
    double sum = 0.0;
    for (const float value : light) sum += double{value};
    const double veil = share * sum / double(light.size());
    for (float& value : light) value = static_cast<float>((1.0 - share) * double{value} + veil);
}

void lag(double time_constant, double seconds, std::span<const float> seen,
         std::span<const float> shown, std::span<float> now) {
    if (time_constant <= 0.0) return;
    const double u = seconds / time_constant, left = std::exp(-u), mean = -std::expm1(-u) / u;
    for (std::size_t p = 0; p < now.size(); ++p) {
        const double x0 = double{seen[p]}, x1 = double{now[p]};
        now[p] = static_cast<float>(x1 + (double{shown[p]} - x0) * left - (x1 - x0) * mean);
    }
}

}  // namespace diurna
