#include "scenes/job/plan/eye_check.hpp"

#include "scenes/job/world/some_facets.hpp"

namespace diurna {

EyeCheck::Part::Part(const World& world, const std::vector<std::uint32_t>& facet)
    : facets(some_facets(world.facets, facet)), rays(facets) {}

EyeCheck::EyeCheck(const World& world, const RayScene& rays) : world_(world), rays_(rays) {
    if (world.movers.empty()) return;
    std::vector<std::uint32_t> still;
    std::vector<std::vector<std::uint32_t>> going(world.movers.size());
    for (std::uint32_t f = 0; f < world.facets.size(); ++f) {
        std::vector<std::uint32_t>* of = &still;
        for (std::size_t m = 0; m < going.size(); ++m) {
            if (world.facets.object[f] == world.movers[m].id) of = &going[m];
        }
        of->push_back(f);
    }
    still_.emplace_back(world, still);
    for (const auto& facets : going) going_.emplace_back(world, facets);
}

void EyeCheck::check(const Observer& observer, const MoverPoses& poses) const {
    if (still_.empty()) {
        check_observer(observer, world_.facets, rays_, world_.ground_facets, world_.objects);
        return;
    }
    check_observer(observer, still_[0].facets, still_[0].rays, world_.ground_facets,
                   world_.objects);
    for (std::size_t m = 0; m < going_.size(); ++m) {
        Observer from_it = observer;  // as if it were where it begins
        from_it.position = world_.movers[m].start * (poses[m].inverse() * observer.position);
        check_observer(from_it, going_[m].facets, going_[m].rays, 0, world_.objects);
    }
}

}  // namespace diurna
