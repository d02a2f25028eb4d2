#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "scenes/job/input/read_region.hpp"
#include "scenes/job/run/series.hpp"
#include "scenes/job/run/stages.hpp"

namespace diurna {

/// The first surface at every pixel of a series. Its own view omits pixels that see a net, a pane,
/// a mirror or a plume, whose rays are followed (render/rays/follow_rays.hpp).
View first_seen(const Prepared& prepared, const Series& series);

/// A region's surfaces, ascending; pixel rectangles have none, and copies those of the
/// original object.
std::vector<SurfaceId> surfaces_of(const Prepared& prepared, const RegionInput& region);

/// (pixel) share of a view's pixels that a region fills.
std::vector<float> region_cover(const View& view, const Prepared& prepared,
                                const RegionInput& region);

/// (region) Pixels of an observer at rest that a region fills completely. Throws InputError, with
/// the position in the scene file, for one that fills none.
///
/// - observer: of the scene's; samples: rays of a pixel
std::vector<std::vector<std::uint32_t>> filled_pixels(const Prepared& prepared,
                                                      std::size_t observer,
                                                      const std::vector<RegionInput>& asked,
                                                      int samples);

/// Regions of an observer's picture, and their apparent temperature at any instant. The view is
/// cast once, and only where it shows one of them.
class SeenRegions {
 public:
    /// Throws InputError for a region that fills no pixel.
    ///
    /// - stage: of a scene without motion; must outlive it
    /// - observer: of the scene's
    /// - field: temperatures; must outlive it
    /// - samples: rays of a pixel
    SeenRegions(const SceneStage& stage, std::size_t observer,
                const std::vector<RegionInput>& asked, const std::vector<std::string>& bands,
                const TemperatureField& field, int samples);

    /// Number of pixels that it fills.
    std::size_t pixels(std::size_t region) const { return pixel_[region].size(); }
    /// Mean over its pixels [K] of the apparent temperature in the band, air included: (region ·
    /// bands + band). Thread-safe.
    const std::vector<double>& apparent(Instant when) const;

 private:
    SceneStage stage_;
    const TemperatureField& field_;
    ObserverInput input_;
    Observer pose_;
    std::vector<std::vector<std::uint32_t>> pixel_;  // (region)
    std::unique_ptr<Series> series_;
    mutable std::mutex keeping_;
    mutable std::map<Instant, std::vector<double>> known_;
};

}  // namespace diurna
