#include "scenes/run/stages.hpp"

#include "scenes/run/scene_sky_view.hpp"

namespace diurna {

Stages::Stages(const Prepared& prepared) : prepared_(prepared) {
    own_.resize(prepared.movement.none() ? 1 : prepared.movement.stage.size());
}

SceneStage Stages::at(std::size_t stage) const {
    const std::lock_guard lock(making_);
    Own& own = own_[stage];
    if (own.views == nullptr) {
        if (!prepared_.movement.none()) {
            own.prepared = std::make_unique<const Prepared>(
                moved(prepared_, prepared_.movement.at_stage[stage]));
        }
        const Prepared& here = own.prepared ? *own.prepared : prepared_;
        own.views = std::make_unique<const FacetViews>(scene_sky_view(here));
    }
    return {own.prepared ? *own.prepared : prepared_, *own.views};
}

}  // namespace diurna
