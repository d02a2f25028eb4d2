#include "render/detection/imager.hpp"

#include <memory>

#include "render/instrument/blur.hpp"
#include "render/instrument/noise.hpp"
#include "render/instrument/response.hpp"

namespace diurna {

Imager imager_of(const Instrument& instrument, const Band& band, double focal_length) {
    const auto mtf = std::make_shared<const SystemMtf>(instrument, band, focal_length);
    const double per_mrad = 1000.0 / focal_length;  // [1/m] in the picture's plane
    const Response response = response_of(instrument, band);
    return {.mtf_right = [mtf, per_mrad](double f) { return (*mtf)(f * per_mrad, 0.0); },
            .mtf_down = [mtf, per_mrad](double f) { return (*mtf)(0.0, f * per_mrad); },
            .pixel = 1000.0 * instrument.detector.pitch / focal_length,
            .netd = netd_at(300.0, instrument, response, noise_of(instrument, response)),
            .frame_rate = instrument.electronics.frame_rate};
}

}  // namespace diurna
