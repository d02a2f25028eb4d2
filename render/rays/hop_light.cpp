#include "render/rays/hop_light.hpp"

#include <cassert>
#include <memory>
#include <utility>

#include "materials/base/parallel.hpp"
#include "render/rays/hop_planes.hpp"
#include "render/rays/hop_sum.hpp"
#include "render/rays/hop_tables.hpp"
#include "render/rays/rough_mirror.hpp"

namespace diurna {

/// Light of the hops' facets alone.
struct OwnLight {
    LitFacets lit;
    SceneLight light;
    OwnLight(const Hops& hops, std::span<const Band> bands, const RadianceInput& input,
             const HopOptions& options)
        : lit(lit_facets(input, facets_of(hops), bands)),
          light(input, lit, bands, options.bounces, options.tolerance) {}
};

struct HopLight::State {
    std::unique_ptr<OwnLight> own;  // null: that of a whole picture
    HopTables tables;
    RoughMirrors rough{tables};
};

HopLight::HopLight(const Hops& hops, std::span<const Plume> plumes, std::span<const Band> bands,
                   const RadianceInput& input, const HopOptions& options) {
    auto own = std::make_unique<OwnLight>(hops, bands, input, options);
    const SceneLight& light = own->light;
    state_.reset(new State{std::move(own), {hops, plumes, light, 0, options}});
}

HopLight::HopLight(const Hops& hops, std::span<const Plume> plumes, const SceneLight& light,
                   std::size_t first, const HopOptions& options)
    : state_(new State{nullptr, {hops, plumes, light, first, options}}) {}

HopLight::~HopLight() = default;

void HopLight::add(std::span<std::vector<float>> planes) const {
    const HopTables& tables = state_->tables;
    const bool by_term = planes.size() > tables.band.size();
    assert(!by_term || tables.options.by_term);
    for_each_block(tables.hops.pixel.size(), 64, [&](std::size_t begin, std::size_t end) {
        HopSum sum(tables, state_->rough, by_term ? SumOfHops::by_term : SumOfHops::whole);
        for (std::size_t k = begin; k < end; ++k) sum.add(k, planes);
    });
}

void HopLight::add_surfaces(std::size_t surfaces, Frame& frame) const {
    add_hop_planes(state_->tables, state_->rough, surfaces, frame);
}

}  // namespace diurna
