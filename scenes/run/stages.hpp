#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

#include "scenes/cache/stage_store.hpp"
#include "scenes/plan/prepared.hpp"
#include "terrain/visibility/view_factors.hpp"

namespace diurna {

/// A scene while all its objects rest, and what its facets see.
struct SceneStage {
    const Prepared& prepared;
    const FacetViews& views;
    const StageStore* store = nullptr;  // of what earlier runs have found
};

/// The scene stage by stage (scenes/world/movers.hpp); one where nothing goes. What a stage sees is
/// worked out when it is first asked for. Safe to use from many threads.
class Stages {
 public:
    /// - prepared: to outlive it
    /// - store: what earlier runs have found is taken from there; null: all is recomputed
    explicit Stages(const Prepared& prepared, std::shared_ptr<const StageStore> store = nullptr);
    /// - alike: of a scene with the same surfaces in the same places: what they see is shared
    Stages(const Prepared& prepared, const Stages& alike);
    std::size_t size() const { return own_.size(); }
    SceneStage at(std::size_t stage) const;
    const Prepared& scene() const { return prepared_; }
    const StageStore* store() const { return store_.get(); }

 private:
    struct Own {
        std::unique_ptr<const Prepared> prepared;  // null: the scene's
        std::shared_ptr<const FacetViews> views;
    };
    const Prepared& prepared_;
    std::shared_ptr<const StageStore> store_;
    mutable std::mutex making_;
    mutable std::vector<Own> own_;
};

}  // namespace diurna
