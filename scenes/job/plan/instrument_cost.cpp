#include "scenes/job/plan/instrument_cost.hpp"

#include <algorithm>
#include <stdexcept>

#include "materials/base/error.hpp"
#include "render/instrument/camera.hpp"

namespace diurna {

const ObserverInput& observer_of(const Scene& scene, const InstrumentInput& input) {
    const auto found = std::find_if(
        scene.observers.begin(), scene.observers.end(),
        [&](const ObserverInput& observer) { return observer.name == input.observer; });
    if (found == scene.observers.end()) throw std::logic_error("an instrument without an observer");
    return *found;
}

int samples_of(const ObserverInput& observer, int times) {
    return (observer.samples + times * times - 1) / (times * times);
}

InstrumentCost instrument_cost(const Scene& scene, const InstrumentInput& input) {
    const ObserverInput& observer = observer_of(scene, input);
    const Instrument& instrument = input.instrument;
    const Band band = named_band(scene.bands, input.band);
    const double focal_length = focal_length_of(observer, instrument.detector.pitch);
    try {
        check_camera(instrument, band, observer.width, observer.height, focal_length);
    } catch (const InputError& error) {
        const Mistake& mistake = error.mistakes().front();
        throw InputError(input.where, mistake.problem, mistake.hint);
    }
    const SystemMtf mtf(instrument, band, focal_length);
    InstrumentCost cost{.name = instrument.name,
                        .oversampling = oversampling_of(instrument, mtf),
                        .left_out = left_out(instrument)};
    const int times = cost.oversampling.times;
    cost.samples = samples_of(observer, times);
    cost.seen_pixels = double(observer.width) * observer.height * times * times;
    return cost;
}

}  // namespace diurna
