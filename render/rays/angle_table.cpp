#include "render/rays/angle_table.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

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
bool is_grey(const Glossy& finish) { return is_flat(finish.index) && is_flat(finish.extinction); }

}  // namespace

AngleTable::AngleTable(const Material& material, std::span<const BandLight> bands,
                       const ChannelLanes& lanes, double temperature)
    : lanes_(lanes.size()) {
    values_.assign(nodes * parts * lanes_, 0.0f);
    hemisphere_.assign(lanes_, 0.0f);
    const auto* glossy = std::get_if<Glossy>(&material.finish);
    if (glossy) {
        roughness_ = glossy->roughness;
        shares_.resize(nodes + 1);
        for_each_index(
            nodes + 1,
            [&](std::size_t k) {
                shares_[k] = facing_shares(microfacets_of(*glossy),
                                           k < nodes ? cosine_at(k) : laboratory_cosine);
            },
            8);
    }
    std::optional<Interface> grey;
    if (glossy && is_grey(*glossy)) grey = interface_of(material, 10.0);
    for (std::size_t b = 0; b < bands.size(); ++b) {
        const Band& band = bands[b].band;
        const Channels& channels = bands[b].channels;
        std::vector<double> shape(band.node_um.size());
        for (std::size_t n = 0; n < shape.size(); ++n) {
            shape[n] = band.weight[n] * planck(band.node_um[n], temperature) + 1e-300;
        }
        for_each_index(
            channels.size(),
            [&](std::size_t c) {
                // An index of refraction is one number in a channel.
                const double middle = band.node_um[(channels.first[c] + channels.first[c + 1]) / 2];
                const std::size_t lane = lanes.first[b] + c;
                fill(material, bands[b], shape, c, lane,
                     grey ? *grey : interface_of(material, middle));
                average(lane);
            },
            1);
    }
    shares_.clear();
}

AngleTable::Interface AngleTable::interface_of(const Material& material,
                                               double wavelength_um) const {
    Interface interface { std::vector<double>(nodes, 0.0), std::vector<double>(nodes, 0.0), 0.0 };
    const auto* glossy = std::get_if<Glossy>(&material.finish);
    if (glossy == nullptr) return interface;
    std::vector<double> smooth(facing_nodes);
    for (std::size_t k = 0; k < facing_nodes; ++k) {
        smooth[k] = smooth_reflectance(*glossy, wavelength_um, facing_cosine(k));
    }
    const auto mean = [&](const std::vector<double>& shares) {
        return std::inner_product(smooth.begin(), smooth.end(), shares.begin(), 0.0);
    };
    for (std::size_t k = 0; k < nodes; ++k) interface.at_node[k] = mean(shares_[k]);
    interface.normal = mean(shares_[nodes]);
    static_assert(nodes == facing_nodes);
    interface.smooth = std::move(smooth);
    return interface;
}

/// - shape: (node) weight of the band's nodes
void AngleTable::fill(const Material& material, const BandLight& band,
                      std::span<const double> shape, std::size_t channel, std::size_t lane,
                      const Interface& interface) {
    const std::size_t begin = band.channels.first[channel], end = band.channels.first[channel + 1];
    double total = 0.0;
    for (std::size_t n = begin; n < end; ++n) total += shape[n];
    const auto add = [&](float* to, double share, const DirectionalOptics& o) {
        to[0] += static_cast<float>(share * o.mirrored);
        to[lanes_] += static_cast<float>(share * o.diffuse);
        to[2 * lanes_] += static_cast<float>(share * o.transmittance);
    };
    const auto optics = [&](std::size_t n, std::size_t k, double here) {
        return directional_optics(material, band.band.node_um[n], cosine_at(k), here,
                                  interface.normal);
    };
    const auto* glossy = std::get_if<Glossy>(&material.finish);
    if (glossy == nullptr || glossy->pane) {
        for (std::size_t k = 0; k < nodes; ++k) {
            float* at = &values_[k * parts * lanes_ + lane];
            if (glossy) {  // a pane's optics are those of the channel's middle, as its index is
                add(at, 1.0, optics((begin + end) / 2, k, 0.0));
                continue;
            }
            for (std::size_t n = begin; n < end; ++n) {
                add(at, shape[n] / total, optics(n, k, 0.0));
            }
        }
        return;
    }
    // Linear in what the interface reflects, whatever the angle: two suffice.
    DirectionalOptics none{}, all{};
    for (std::size_t n = begin; n < end; ++n) {
        for (const bool of_all : {false, true}) {
            const DirectionalOptics o = optics(n, 0, of_all ? 1.0 : 0.0);
            DirectionalOptics& to = of_all ? all : none;
            to.mirrored += shape[n] / total * o.mirrored;
            to.diffuse += shape[n] / total * o.diffuse;
            to.transmittance += shape[n] / total * o.transmittance;
        }
    }
    const auto between = [&](double here) {
        return DirectionalOptics{
            .emissivity = 0.0,
            .mirrored = std::lerp(none.mirrored, all.mirrored, here),
            .diffuse = std::lerp(none.diffuse, all.diffuse, here),
            .transmittance = std::lerp(none.transmittance, all.transmittance, here)};
    };
    for (std::size_t k = 0; k < nodes; ++k) {
        float* at = &values_[k * parts * lanes_ + lane];
        add(at, 1.0, between(interface.at_node[k]));
        at[3 * lanes_] = static_cast<float>(between(interface.smooth[k]).mirrored);
    }
}

/// With cosθ = u², nodes equal in u: ∫ f 4 u³ du.
void AngleTable::average(std::size_t lane) {
    for (std::size_t k = 0; k < nodes; ++k) {
        const double u = root_at(k);
        const double ends = k == 0 || k + 1 == nodes ? 0.5 : 1.0;
        hemisphere_[lane] += static_cast<float>(ends * 4.0 * u * u * u / double(nodes - 1)) *
                             values_[(k * parts + 1) * lanes_ + lane];
    }
}

AngleTable::Place AngleTable::at(double cosine) const {
    const double u = std::sqrt(std::clamp(cosine, 0.0, 1.0)) * double(nodes - 1);
    const std::size_t k = std::min(nodes - 2, static_cast<std::size_t>(u));
    const float* low = &values_[k * parts * lanes_];
    return {low, low + parts * lanes_, static_cast<float>(u - double(k)), lanes_};
}

}  // namespace diurna
