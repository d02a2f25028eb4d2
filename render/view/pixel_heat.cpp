#include "render/view/pixel_heat.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "terrain/texture/level_values.hpp"
#include "terrain/visibility/two_sides.hpp"

namespace diurna {

namespace {

/// Facets at each vertex, in compressed rows.
struct AtVertex {
    std::vector<std::uint32_t> row, facet;

    AtVertex(const FacetSet& facets, std::size_t known) : row(facets.vertex.size() + 1, 0) {
        for (std::size_t f = 0; f < known; ++f) {
            for (const std::uint32_t v : facets.corner[f]) ++row[v + 1];
        }
        for (std::size_t v = 1; v < row.size(); ++v) row[v] += row[v - 1];
        facet.resize(row.back());
        std::vector<std::uint32_t> next(row.begin(), row.end() - 1);
        for (std::size_t f = 0; f < known; ++f) {
            for (const std::uint32_t v : facets.corner[f]) {
                facet[next[v]++] = static_cast<std::uint32_t>(f);
            }
        }
    }
};

/// Sums of a straight line through points, and the range of what they have.
struct Line {
    double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    double low = 1e30, high = -1e30;

    void add(double share, double kelvins) {
        n += 1.0;
        x += share;
        y += kelvins;
        xx += share * share;
        xy += share * kelvins;
        low = std::min(low, kelvins);
        high = std::max(high, kelvins);
    }
    /// Through (share, kelvins), ends at 0 and 1 within the range; or `most`, if above 0.
    double slope(double share, double kelvins, double most) const {
        const double spread = n * xx - x * x;
        if (!(spread > 1e-4 * n * n)) return 0.0;
        double slope = std::max(0.0, (n * xy - x * y) / spread);
        if (most > 0.0) return std::min(slope, most);
        if (share < 1.0) slope = std::min(slope, (high - kelvins) / (1.0 - share));
        if (share > 0.0) slope = std::min(slope, (kelvins - low) / share);
        return slope;
    }
};

constexpr double most_held = 15e3;  // [J m⁻² K⁻¹]

double held_by(const ThermalSurface& surface) {
    double held = 0.0;
    for (const Layer& layer : surface.layers) {
        held += layer.thickness * layer.density * layer.heat_capacity;
    }
    return held;
}

/// What holds a surface's temperature where the sun comes and goes.
struct Thin {
    bool follows = false, is_back = false;
    double absorptance = 0.0, film = 0.0, emissivity = 0.0;  // the latter two of all its faces
};
Thin thin_surface(const ThermalSurface& surface) {
    constexpr double least_film = 4.0;  // [W m⁻² K⁻¹]
    const auto* constant = std::get_if<ConstantFilm>(&surface.convection);
    const double film = constant ? constant->film : least_film;
    const double faces = surface.back ? 2.0 : 1.0;
    return {.follows = !surface.layers.empty() && follows_at_once(surface),
            .is_back = surface.layers.empty(),
            .absorptance = 1.0 - surface.albedo - surface.solar_transmittance,
            .film = faces * film,
            .emissivity = surface.emissivity + (surface.back ? surface.back->emissivity : 0.0)};
}

}  // namespace

bool follows_at_once(const ThermalSurface& surface) { return held_by(surface) < most_held; }

std::vector<float> kelvins_of_sun(const FacetSet& facets, std::span<const std::uint8_t> crossed,
                                  std::span<const float> share, std::span<const float> temperature,
                                  std::span<const float> most) {
    constexpr float one_plane = 0.985f;  // cosine of 10°
    const AtVertex at_vertex(facets, crossed.size());
    std::vector<float> slope(crossed.size(), 0.0f);
    for_each_index(crossed.size(), [&](std::size_t f) {
        if (crossed[f] == 0) return;
        Line line;
        for (const std::uint32_t v : facets.corner[f]) {
            for (std::uint32_t k = at_vertex.row[v]; k < at_vertex.row[v + 1]; ++k) {
                const std::uint32_t other = at_vertex.facet[k];
                if (facets.material[other] != facets.material[f]) continue;
                if (facets.normal[other].dot(facets.normal[f]) < one_plane) continue;
                line.add(double{share[other]}, double{temperature[other]});
            }
        }
        slope[f] = static_cast<float>(
            line.slope(double{share[f]}, double{temperature[f]}, double{most[f]}));
    });
    return slope;
}

std::vector<float> most_kelvins_of_sun(const FacetSet& facets, const MaterialLibrary& materials,
                                       const Eigen::Vector3d& to_sun,
                                       std::span<const float> temperature) {
    std::vector<Thin> thin;
    for (std::size_t m = 0; m < materials.size(); ++m) {
        thin.push_back(thin_surface(materials[MaterialId{static_cast<std::uint16_t>(m)}].thermal));
    }
    // The back of a sheet has no layers of its own.
    std::vector<std::uint32_t> other;
    if (std::any_of(thin.begin(), thin.end(), [](const Thin& t) { return t.is_back; })) {
        other = other_sides(facets);
    }
    std::vector<float> most(facets.size(), 0.0f);
    const Eigen::Vector3f sun = to_sun.cast<float>();
    const auto of_facet = [&](std::size_t f) {
        const float cosine = facets.normal[f].dot(sun);
        const Thin& face = thin[index(facets.material[f])];
        const bool behind = face.is_back && !other.empty() && other[f] != index(no_facet);
        const Thin& whole = behind ? thin[index(facets.material[other[f]])] : face;
        if (cosine <= 0.0f || !whole.follows) return 0.0;
        const double sent = whole.film + 4.0 * whole.emissivity * stefan_boltzmann *
                                             std::pow(double{temperature[f]}, 3);
        return 1000.0 * double{cosine} * face.absorptance / sent;
    };
    for_each_index(
        most.size(), [&](std::size_t f) { most[f] = static_cast<float>(of_facet(f)); }, 4096);
    return most;
}

void set_pixel_heat(const View& view, const SunOverFacets& sun, const MaterialLibrary& materials,
                    std::span<const float> temperature, const TextureLevels* levels,
                    PixelSun& pixels) {
    if (pixels.sighting.empty()) return;
    std::vector<std::uint8_t> crossed = pixels.crossed;
    if (levels != nullptr) crossed = on_surfaces(*levels, std::move(crossed));
    const std::span<const float> mean = sun.past ? std::span(sun.past->share) : sun.fraction;
    const std::vector<float>& share = sun.past ? pixels.past_share : pixels.share;
    const std::vector<float> kelvins =
        kelvins_of_sun(sun.facets, crossed, mean, temperature,
                       most_kelvins_of_sun(sun.facets, materials, sun.to_sun, temperature));
    pixels.warmer.resize(pixels.sighting.size());
    pixels.kelvins.resize(pixels.sighting.size());
    for (std::size_t e = 0; e < pixels.warmer.size(); ++e) {
        const std::size_t facet = index(view.surface[view.sighting[pixels.sighting[e]].target]);
        pixels.kelvins[e] = kelvins[facet];
        pixels.warmer[e] = kelvins[facet] * (share[e] - mean[facet]);
    }
}

}  // namespace diurna
