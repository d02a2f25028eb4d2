#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "materials/radiation/band.hpp"
#include "render/light/incident_light.hpp"

namespace diurna {

/// A few spectra whose sum represents the sky's light on every facet of a scene in a band, by its
/// sky view, its view of the uneven sky and its height: principal components of the sky's mean and
/// of its functions' coefficients at three heights, to 1e-5 of the whole; the residual of the
/// functions is projected on these.
struct SkyModes {
    static constexpr std::size_t most = 3 * (1 + uneven_functions);
    std::vector<LightByOrigin> spectrum;  // (mode) [W m⁻² sr⁻¹ µm⁻¹]
    // Rows of modes, and of zeros up to whole lanes (render/light/lanes.hpp).
    Eigen::MatrixXf share;   // (mode, height × function) of a facet's numbers
    Eigen::MatrixXf narrow;  // (mode, height × direction) of its NarrowView

    std::size_t size() const { return spectrum.size(); }
    /// Coefficients of a facet.
    ///
    /// - narrow: its NarrowView, or empty
    /// - up: weights of the three heights
    void of(float sky_view, const UnevenView& uneven, std::span<const float> narrow,
            const std::array<float, 3>& up, float* out) const;
};

/// - incident: at the three heights of LitFacets
SkyModes sky_modes(const Band& band, const std::array<IncidentLight, 3>& incident);

}  // namespace diurna
