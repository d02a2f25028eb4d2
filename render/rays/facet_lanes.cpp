#include "render/rays/facet_lanes.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "materials/base/fast_exp.hpp"
#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"

namespace diurna {

namespace {

constexpr std::size_t arriving_rows = 3 * origin_count;
constexpr std::size_t all_rows = arriving_rows + sent_rows.size();

/// Planck's law at the nodes, within 1e-14 of planck(): of many facets, so in vector code.
std::vector<double> glow(const Band& band, double temperature) {
    std::vector<double> radiance(band.node_um.size());
    for (std::size_t n = 0; n < radiance.size(); ++n) {
        const double um = band.node_um[n], square = um * um;
        const double x = std::min(second_radiation_um / (um * temperature), 600.0);
        radiance[n] = first_radiation_um / (square * square * um * (fast_exp(x) - 1.0));
    }
    return radiance;
}

/// What the rows of a facet come to in one band.
class BandRows {
 public:
    /// - i: index of a lit facet
    /// - arriving: from the facets around, in the modes of the band
    BandRows(const SceneLight& light, const BandLight& band, std::size_t i,
             std::span<const float> arriving)
        : band_(band), optics_(band.optics[index(light.lit.material[i])]) {
        const LitFacets& lit = light.lit;
        const Material& material = light.input.materials[lit.material[i]];
        room_behind_ = !optics_.room.empty() && !material.see_through;
        up_ = height_weights(lit.height[i]);
        heat_ = glow(band.band, double{light.state.temperature[i]});
        add_sky(light, i);
        sunlight_ = double{light.state.sunlight[i]};
        Eigen::VectorXd modes(static_cast<Eigen::Index>(arriving.size()));
        for (std::size_t k = 0; k < arriving.size(); ++k) {
            modes[static_cast<Eigen::Index>(k)] = double{arriving[k]};
        }
        arriving_ = band.basis.mode * modes;
    }

    /// In a channel, in the order of FacetLanes.
    std::array<double, all_rows> sum(std::size_t channel) const {
        std::array<double, all_rows> sum{};
        const auto& first = band_.channels.first;
        for (std::size_t k = first[channel]; k < first[channel + 1]; ++k) add_node(k, sum);
        return sum;
    }

 private:
    void add_sky(const SceneLight& light, std::size_t i) {
        const LitFacets& lit = light.lit;
        std::array<float, SkyModes::most> share;
        band_.sky.of(lit.sky_view[i], light.state.uneven[i], light.state.narrow_of(i), up_,
                     share.data());
        const std::vector<double>& weight = band_.band.weight;
        for (std::size_t o = 1; o < origin_count; ++o) {
            sky_[o].assign(weight.size(), 0.0);
            for (std::size_t m = 0; m < band_.sky.size(); ++m) {
                const std::vector<double>& mode = band_.sky.spectrum[m][o];
                if (mode.empty()) continue;
                for (std::size_t k = 0; k < weight.size(); ++k) {
                    sky_[o][k] += weight[k] * double{share[m]} * mode[k];
                }
            }
        }
    }

    void add_node(std::size_t k, std::array<double, all_rows>& sum) const {
        const double w = band_.band.weight[k];
        const double heat = w * heat_[k];
        std::array<double, origin_count> around = band_.basis.by_origin(arriving_, k), sky{};
        for (double& x : around) x *= band_.basis.root_weight[static_cast<Eigen::Index>(k)];
        double of_sun = 0.0;
        for (std::size_t h = 0; sunlight_ > 0.0 && h < 3; ++h) {
            const double up = w * double{up_[h]};
            of_sun += up * sunlight_ * band_.incident[h].from_sun(k);
        }
        for (std::size_t o = 1; o < origin_count; ++o) sky[o] = sky_[o][k];
        sum[0] += heat;
        for (std::size_t o = 0; o < origin_count; ++o) sum[1 + o] += around[o];
        for (std::size_t o = 1; o < origin_count; ++o) sum[origin_count + o] += sky[o];
        for (std::size_t r = 0; r < sent_rows.size(); ++r) {
            const auto [term, origin] = sent_rows[r];
            const auto o = static_cast<std::size_t>(origin);
            const double sent =
                term == Term::emitted ? optics_.emissivity[k] * heat
                : term == Term::behind
                    ? room_behind_ ? w * optics_.room[k] : optics_.transmittance[k] * heat
                    : optics_.reflectance[k] * (term == Term::sun   ? of_sun
                                                : term == Term::sky ? sky[o]
                                                                    : around[o]);
            sum[2 * origin_count + o] += sent;
            sum[arriving_rows + r] += sent;
        }
    }

    const BandLight& band_;
    const NodeOptics& optics_;
    bool room_behind_ = false;
    std::array<float, 3> up_{};
    std::vector<double> heat_;  // (node)
    double sunlight_ = 0.0;
    std::array<std::vector<double>, origin_count> sky_{};  // (origin)(node) weighted
    Eigen::VectorXd arriving_;                             // a sum of modes
};

}  // namespace

FacetLanes::FacetLanes(const SceneLight& light, std::size_t first, std::size_t targets,
                       const ChannelLanes& lanes, bool by_term)
    : lanes_(lanes.size()), rows_of_facet_(by_term ? all_rows : arriving_rows) {
    const RadiosityTables& tables = light.tables;
    rows_.assign(targets * rows_of_facet_ * lanes_, 0.0f);
    for_each_block(targets, 16, [&](std::size_t begin, std::size_t end) {
        std::vector<float> black(tables.lanes), arriving(tables.lanes);
        for (std::size_t t = begin; t < end; ++t) {
            const std::size_t i = light.lit.target[first + t];
            black_modes(tables, light.state.temperature[i], black.data());
            light.radiosity.arriving(i, black.data(), arriving.data());
            for (std::size_t b = 0; b < light.band.size(); ++b) {
                const BandLight& band = light.band[b];
                const BandRows rows(
                    light, band, i,
                    std::span(arriving).subspan(tables.first[b], band.basis.size()));
                for (std::size_t c = 0; c < band.channels.size(); ++c) {
                    const auto sum = rows.sum(c);
                    for (std::size_t r = 0; r < rows_of_facet_; ++r) {
                        rows_[(t * rows_of_facet_ + r) * lanes_ + lanes.first[b] + c] =
                            static_cast<float>(sum[r]);
                    }
                }
            }
        }
    });
}

}  // namespace diurna
