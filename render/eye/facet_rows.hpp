#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/eye/eye_row.hpp"
#include "render/light/scene_light.hpp"

namespace diurna {

/// EyeRows of lit facets, in every band. For one thread.
class FacetRows {
 public:
    explicit FacetRows(const SceneLight& light);

    std::span<const EyeRow> layout() const { return layout_; }  // (band)
    /// - lit: index into LitFacets
    /// - out: (band) destination, with room for layout()[b].width() numbers
    void fill(std::uint32_t lit, std::span<float* const> out);

 private:
    const SceneLight& light_;
    std::vector<EyeRow> layout_;
    std::vector<float> black_, arriving_;
};

}  // namespace diurna
