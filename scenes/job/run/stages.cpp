#include "scenes/job/run/stages.hpp"

#include <algorithm>
#include <utility>

#include "scenes/job/run/scene_sky_view.hpp"

namespace diurna {

namespace {

std::size_t bytes_of(const View& view) {
    const auto bytes = [](const auto& values) { return values.size() * sizeof(values[0]); };
    return bytes(view.surface) + bytes(view.range) + bytes(view.range_root) +
           bytes(view.target_height) + bytes(view.row) + bytes(view.sighting) + bytes(view.sky) +
           bytes(view.sky_zenith_deg) + bytes(view.sky_azimuth_deg) + bytes(view.centre) +
           bytes(view.centre_range) + bytes(view.centre_blend) + bytes(view.copy) +
           bytes(view.centre_copy);
}

}  // namespace

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

void Stages::keep_view(std::size_t observer, std::size_t stage, View view) const {
    constexpr std::size_t most_bytes = std::size_t{1} << 27;
    const std::lock_guard lock(making_);
    std::size_t bytes = bytes_of(view);
    for (const auto& [of, kept] : view_) bytes += bytes_of(kept);
    if (bytes <= most_bytes) view_.insert_or_assign({observer, stage}, std::move(view));
}

std::optional<View> Stages::take_view(std::size_t observer, std::size_t stage) const {
    const std::lock_guard lock(making_);
    const auto found = view_.find({observer, stage});
    if (found == view_.end()) return std::nullopt;
    std::optional<View> view = std::move(found->second);
    view_.erase(found);
    return view;
}

SceneStage Stages::at_instant(Instant when) const {
    return at(prepared_.movement.none() ? 0 : prepared_.movement.stage_of(when));
}

}  // namespace diurna
