#include "render/rays/angle_table.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/parallel.hpp"
#include "materials/matter/directional_optics.hpp"
#include "materials/radiation/planck.hpp"

namespace diurna {

namespace {

bool is_flat(const Spectrum& s) {
    return std::all_of(s.value.begin(), s.value.end(),
                       [&](double x) { return x == s.value.front(); });
}

/// Whether the interface reflects by angle alone, whatever the wavelength.
bool is_grey(const Glossy& finish) {
    return finish.metal || (is_flat(finish.index) && is_flat(finish.extinction));
}

}  // namespace

Lanes lanes_of(std::span<const Channels> channels) {
    Lanes lanes{{0}};
    for (const Channels& c : channels) lanes.first.push_back(lanes.first.back() + c.padded());
    return lanes;
}

double AngleTable::cosine_at(std::size_t node) {
    const double u = double(node) / double(nodes - 1);
    return u * u;
}

AngleTable::AngleTable(const Material& material, std::span<const Band> bands,
                       std::span<const Channels> channels, const Lanes& lanes, double temperature)
    : lanes_(lanes.size()) {
    values_.assign(nodes * parts * lanes_, 0.0f);
    hemisphere_.assign(lanes_, 0.0f);
    const auto* glossy = std::get_if<Glossy>(&material.finish);
    if (glossy) roughness_ = glossy->roughness;
    // A rough interface costs a thousand evaluations an angle: once for all bands where it can.
    std::vector<double> known;
    double known_normal = 0.0;
    if (glossy && is_grey(*glossy)) {
        known.resize(nodes);
        for_each_index(
            nodes,
            [&](std::size_t k) {
                known[k] = interface_reflectance(material.finish, 10.0, cosine_at(k));
            },
            8);
        known_normal = interface_reflectance(material.finish, 10.0, laboratory_cosine);
    }
    const auto fill = [&](const Band& band, std::span<const double> shape, std::size_t begin,
                          std::size_t end, std::size_t lane) {
        double total = 0.0;
        for (std::size_t n = begin; n < end; ++n) total += shape[n];
        // An index of refraction is one number in a channel.
        const double middle = band.node_um[(begin + end) / 2];
        const auto interface = [&](double cosine) {
            return interface_reflectance(material.finish, middle, cosine);
        };
        const double normal = known.empty() ? interface(laboratory_cosine) : known_normal;
        for (std::size_t k = 0; k < nodes; ++k) {
            const double here = known.empty() ? interface(cosine_at(k)) : known[k];
            float* at = &values_[k * parts * lanes_ + lane];
            for (std::size_t n = begin; n < end; ++n) {
                const double share = shape[n] / total;
                const DirectionalOptics o =
                    directional_optics(material, band.node_um[n], cosine_at(k), here, normal);
                at[0] += static_cast<float>(share * o.mirrored);
                at[lanes_] += static_cast<float>(share * o.diffuse);
                at[2 * lanes_] += static_cast<float>(share * o.transmittance);
            }
        }
        // With cosθ = u², nodes equal in u: ∫ f 4 u³ du.
        for (std::size_t k = 0; k < nodes; ++k) {
            const double u = double(k) / double(nodes - 1);
            const double ends = k == 0 || k + 1 == nodes ? 0.5 : 1.0;
            hemisphere_[lane] += static_cast<float>(ends * 4.0 * u * u * u / double(nodes - 1)) *
                                 values_[(k * parts + 1) * lanes_ + lane];
        }
    };
    for (std::size_t b = 0; b < bands.size(); ++b) {
        const Band& band = bands[b];
        std::vector<double> shape(band.node_um.size());
        for (std::size_t n = 0; n < shape.size(); ++n) {
            shape[n] = band.weight[n] * planck(band.node_um[n], temperature) + 1e-300;
        }
        for_each_index(
            channels[b].size(),
            [&](std::size_t c) {
                fill(band, shape, channels[b].first[c], channels[b].first[c + 1],
                     lanes.first[b] + c);
            },
            1);
    }
}

AngleTable::Place AngleTable::at(double cosine) const {
    const double u = std::sqrt(std::clamp(cosine, 0.0, 1.0)) * double(nodes - 1);
    const std::size_t k = std::min(nodes - 2, static_cast<std::size_t>(u));
    const float* low = &values_[k * parts * lanes_];
    return {low, low + parts * lanes_, static_cast<float>(u - double(k)), lanes_};
}

}  // namespace diurna
