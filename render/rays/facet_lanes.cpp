#include "render/rays/facet_lanes.hpp"

#include <array>
#include <span>

#include "materials/base/parallel.hpp"
#include "materials/radiation/planck.hpp"

namespace diurna {

namespace {

/// What the parts of a facet come to in one band.
class BandParts {
 public:
    /// - i: index of a lit facet
    /// - arriving: from the facets around, in the modes of the band
    BandParts(const SceneLight& light, const BandLight& band, std::size_t i,
              std::span<const float> arriving)
        : band_(band), optics_(band.optics[index(light.lit.material[i])]) {
        const LitFacets& lit = light.lit;
        const Material& material = light.input.materials[lit.material[i]];
        room_behind_ = !optics_.room.empty() && !material.see_through;
        up_ = height_weights(lit.height[i]);
        temperature_ = light.state.temperature[i];
        open_ = double{lit.sky_view[i]};
        sunlight_ = double{light.state.sunlight[i]};
        Eigen::VectorXd modes(static_cast<Eigen::Index>(arriving.size()));
        for (std::size_t k = 0; k < arriving.size(); ++k) {
            modes[static_cast<Eigen::Index>(k)] = double{arriving[k]};
        }
        arriving_ = band.basis.mode * modes;
    }

    /// In a channel.
    std::array<double, facet_parts> sum(std::size_t channel) const {
        std::array<double, facet_parts> sum{};
        const auto part = [&](FacetPart p) -> double& { return sum[static_cast<std::size_t>(p)]; };
        const auto& first = band_.channels.first;
        for (std::size_t k = first[channel]; k < first[channel + 1]; ++k) {
            const auto at = static_cast<Eigen::Index>(k);
            const double w = band_.band.weight[k];
            const double heat = w * planck(band_.band.node_um[k], temperature_);
            const double near = band_.basis.root_weight[at] * arriving_[at];
            double of_sky = 0.0, of_sun = 0.0;
            for (std::size_t h = 0; h < 3; ++h) {
                of_sky += w * open_ * double{up_[h]} * band_.incident[h].sky[k];
                of_sun += w * sunlight_ * double{up_[h]} * band_.incident[h].sun[k];
            }
            part(FacetPart::black) += heat;
            part(FacetPart::arriving_sky) += of_sky;
            part(FacetPart::arriving_surroundings) += near;
            part(FacetPart::emitted) += optics_.emissivity[k] * heat;
            part(FacetPart::sun) += optics_.reflectance[k] * of_sun;
            part(FacetPart::sky) += optics_.reflectance[k] * of_sky;
            part(FacetPart::surroundings) += optics_.reflectance[k] * near;
            part(FacetPart::behind) +=
                room_behind_ ? w * optics_.room[k] : optics_.transmittance[k] * heat;
        }
        part(FacetPart::radiosity) = part(FacetPart::emitted) + part(FacetPart::sun) +
                                     part(FacetPart::sky) + part(FacetPart::surroundings) +
                                     part(FacetPart::behind);
        return sum;
    }

 private:
    const BandLight& band_;
    const NodeOptics& optics_;
    bool room_behind_ = false;
    std::array<float, 3> up_{};
    float temperature_ = 0.0f;
    double open_ = 0.0, sunlight_ = 0.0;
    Eigen::VectorXd arriving_;  // (node) √weight × radiance
};

}  // namespace

FacetLanes::FacetLanes(const SceneLight& light, const ChannelLanes& lanes) : lanes_(lanes.size()) {
    const RadiosityTables& tables = light.tables;
    const std::size_t targets = light.lit.target.size();
    parts_.assign(targets * facet_parts * lanes_, 0.0f);
    for_each_block(targets, 16, [&](std::size_t begin, std::size_t end) {
        std::vector<float> black(tables.lanes), arriving(tables.lanes);
        for (std::size_t t = begin; t < end; ++t) {
            const std::size_t i = light.lit.target[t];
            black_modes(tables, light.state.temperature[i], black.data());
            light.radiosity.arriving(i, black.data(), arriving.data());
            for (std::size_t b = 0; b < light.band.size(); ++b) {
                const BandLight& band = light.band[b];
                const BandParts parts(
                    light, band, i,
                    std::span(arriving).subspan(tables.first[b], band.basis.size()));
                for (std::size_t c = 0; c < band.channels.size(); ++c) {
                    const auto sum = parts.sum(c);
                    for (std::size_t p = 0; p < facet_parts; ++p) {
                        parts_[(t * facet_parts + p) * lanes_ + lanes.first[b] + c] =
                            static_cast<float>(sum[p]);
                    }
                }
            }
        }
    });
}

}  // namespace diurna
