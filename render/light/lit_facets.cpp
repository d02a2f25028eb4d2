#include "render/light/lit_facets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

namespace {

template <class Body>
void each_source(const ViewFactors& exchange, std::size_t f, const Body& body) {
    for (std::uint32_t k = exchange.row[f]; k < exchange.row[f + 1]; ++k) {
        body(index(exchange.facet[k]), double{exchange.factor[k]});
    }
}

/// Steps from the eye: 1 seen, 2 shines on one seen, 3 shines on one of those, 0 none of these.
std::vector<std::uint8_t> steps_from_eye(const RadianceInput& input,
                                         std::span<const FacetId> seen) {
    std::vector<std::uint8_t> step(input.facets.size(), 0);
    for (const FacetId id : seen) step[index(id)] = 1;
    for (std::uint8_t now = 1; now <= 2; ++now) {
        for (std::size_t f = 0; f < step.size(); ++f) {
            if (step[f] != now) continue;
            each_source(input.views.others, f, [&](std::size_t from, double) {
                if (step[from] == 0) step[from] = static_cast<std::uint8_t>(now + 1);
            });
        }
    }
    return step;
}

LitFacets::Worth worth_of(const Band& band, const RadianceInput& input, const LitFacets& lit,
                          std::span<const std::uint8_t> step) {
    std::vector<float> greatest(input.materials.size(), 0.0f);
    for (std::size_t m = 0; m < greatest.size(); ++m) {
        if (!lit.material_used[m]) continue;
        const Material& material = input.materials[MaterialId{static_cast<std::uint16_t>(m)}];
        for (const double um : band.node_um) {
            greatest[m] = std::max(greatest[m], static_cast<float>(material.reflectance.at(um)));
        }
    }
    const auto response = [&](std::size_t i) {
        return lit.row[i] == lit.row[i + 1]
                   ? 0.0f
                   : greatest[index(lit.material[i])] * (1.0f - lit.sky_view[i]);
    };
    LitFacets::Worth worth;
    worth.twice.assign(lit.facet.size(), 0.0f);
    for (std::size_t i = 0; i < lit.facet.size(); ++i) {
        if (step[index(lit.facet[i])] != 1) continue;
        const float r = response(i);
        if (r > 0.0f) worth.closed = std::max(worth.closed, 1.0f - lit.sky_view[i]);
        for (std::uint32_t k = lit.row[i]; k < lit.row[i + 1]; ++k) {
            float& most = worth.twice[lit.source[k]];
            most = std::max(most, r);
        }
    }
    float most = 0.0f, most_twice = 0.0f;
    for (std::size_t i = 0; i < lit.facet.size(); ++i) {
        const float r = response(i);
        most = std::max(most, r);
        worth.twice[i] *= r;
        most_twice = std::max(most_twice, worth.twice[i]);
    }
    // The rows of the third facet may be left out of `lit`, but not its sky view.
    float third = most;
    for (std::size_t i = 0; i < lit.facet.size(); ++i) {
        third = std::max(third, greatest[index(lit.material[i])] * (1.0f - lit.sky_view[i]));
    }
    worth.thrice = most_twice * third;
    return worth;
}

}  // namespace

