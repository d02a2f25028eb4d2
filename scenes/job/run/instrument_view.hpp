#pragma once

#include <memory>
#include <span>
#include <vector>

#include "render/instrument/camera.hpp"
#include "scenes/job/run/picture.hpp"
#include "scenes/job/run/series.hpp"

namespace diurna {

/// A prepared instrument, and an observer for its radiance: the same eye with more and smaller
/// pixels, in the band with the instrument's weight.
struct InstrumentView {
    const InstrumentInput& input;
    const ObserverInput& observer;
    Band band;  // the observer's
    Camera camera;
    ObserverInput seen;

    /// An observer's pose with the margins and the finer pixels.
    Observer widened(const Observer& pose) const;
};

/// The instrument views of an observer. `scene` must outlive them.
std::vector<std::unique_ptr<const InstrumentView>> instrument_views(const Scene& scene,
                                                                    const ObserverInput& observer);

/// One of them with its view from a pose.
struct InstrumentSeries {
    const InstrumentView& view;
    std::unique_ptr<const Observer> pose;
    std::unique_ptr<const Series> series;
};
std::vector<InstrumentSeries> cast_instruments(
    std::span<const std::unique_ptr<const InstrumentView>> views, const Prepared& prepared,
    const Observer& pose, std::span<const Instant> frames, const FacetViews& facets,
    const TemperatureField& field);

/// Flux of each pixel as the plane "flux.BAND" of a frame of the observer's size, with the facts of
/// its picture.
Frame seen_flux(const InstrumentSeries& one, const Prepared& prepared, const FacetViews& facets,
                const TemperatureField& field, Instant instant, bool blurred,
                const Picture& picture);

}  // namespace diurna
