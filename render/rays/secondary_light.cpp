#include "render/rays/secondary_light.hpp"

#include <cassert>
#include <memory>
#include <utility>

#include "materials/base/parallel.hpp"
#include "render/rays/rough_mirror.hpp"
#include "render/rays/secondary_planes.hpp"
#include "render/rays/secondary_sum.hpp"
#include "render/rays/secondary_tables.hpp"

namespace diurna {

/// Light of the secondary rays' facets alone.
struct OwnLight {
    LitFacets lit;
    SceneLight light;
    OwnLight(const SecondaryRays& secondary_rays, std::span<const Band> bands,
             const RadianceInput& input, const SecondaryOptions& options)
        : lit(lit_facets(input, surfaces_of(secondary_rays), bands)),
          light(input, lit, bands, options.bounces, options.tolerance) {}
};

struct SecondaryLight::State {
    std::unique_ptr<OwnLight> own;  // null: that of a whole picture
    SecondaryTables tables;
    RoughMirrors rough{tables};
};

SecondaryLight::SecondaryLight(const SecondaryRays& secondary_rays, std::span<const Plume> plumes,
                               std::span<const Band> bands, const RadianceInput& input,
                               const SecondaryOptions& options) {
    auto own = std::make_unique<OwnLight>(secondary_rays, bands, input, options);
    const SceneLight& light = own->light;
    state_.reset(new State{std::move(own), {secondary_rays, plumes, light, 0, options}});
}

SecondaryLight::SecondaryLight(const SecondaryRays& secondary_rays, std::span<const Plume> plumes,
                               const SceneLight& light, std::size_t first,
                               const SecondaryOptions& options)
    : state_(new State{nullptr, {secondary_rays, plumes, light, first, options}}) {}

SecondaryLight::~SecondaryLight() = default;

void SecondaryLight::add(std::span<std::vector<float>> planes) const {
    const SecondaryTables& tables = state_->tables;
    const bool by_term = planes.size() > tables.band.size();
    assert(!by_term || tables.options.by_term);
    for_each_block(tables.secondary_rays.pixel.size(), 64, [&](std::size_t begin, std::size_t end) {
        SecondarySum sum(tables, state_->rough,
                         by_term ? SumOfSecondaryRays::by_term : SumOfSecondaryRays::whole);
        for (std::size_t k = begin; k < end; ++k) sum.add(k, planes);
    });
}

void SecondaryLight::add_surfaces(std::size_t surfaces, Frame& frame) const {
    add_secondary_planes(state_->tables, state_->rough, surfaces, frame);
}

}  // namespace diurna
