#include "scenes/studies/contrast_on_line.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "materials/atmosphere/sun_field.hpp"
#include "materials/base/units.hpp"
#include "materials/radiation/planck.hpp"
#include "scenes/studies/air_on_line.hpp"

namespace diurna {

namespace {

constexpr double sunlight_ends_um = 5.0;  // of what the air scatters

}  // namespace

ContrastOnLine::ContrastOnLine(const Atmosphere& air, const Band& band, const LineOfContrast& line,
                               const SeenContrast& seen)
    : air_(air), band_(band), line_(line) {
    const auto* model = std::get_if<BandModel>(&air);
    if (model && line.sun.zenith_deg < 90.0 && band.node_um.front() < sunlight_ends_um) {
        const auto field = std::make_shared<const SunField>(*model, line.sun, band.node_um);
        scattered_ = [field, azimuth = line.azimuth_from_sun_deg](const SightLine& way,
                                                                  double zenith_deg) {
            return field->path(way, zenith_deg, azimuth);
        };
    }
    const PathSpectrum near = path(seen.range);
    target_ = body_behind(near, seen.target);
    background_ = body_behind(near, seen.background);
    constexpr double apart = 0.5;  // [K]
    const double slope =
        (seen_through(near, target_ + apart) - seen_through(near, target_ - apart)) / (2.0 * apart);
    spread_ = slope > 0.0 ? seen.spread / slope : 0.0;
    const double own = (*this)(seen.range);
    if (own > 0.0) scale_ = std::hypot(seen.target - seen.background, seen.spread) / own;
}

double ContrastOnLine::operator()(double range) const {
    const PathSpectrum there = path(range);
    constexpr double apart = 0.5;  // [K]
    const double slope =
        (seen_through(there, target_ + apart) - seen_through(there, target_ - apart)) /
        (2.0 * apart);
    const double difference = seen_through(there, target_) - seen_through(there, background_);
    return scale_ * std::hypot(difference, spread_ * slope);
}

PathSpectrum ContrastOnLine::path(double range) const {
    const SightLine way = line_to_target(line_.target_height, line_.elevation_deg, range);
    PathSpectrum found = path_at_nodes(air_, way, band_.node_um);
    if (scattered_) {
        const std::vector<double> sunlight = scattered_(way, 90.0 + line_.elevation_deg);
        for (std::size_t i = 0; i < sunlight.size(); ++i) found.radiance[i] += sunlight[i];
    }
    return found;
}

double ContrastOnLine::seen_through(const PathSpectrum& path, double kelvin) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < band_.weight.size(); ++i) {
        sum += band_.weight[i] *
               (path.transmittance[i] * planck(band_.node_um[i], kelvin) + path.radiance[i]);
    }
    return brightness_temperature(band_, sum);
}

double ContrastOnLine::body_behind(const PathSpectrum& path, double apparent) const {
    double low = 2.0, high = 6000.0;  // [K]
    for (int i = 0; i < 200 && high - low > 1e-10 * high; ++i) {
        const double middle = 0.5 * (low + high);
        (seen_through(path, middle) < apparent ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

ContrastOverRange::ContrastOverRange(const ContrastOnLine& line, const SeenContrast& seen,
                                     double farthest)
    : root_step_(std::cbrt(farthest) / knots) {
    for (int k = 0; k <= knots; ++k) {
        const double range = std::max(1e-3, std::pow(k * root_step_, 3.0));
        logs_.push_back(std::log(std::max(1e-300, line(range))));
    }
    const double own = std::hypot(seen.target - seen.background, seen.spread);
    offset_ = std::log(std::max(1e-300, own)) - logarithm(seen.range);
}

double ContrastOverRange::logarithm(double range) const {
    const double place = std::min(std::cbrt(range) / root_step_, double(knots) - 1e-9);
    const auto cell = static_cast<std::size_t>(place);
    return std::lerp(logs_[cell], logs_[cell + 1], place - double(cell));
}

double ContrastOverRange::operator()(double range) const {
    return std::exp(logarithm(range) + offset_);
}

}  // namespace diurna
