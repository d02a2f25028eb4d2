#pragma once

#include <complex>
#include <numbers>

#include "thermal/point/point_job.hpp"
#include "thermal/point/run_column.hpp"

/// Jobs of the point tool for cases with a closed form.
namespace column_jobs {

using namespace diurna;

inline const Instant noon_free = parse_instant("2020-06-01T00:00:00Z");
inline constexpr double day = 86400.0;

/// A horizontal facet over `layers` that only exchanges by film and, if asked, radiation.
inline PointJob facet_over(std::vector<Layer> layers, Bottom bottom, double film,
                           double emissivity) {
    PointJob job;
    job.surface.albedo = 0.0;
    job.surface.emissivity = emissivity;
    job.surface.convection = ConstantFilm{film};
    job.surface.layers = std::move(layers);
    job.surface.bottom = bottom;
    job.start = noon_free;
    job.end = later(noon_free, day);
    job.spin_up = SpinUp::periodic;
    return job;
}

/// Weather sampled every `every` seconds through a day.
template <class Absorbed, class Air>
void drive(PointJob& job, const Absorbed& absorbed, const Air& air, double longwave,
           double every = 300.0) {
    job.weather = {};
    for (double t = 0.0; t <= seconds_between(job.start, job.end) + 1.0; t += every) {
        Forcing forcing;
        forcing.air.temperature = air(t);
        forcing.shortwave_down = absorbed(t);
        forcing.longwave_down = longwave;
        job.weather.instant.push_back(later(job.start, t));
        job.weather.sample.push_back(forcing);
    }
}

/// First harmonic of the surface temperature, as amplitude · exp(−i lag).
inline std::complex<double> harmonic(const PointResult& result, int order = 1) {
    std::complex<double> sum = 0.0;
    const std::size_t n = result.row.size() - 1;  // the last row repeats the first
    for (std::size_t i = 0; i < n; ++i) {
        const double phase = 2.0 * std::numbers::pi * order * double(i) / double(n);
        sum += result.row[i].surface_temperature * std::polar(1.0, -phase);
    }
    return 2.0 * sum / double(n);
}

inline constexpr Layer deep{4.0, 1.0, 2000.0, 1000.0};  // k = 1, C = 2e6: 34 skin depths

}  // namespace column_jobs
