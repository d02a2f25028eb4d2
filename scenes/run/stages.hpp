#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

#include "scenes/plan/prepared.hpp"
#include "terrain/visibility/view_factors.hpp"

namespace diurna {

/// A scene while all its objects rest, and what its facets see.
struct SceneStage {
    const Prepared& prepared;
    const FacetViews& views;
};

/// The scene stage by stage (scenes/world/movers.hpp); one where nothing goes. What a stage sees is
/// worked out when it is first asked for. Safe to use from many threads.
class Stages {
 public:
    /// - prepared: to outlive it
    explicit Stages(const Prepared& prepared);
    /// - alike: of a scene with the same surfaces in the same places: what they see is shared
    Stages(const Prepared& prepared, const Stages& alike);
    std::size_t size() const { return own_.size(); }
    SceneStage at(std::size_t stage) const;
    const Prepared& scene() const { return prepared_; }

 private:
    struct Own {
        std::unique_ptr<const Prepared> prepared;  // null: the scene's
        std::shared_ptr<const FacetViews> views;
    };
    const Prepared& prepared_;
    mutable std::mutex making_;
    mutable std::vector<Own> own_;
};

}  // namespace diurna
