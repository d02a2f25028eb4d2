#include "thermal/weather/tilted_sky.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "materials/base/units.hpp"

namespace diurna {

TiltedSky::Tilt TiltedSky::tilt_of(double slope) {
    // Σ (ln sec z − ½) cos(incidence) dω / π in rings around the zenith. With s = sin² z the
    // weights are exact for a level facet: ∫ (ln sec z − ½) ds = ½ (1 − s) ln(1 − s).
    constexpr int rings = 180;
    constexpr double b = 0.09;
    const auto primitive = [](double s) {
        return s < 1.0 ? 0.5 * (1.0 - s) * std::log(1.0 - s) : 0.0;
    };
    const double up = std::cos(slope), across = std::sin(slope);
    Tilt tilt{.view = {0.0}, .excess = {0.0}};
    double last = 0.0;
    // Finer towards the horizon, where ln sec z has no end.
    const auto edge_of = [&](int i) {
        const double left = 1.0 - double(i) / rings;
        return 0.5 * std::numbers::pi * (1.0 - left * left);
    };
    for (int i = 0; i < rings; ++i) {
        const double s = i + 1 == rings ? 1.0 : std::pow(std::sin(edge_of(i + 1)), 2);
        const double z = 0.5 * (edge_of(i) + edge_of(i + 1));
        // Mean over the ring of max(0, cos(incidence)) / cos z.
        const double level = up, swing = across * std::tan(z);
        double seen = std::max(level, 0.0);
        if (std::abs(level) < swing) {
            const double edge = std::acos(-level / swing);
            seen = (level * edge + swing * std::sin(edge)) / std::numbers::pi;
        }
        tilt.view.push_back(tilt.view.back() + seen * (s - last));
        tilt.excess.push_back(tilt.excess.back() + b * seen * (primitive(s) - primitive(last)));
        last = s;
    }
    return tilt;
}

double TiltedSky::at(const Tilt& tilt, double share) {
    const double view = share * tilt.view.back();
    const auto above = std::upper_bound(tilt.view.begin(), tilt.view.end(), view);
    if (above == tilt.view.end()) return tilt.excess.back();
    const auto i = static_cast<std::size_t>(above - tilt.view.begin());
    const double part = (view - tilt.view[i - 1]) / (tilt.view[i] - tilt.view[i - 1]);
    return std::lerp(tilt.excess[i - 1], tilt.excess[i], part);
}

TiltedSky::TiltedSky() {
    for (int degree = 0; degree <= 180; degree += 2) tilt_.push_back(tilt_of(radians(degree)));
}

double TiltedSky::excess(double up_cosine, double sky_view) const {
    const double whole = 0.5 * (1.0 + up_cosine);
    const double share = whole > 0.0 ? std::min(1.0, sky_view / whole) : 0.0;
    const double place = 0.5 * degrees(std::acos(std::clamp(up_cosine, -1.0, 1.0)));
    const auto i = std::min(static_cast<std::size_t>(place), tilt_.size() - 2);
    return std::lerp(at(tilt_[i], share), at(tilt_[i + 1], share), place - double(i));
}

double tilted_sky_excess(double slope, double sky_view) {
    const double whole = 0.5 * (1.0 + std::cos(slope));
    const double share = whole > 0.0 ? std::min(1.0, sky_view / whole) : 0.0;
    return TiltedSky::at(TiltedSky::tilt_of(slope), share);
}

}  // namespace diurna
