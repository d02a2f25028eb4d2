#include "scenes/job/run/instrument_view.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/units.hpp"
#include "scenes/job/plan/instrument_cost.hpp"

namespace diurna {

namespace {

ObserverInput seen_by(const InstrumentInput& input, const ObserverInput& observer,
                      const Camera& camera) {
    const int times = camera.oversampling.times;
    ObserverInput seen = observer;
    seen.bands = {input.seen_band};
    seen.cubes.clear();
    seen.terms = false;
    seen.surfaces = 0;
    seen.instruments.clear();
    seen.width = camera.seen_width();
    seen.height = camera.seen_height();
    seen.samples = samples_of(observer, times);
    if (seen.adaptive) {
        const int square = times * times;
        seen.adaptive->from = std::max(2, seen.adaptive->from / square);
        seen.adaptive->to = std::max(seen.adaptive->from, seen.adaptive->to / square);
        seen.samples = seen.adaptive->from;
    }
    return seen;
}

}  // namespace

Observer InstrumentView::widened(const Observer& pose) const {
    Observer wide = pose;
    wide.width = seen.width;
    wide.height = seen.height;
    const double wider = double(camera.width + 2 * camera.margin) / camera.width;
    wide.horizontal_fov_deg =
        degrees(2.0 * std::atan(wider * std::tan(0.5 * radians(pose.horizontal_fov_deg))));
    return wide;
}

std::vector<std::unique_ptr<const InstrumentView>> instrument_views(const Scene& scene,
                                                                    const ObserverInput& observer) {
    std::vector<std::unique_ptr<const InstrumentView>> views;
    for (const InstrumentInput& input : scene.instruments) {
        const auto& wanted = observer.instruments;
        if (input.observer != observer.name ||
            std::find(wanted.begin(), wanted.end(), input.band) == wanted.end())
            continue;
        const Band band = named_band(scene.bands, input.band);
        Camera camera = camera_of(input.instrument, band, observer.width, observer.height,
                                  focal_length_of(observer, input.instrument.detector.pitch));
        ObserverInput seen = seen_by(input, observer, camera);
        views.push_back(std::make_unique<const InstrumentView>(
            InstrumentView{input, observer, band, std::move(camera), std::move(seen)}));
    }
    return views;
}

std::vector<InstrumentSeries> cast_instruments(
    std::span<const std::unique_ptr<const InstrumentView>> views, const Prepared& prepared,
    const Observer& pose, std::span<const Instant> frames, const FacetViews& facets,
    const TemperatureField& field) {
    std::vector<InstrumentSeries> all;
    for (const auto& view : views) {
        auto wide = std::make_unique<const Observer>(view->widened(pose));
        auto series = std::make_unique<const Series>(
            cast_series(prepared, view->seen, *wide, frames, facets, field));
        all.push_back({*view, std::move(wide), std::move(series)});
    }
    return all;
}

Frame seen_flux(const InstrumentSeries& one, const Prepared& prepared, const FacetViews& facets,
                const TemperatureField& field, Instant instant, bool blurred,
                const Picture& picture) {
    const Picture seen = picture_at(prepared, *one.series, facets, field, instant, blurred);
    const Frame& ideal = picture.frame;
    const std::string &band = one.view.band.name, &seen_band = one.view.input.seen_band;
    Frame frame;
    frame.width = ideal.width;
    frame.height = ideal.height;
    frame.instant = ideal.instant;
    frame.observer = ideal.observer;
    frame.attributes = ideal.attributes;
    for (const char* note : {"local_time", "solar_time", "moon"}) {
        const auto found = ideal.notes.find(note);
        if (found != ideal.notes.end()) frame.notes[note] = found->second;
    }
    const auto error = seen.frame.notes.find("error." + seen_band);
    if (error != seen.frame.notes.end()) frame.notes["error." + band] = error->second;
    const Camera& camera = one.view.camera;
    const std::string unit =
        camera.instrument.detector.kind == DetectorKind::photon ? "e- s-1" : "pW";
    frame.planes = {ideal["radiance." + band],
                    ideal["apparent_temperature." + band],
                    {"flux." + band, unit, see(camera, seen.frame["radiance." + seen_band].pixel)}};
    return frame;
}

}  // namespace diurna
