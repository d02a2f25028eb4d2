#include "scenes/job/run/stages.hpp"

#include <algorithm>
#include <utility>

#include "scenes/job/run/scene_sky_view.hpp"

namespace diurna {

Stages::Stages(const Prepared& prepared, std::shared_ptr<const StageStore> store)
    : prepared_(prepared), store_(std::move(store)) {
    own_.resize(prepared.movement.none() ? 1 : prepared.movement.stage.size());
}

Stages::Stages(const Prepared& prepared, const Stages& alike) : Stages(prepared, alike.store_) {
    const std::lock_guard lock(alike.making_);
    for (std::size_t i = 0; i < std::min(own_.size(), alike.own_.size()); ++i) {
        own_[i].views = alike.own_[i].views;
    }
}

SceneStage Stages::at(std::size_t stage) const {
    const std::lock_guard lock(making_);
    Own& own = own_[stage];
    if (own.prepared == nullptr && !prepared_.movement.none()) {
        own.prepared =
            std::make_unique<const Prepared>(moved(prepared_, prepared_.movement.at_stage[stage]));
    }
    const Prepared& here = own.prepared ? *own.prepared : prepared_;
    if (own.views == nullptr) {
        own.views = std::make_shared<const FacetViews>(scene_sky_view(here, false, store()));
    }
    return {here, *own.views, store()};
}

SceneStage Stages::at_instant(Instant when) const {
    return at(prepared_.movement.none() ? 0 : prepared_.movement.stage_of(when));
}

}  // namespace diurna
