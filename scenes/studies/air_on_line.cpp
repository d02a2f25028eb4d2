#include "scenes/studies/air_on_line.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/units.hpp"
#include "materials/radiation/planck.hpp"

namespace diurna {

SightLine line_to_target(double target_height, double elevation_deg, double range) {
    const double rise = range * std::sin(radians(elevation_deg));
    return chord((target_height + rise) / 1000.0, target_height / 1000.0, range / 1000.0);
}

AirOnLine::AirOnLine(const Atmosphere& air, const Band& band, double target_height,
                     double elevation_deg, double farthest) {
    constexpr double black_body = 300.0;  // [K]
    std::vector<double> weight(band.node_um.size());
    double all = 0.0;
    for (std::size_t i = 0; i < weight.size(); ++i) {
        weight[i] = band.weight[i] * planck_derivative(band.node_um[i], black_body);
        all += weight[i];
    }
    root_step_ = std::cbrt(farthest) / knots;
    logs_.push_back(0.0);
    for (int k = 1; k <= knots; ++k) {
        const double r = std::pow(k * root_step_, 3.0);
        const PathSpectrum path =
            path_at_nodes(air, line_to_target(target_height, elevation_deg, r), band.node_um);
        double sum = 0.0;
        for (std::size_t i = 0; i < weight.size(); ++i) sum += weight[i] * path.transmittance[i];
        logs_.push_back(std::log(std::max(1e-300, sum / all)));
    }
}

double AirOnLine::operator()(double range) const {
    const double place = std::min(std::cbrt(range) / root_step_, double(knots) - 1e-9);
    const auto cell = static_cast<std::size_t>(place);
    return std::exp(std::lerp(logs_[cell], logs_[cell + 1], place - double(cell)));
}

}  // namespace diurna
