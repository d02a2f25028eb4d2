#include "thermal/weather/separation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "materials/base/units.hpp"

namespace diurna {

namespace {

struct Engerer2 {
    double minutes;
    double c, b0, b1, b2, b3, b4, b5;
};
// Bright & Engerer 2019, table of parameters by averaging period.
constexpr std::array<Engerer2, 7> engerer2{{
    {1.0, 0.10562, -4.1332, 8.2578, 0.010087, 0.00088801, -4.9302, 0.44378},
    {5.0, 0.093936, -4.5771, 8.4641, 0.010012, 0.003975, -4.3921, 0.39331},
    {10.0, 0.079965, -4.8539, 8.4764, 0.018849, 0.0051497, -4.1457, 0.37466},
    {15.0, 0.065972, -4.7211, 8.3294, 0.0095444, 0.0053493, -4.169, 0.39526},
    {30.0, 0.032675, -4.8681, 8.1867, 0.015829, 0.0059922, -4.0304, 0.47371},
    {60.0, -0.0097539, -5.3169, 8.5084, 0.013241, 0.0074356, -3.0329, 0.56403},
    {1440.0, 0.32726, -9.4391, 17.113, 0.13752, -0.024099, 6.6257, 0.31419},
}};

/// Clear global sunlight of Threlkeld & Jordan (ASHRAE 1972) over that above the air.
double threlkeld_jordan_clearness(const SeparationCase& given) {
    const auto season = [&](double from) {
        return std::sin(2.0 * std::numbers::pi * (given.day_of_year - from) / 365.0);
    };
    const double apparent = 1160.0 + 75.0 * season(275.0);
    const double extinction = 0.174 + 0.035 * season(100.0);
    const double sky = 0.095 + 0.04 * season(100.0);
    const double cosine = std::max(0.01, std::cos(radians(given.zenith_deg)));
    const double direct = apparent * std::exp(-extinction / cosine);
    return direct * (cosine + sky) / (given.top * cosine);
}

}  // namespace

double erbs_diffuse_share(double clearness) {
    const double k = clearness;
    if (k <= 0.22) return 1.0 - 0.09 * k;
    if (k > 0.80) return 0.165;
    return 0.9511 + k * (-0.1604 + k * (4.388 + k * (-16.638 + k * 12.336)));
}

double engerer2_diffuse_share(const SeparationCase& given) {
    const auto distance = [&](const Engerer2& p) {
        return std::abs(std::log(p.minutes / std::max(given.minutes, 0.1)));
    };
    const Engerer2& p =
        *std::min_element(engerer2.begin(), engerer2.end(),
                          [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
    const double clear = threlkeld_jordan_clearness(given), k = given.clearness;
    const double enhanced = k > 0.0 ? std::max(0.0, 1.0 - clear / k) : 0.0;
    const double power =
        p.b0 + p.b1 * k + p.b2 * given.solar_hour + p.b3 * given.zenith_deg + p.b4 * (clear - k);
    return std::clamp(p.c + (1.0 - p.c) / (1.0 + std::exp(power)) + p.b5 * enhanced, 0.0, 1.0);
}

double diffuse_share(Separation model, const SeparationCase& given) {
    return model == Separation::erbs ? erbs_diffuse_share(given.clearness)
                                     : engerer2_diffuse_share(given);
}

}  // namespace diurna
