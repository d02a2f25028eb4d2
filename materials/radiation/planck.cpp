#include "materials/radiation/planck.hpp"

#include <cassert>
#include <cmath>

#include "materials/base/units.hpp"

namespace diurna {

namespace {

double fifth_power(double x) { return (x * x) * (x * x) * x; }

}  // namespace

double planck(double wavelength_um, double temperature) {
    assert(wavelength_um > 0.0 && temperature >= 0.0);
    // (T34) of docs/theory.md
    const double x = second_radiation_um / (wavelength_um * temperature);
    return first_radiation_um / (fifth_power(wavelength_um) * std::expm1(x));
}

double planck_temperature(double wavelength_um, double radiance) {
    const double x = std::log1p(first_radiation_um / (fifth_power(wavelength_um) * radiance));
    return second_radiation_um / (wavelength_um * x);
}

double planck_derivative(double wavelength_um, double temperature) {
    const double x = second_radiation_um / (wavelength_um * temperature);
    const double radiance = planck(wavelength_um, temperature);
    // ∂B/∂T = B (x / T) eˣ / (eˣ − 1); the product 0 · ∞ of a body too cold to shine is 0.
    return radiance > 0.0 ? radiance * (x / temperature) / -std::expm1(-x) : 0.0;
}

double band_radiance(const Band& band, double temperature) {
    // (T35) of docs/theory.md
    double sum = 0.0;
    for (std::size_t i = 0; i < band.node_um.size(); ++i) {
        sum += band.weight[i] * planck(band.node_um[i], temperature);
    }
    return sum;
}

double band_radiance_derivative(const Band& band, double temperature) {
    double sum = 0.0;
    for (std::size_t i = 0; i < band.node_um.size(); ++i) {
        sum += band.weight[i] * planck_derivative(band.node_um[i], temperature);
    }
    return sum;
}

double brightness_temperature(const Band& band, double radiance) {
    if (!(radiance > 0.0)) return 0.0;
    // (T41) of docs/theory.md.
    // ln L is nearly linear in u = 1/T (Wien), so Newton runs there; the bracket catches what is
    // outside Wien's range or where L underflows.
    double cold = 1.0, hot = 300.0;
    while (band_radiance(band, hot) < radiance && hot < 1e30) {
        cold = hot;
        hot *= 4.0;
    }
    while (cold > 1e-3 && band_radiance(band, cold) > radiance) cold /= 4.0;
    double temperature = std::sqrt(cold * hot);
    for (int iteration = 0; iteration < 200; ++iteration) {
        const double value = band_radiance(band, temperature);
        (value < radiance ? cold : hot) = temperature;
        double next = 0.0;
        if (value > 0.0) {
            const double slope = band_radiance_derivative(band, temperature);  // dL/dT
            // du = −dT/T²; d ln L / du = −T² L'/L.
            const double u = 1.0 / temperature + std::log(value / radiance) * value /
                                                     (slope * temperature * temperature);
            next = 1.0 / u;
        }
        if (!(next > cold && next < hot)) next = 0.5 * (cold + hot);
        const double change = std::abs(next - temperature);
        temperature = next;
        if (change <= 1e-13 * temperature || hot - cold <= 1e-13 * hot) break;
    }
    return temperature;
}

}  // namespace diurna
