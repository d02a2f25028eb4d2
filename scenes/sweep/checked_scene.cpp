#include "scenes/sweep/checked_scene.hpp"

#include <utility>

#include "scenes/doubts/doubts.hpp"
#include "scenes/plan/prepared.hpp"
#include "scenes/run/heat.hpp"
#include "scenes/sweep/sweep_plan.hpp"
#include "scenes/sweep/variants.hpp"
#include "scenes/world/targets.hpp"

namespace diurna {

namespace {

void add_doubts(const Prepared& prepared, CheckedScene& checked) {
    for (Mistake& doubt : doubts(prepared)) checked.doubts.push_back(std::move(doubt));
}

}  // namespace

CheckedScene check_scene(Scene scene, const std::vector<std::string>& settings,
                         bool allow_outside) {
    CheckedScene checked;
    if (!scene.sweep.axes.empty()) {
        const Sweep sweep = read_sweep_variants(scene.file, settings, allow_outside);
        for_each_value(sweep, [&](Scene variant) {
            const Prepared one = prepare(std::move(variant));
            check_start(one);
            targets(one.world, one.scene);
            add_doubts(one, checked);
        });
        checked.sweep = count_told(sweep);
    }
    const Prepared prepared = prepare(std::move(scene));
    check_start(prepared);
    const std::vector<NetworkObject> networks = targets(prepared.world, prepared.scene);
    add_doubts(prepared, checked);
    checked.facets = prepared.world.surfaces().size();
    checked.observers = prepared.sequences.size();
    checked.memory = prepared.plan.memory;
    checked.notes = prepared.notes;
    for (const NetworkObject& network : networks) {
        checked.notes.insert(checked.notes.end(), network.notes.begin(), network.notes.end());
    }
    return checked;
}

}  // namespace diurna
