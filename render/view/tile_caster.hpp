#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "render/view/observer.hpp"
#include "render/view/tile_sightings.hpp"
#include "render/view/view.hpp"
#include "terrain/facets.hpp"
#include "terrain/visibility/ray_scene.hpp"

namespace diurna {

inline constexpr std::size_t tile_size = 32;

/// Pixels of a rectangle.
struct Area {
    std::size_t x0, x1, y0, y1;
    std::size_t size() const { return (x1 - x0) * (y1 - y0); }
};
inline std::size_t tile_count(const View& view) {
    return ((std::size_t(view.width) + tile_size - 1) / tile_size) *
           ((std::size_t(view.height) + tile_size - 1) / tile_size);
}
/// The area of tile t, of 32 x 32 pixels; they are counted row by row.
inline Area tile_area(const View& view, std::size_t t) {
    const auto width = static_cast<std::size_t>(view.width);
    const auto height = static_cast<std::size_t>(view.height);
    const std::size_t columns = (width + tile_size - 1) / tile_size;
    const std::size_t x0 = t % columns * tile_size, y0 = t / columns * tile_size;
    return {x0, std::min(width, x0 + tile_size), y0, std::min(height, y0 + tile_size)};
}

/// A tile is processed block by block, so that consecutive rays are close to each other.
template <class Body>
void each_block(const Area& area, const Body& body) {
    constexpr std::size_t block = 4;
    for (std::size_t y = area.y0; y < area.y1; y += block) {
        for (std::size_t x = area.x0; x < area.x1; x += block) {
            body(Area{x, std::min(area.x1, x + block), y, std::min(area.y1, y + block)});
        }
    }
}
template <class Body>
void each_pixel(const Area& area, const Body& body) {
    for (std::size_t y = area.y0; y < area.y1; ++y) {
        for (std::size_t x = area.x0; x < area.x1; ++x) body(x, y);
    }
}

/// Directions in which a tile sees sky.
struct SkyExtent {
    std::size_t pixels = 0;
    std::array<float, 2> zenith_deg{1e30f, -1e30f}, azimuth_deg{1e30f, -1e30f};

    void add(float zenith, float azimuth) {
        ++pixels;
        zenith_deg = {std::min(zenith_deg[0], zenith), std::max(zenith_deg[1], zenith)};
        azimuth_deg = {std::min(azimuth_deg[0], azimuth), std::max(azimuth_deg[1], azimuth)};
    }
};

/// Targets of a tile; its pixels are processed block by block.
struct TileView {
    TileSightings sightings;
    float near = 1e30f, far = 0.0f, low = 1e30f, high = -1e30f;  // [m] of its targets
    SkyExtent sky;
};

/// Casts the samples and the centres of tiles of a view. Sky and pixels' centres are written
/// into the view itself, where tiles do not overlap; `view` has planes of its full size.
/// Thread-safe.
class TileCaster {
 public:
    TileCaster(const RayScene& scene, const FacetSet& facets, const Observer& observer,
               const ViewOptions& options, View& view);
    ~TileCaster();
    /// Tiles [begin, end) into their places.
    void cast(std::size_t begin, std::size_t end, std::vector<TileView>& tiles) const;

 private:
    class State;
    std::unique_ptr<State> state_;
};

}  // namespace diurna
