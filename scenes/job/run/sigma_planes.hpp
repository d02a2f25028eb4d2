#pragma once

#include <optional>
#include <vector>

#include "render/picture/frame.hpp"
#include "scenes/job/run/series.hpp"
#include "scenes/job/run/uncertain_scenes.hpp"

namespace diurna {

/// A scene as it stands at an instant: the stage, or with objects on their way.
struct StandingScene {
    SceneStage stage;
    std::optional<Prepared> on_the_way{};

    const Prepared& prepared() const { return on_the_way ? *on_the_way : stage.prepared; }
};

/// An observer's series in a scene with an uncertain value changed.
struct ChangedSeries {
    const StandingScene& scene;
    const TemperatureField& field;
    Series series;
};

/// Adds a plane sigma.BAND for each band of a frame: the standard deviation of the band's apparent
/// temperature [K], or of its radiance where the quick-look shows that
/// (render/picture/quicklook.hpp), due to the uncertain values: the root sum square of the pixel's
/// changes when they are changed one after the other, by one standard deviation each. To first
/// order, for independent values: (T54) of docs/theory.md; NaN where a picture has no value. All of
/// it is included that a value changes: heat, light, air and emissivity. Rays are those of the
/// frame, so the noise of a pixel cancels.
///
/// - changed: the same observer in the scenes with changed values
/// - blurred: as in the frame (scenes/job/run/picture.hpp)
void add_sigma_planes(const std::vector<ChangedSeries>& changed, const std::vector<Band>& bands,
                      Instant instant, bool blurred, Frame& frame);

}  // namespace diurna