LitFacets lit_facets(const RadianceInput& input, std::span<const FacetId> seen,
                     std::span<const Band> bands) {
    const FacetSet& facets = input.facets;
    const ViewFactors& exchange = input.views.others;
    const std::vector<std::uint8_t> step = steps_from_eye(input, seen);

    LitFacets lit;
    std::vector<std::uint32_t> place(facets.size(), LitFacets::absent);  // in `lit`
    lit.material_used.assign(input.materials.size(), false);
    std::size_t entries = 0;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        if (step[f] == 0) continue;
        place[f] = static_cast<std::uint32_t>(lit.facet.size());
        lit.facet.push_back(FacetId{static_cast<std::uint32_t>(f)});
        lit.material.push_back(facets.material[f]);
        lit.sky_view.push_back(input.views.sky[f]);
        lit.material_used[index(facets.material[f])] = true;
        if (step[f] <= 2) entries += exchange.row[f + 1] - exchange.row[f];
    }
    for (const FacetId id : seen) lit.target.push_back(place[index(id)]);
    lit.row.reserve(lit.facet.size() + 1);
    lit.source.reserve(entries);
    lit.factor.reserve(entries);
    lit.row.push_back(0);
    lit.sends.assign(lit.facet.size(), 0);
    std::vector<double> height_km(lit.facet.size());
    for (std::size_t i = 0; i < lit.facet.size(); ++i) {
        const std::size_t f = index(lit.facet[i]);
        if (step[f] <= 2) {
            double total = 0.0;
            each_source(exchange, f, [&](std::size_t, double factor) { total += factor; });
            const double rest = 1.0 - double{input.views.sky[f]};
            each_source(exchange, f, [&](std::size_t from, double factor) {
                if (factor == 0.0) return;  // a row of nothing but zeros is no row
                lit.source.push_back(place[from]);
                lit.sends[place[from]] = 1;
                lit.factor.push_back(static_cast<float>(rest * factor / total));
            });
        }
        lit.row.push_back(static_cast<std::uint32_t>(lit.source.size()));
        height_km[i] =
            input.ground_height_km + 1e-3 * level_height(facets.centroid[f].cast<double>());
    }
    lit.height.assign(lit.facet.size(), 0.0f);
    if (!lit.facet.empty()) {
        const auto [least, most] = std::minmax_element(height_km.begin(), height_km.end());
        lit.height_km = {*least, 0.5 * (*least + *most), *most};
        const double half = lit.height_km[1] - lit.height_km[0];
        for (std::size_t i = 0; i < lit.facet.size() && half > 1e-6; ++i) {
            lit.height[i] = static_cast<float>((height_km[i] - lit.height_km[1]) / half);
        }
    }
    for (const Band& band : bands) lit.worth.push_back(worth_of(band, input, lit, step));
    return lit;
}

LitState lit_state(const RadianceInput& input, const LitFacets& lit) {
    const std::size_t n = lit.facet.size();
    LitState state;
    state.temperature.resize(n);
    state.sunlight.assign(n, 0.0f);
    if (n == 0) return state;
    const Eigen::Vector3f to_sun = input.to_sun.cast<float>();
    constexpr std::size_t grain = 8192;
    std::vector<TemperatureExtent> extents((n + grain - 1) / grain);
    for_each_block(n, grain, [&](std::size_t begin, std::size_t end) {
        TemperatureExtent extent{.coldest = 1e30f, .hottest = 0.0f};
        for (std::size_t i = begin; i < end; ++i) {
            const std::size_t f = index(lit.facet[i]);
            const float temperature = input.temperature[f];
            if (!(temperature >= 1.0f && temperature <= 5000.0f)) {
                throw InputError(
                    fmt::format("facet {}", f),
                    fmt::format("has a temperature of {} K, expected 1 to 5000", temperature));
            }
            state.temperature[i] = temperature;
            extent.coldest = std::min(extent.coldest, temperature);
            extent.hottest = std::max(extent.hottest, temperature);
            if (!input.sun_fraction.empty() && input.sun_fraction[f] > 0.0f) {
                state.sunlight[i] = input.sun_fraction[f] / std::numbers::pi_v<float> *
                                    std::max(0.0f, input.facets.normal[f].dot(to_sun));
            }
        }
        extents[begin / grain] = extent;
    });
    state.extent = {.coldest = 1e30f, .hottest = 0.0f};
    for (const TemperatureExtent& e : extents) {
        state.extent.coldest = std::min(state.extent.coldest, e.coldest);
        state.extent.hottest = std::max(state.extent.hottest, e.hottest);
    }
    return state;
}

}  // namespace diurna
