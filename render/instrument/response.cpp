#include "render/instrument/response.hpp"

#include <algorithm>
#include <functional>
#include <numbers>
#include <set>

#include "materials/base/error.hpp"
#include "materials/radiation/planck.hpp"

namespace diurna {

namespace {

constexpr double planck_light_speed = 1.98644586e-25;  // [J m] h c, CODATA 2018
constexpr int pieces = 4;  // of each stretch between points of the spectra, for their product

double top_um(const Spectrum& response) { return response.wavelength_um.back(); }

/// The response times the weight of a wavelength: λ/λ_top to a photon detector.
Spectrum weighted(const Instrument& instrument, const Spectrum& response,
                  const std::function<double(double)>& factor) {
    const bool photon = instrument.detector.kind == DetectorKind::photon;
    std::set<double> points(response.wavelength_um.begin(), response.wavelength_um.end());
    const double from = *points.begin(), to = *points.rbegin();
    for (const Spectrum* other : {&instrument.lens.transmission, &instrument.detector.efficiency}) {
        for (const double at : other->wavelength_um) {
            if (at > from && at < to) points.insert(at);
        }
    }
    Spectrum product;
    const auto add = [&](double at) {
        product.wavelength_um.push_back(at);
        product.value.push_back(response.at(at) * instrument.detector.efficiency.at(at) *
                                factor(at) * (photon ? at / to : 1.0));
    };
    for (auto point = points.begin(); std::next(point) != points.end(); ++point) {
        const double next = *std::next(point);
        for (int i = 0; i < pieces; ++i) add(*point + (next - *point) * i / pieces);
    }
    add(to);
    return product;
}

double radiance_of(const Spectrum& weight, const std::string& name, double temperature) {
    if (*std::max_element(weight.value.begin(), weight.value.end()) <= 0.0) return 0.0;
    return band_radiance(response_band(name, weight), temperature);
}

}  // namespace

double Response::black_body(double temperature) const {
    return per_radiance * band_radiance(scene, temperature);
}

double Response::black_body_slope(double temperature) const {
    return per_radiance * band_radiance_derivative(scene, temperature);
}

Spectrum scene_weight(const Instrument& instrument, const Spectrum& response) {
    return weighted(instrument, response,
                    [&](double at) { return instrument.lens.transmission.at(at); });
}

Response response_of(const Instrument& instrument, const Band& band, double housing_temperature) {
    const Lens& lens = instrument.lens;
    const Detector& detector = instrument.detector;
    const double housing =
        housing_temperature > 0.0 ? housing_temperature : lens.housing_temperature;
    Response found;
    const Spectrum weight = scene_weight(instrument, band.response);
    if (*std::max_element(weight.value.begin(), weight.value.end()) <= 0.0) {
        throw InputError("instrument " + instrument.name,
                         "its lens and detector have no response in the band " + band.name);
    }
    found.scene = response_band(band.name, weight);
    const double solid_angle = std::numbers::pi / (4.0 * lens.f_number * lens.f_number + 1.0);
    const double area = detector.pitch * detector.pitch * detector.fill;
    const bool photon = detector.kind == DetectorKind::photon;
    // (T42) of docs/theory.md
    found.per_radiance =
        area * solid_angle * (photon ? top_um(band.response) * 1e-6 / planck_light_speed : 1e12);
    found.unit = photon ? "e-" : "pW";
    const Spectrum dark = weighted(instrument, band.response,
                                   [&](double at) { return 1.0 - lens.transmission.at(at); });
    const Spectrum wall = weighted(instrument, band.response, [](double) { return 1.0; });
    found.lens = found.per_radiance * radiance_of(dark, band.name, housing);
    found.walls = found.per_radiance * radiance_of(wall, band.name, housing);
    found.cold = found.per_radiance * radiance_of(wall, band.name, detector.temperature);
    if (!lens.cold_stop) {
        found.beside = found.walls * (std::numbers::pi - solid_angle) / solid_angle;
    }
    return found;
}

}  // namespace diurna
