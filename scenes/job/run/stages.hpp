#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "render/view/view.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/store/stage_store.hpp"
#include "terrain/visibility/view_factors.hpp"

namespace diurna {

/// A scene while all its objects are at rest, and its view factors.
struct SceneStage {
    const Prepared& prepared;
    const FacetViews& views;
    const StageStore* store = nullptr;  // cache of earlier results
};

/// The scene stage by stage (scenes/job/world/movers.hpp); one stage without motion. View factors
/// of a stage are computed when first needed. Thread-safe.
class Stages {
 public:
    /// - prepared: must outlive it
    /// - store: cache of earlier results; null: all is recomputed
    explicit Stages(const Prepared& prepared, std::shared_ptr<const StageStore> store = nullptr);
    /// - alike: of a scene with the same surfaces in the same places: view factors are shared
    Stages(const Prepared& prepared, const Stages& alike);
    std::size_t size() const { return own_.size(); }
    SceneStage at(std::size_t stage) const;
    SceneStage at_instant(Instant when) const;
    const Prepared& scene() const { return prepared_; }
    /// Keeps the view of a standing observer, of its samples a pixel, for its pictures in a stage:
    /// it was cast to find what these show. Not where the views kept are large already.
    void keep_view(std::size_t observer, std::size_t stage, View view) const;
    /// Hands it over; nothing: none was kept.
    std::optional<View> take_view(std::size_t observer, std::size_t stage) const;
    const StageStore* store() const { return store_.get(); }
    const std::shared_ptr<const StageStore>& shared_store() const { return store_; }

 private:
    struct Own {
        std::unique_ptr<const Prepared> prepared;  // null: the scene's
        std::shared_ptr<const FacetViews> views;
    };
    const Prepared& prepared_;
    std::shared_ptr<const StageStore> store_;
    mutable std::mutex making_;
    mutable std::vector<Own> own_;
    mutable std::map<std::pair<std::size_t, std::size_t>, View> view_;  // (observer, stage)
};

}  // namespace diurna
