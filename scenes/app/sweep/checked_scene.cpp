#include "scenes/app/sweep/checked_scene.hpp"

#include <utility>

#include "scenes/app/sweep/sweep_plan.hpp"
#include "scenes/app/sweep/variants.hpp"
#include "scenes/job/run/heat.hpp"
#include "scenes/job/warnings/scene_warnings.hpp"
#include "scenes/job/world/targets.hpp"

namespace diurna {

namespace {

void add_warnings(const Prepared& prepared, CheckedScene& checked) {
    for (Mistake& warning : scene_warnings(prepared))
        checked.warnings.push_back(std::move(warning));
}

}  // namespace

CheckedScene check_scene(Scene scene, const std::vector<std::string>& settings, bool allow_outside,
                         const std::function<void(const Prepared&)>& more) {
    CheckedScene checked;
    if (!scene.sweep.axes.empty()) {
        const Sweep sweep = read_sweep_variants(scene.file, settings, allow_outside);
        for_each_value(sweep, [&](Scene variant) {
            const Prepared one = prepare(std::move(variant));
            check_start(one);
            targets(one.world, one.scene);
            add_warnings(one, checked);
        });
        checked.sweep = count_reported(sweep);
    }
    const Prepared prepared = prepare(std::move(scene));
    check_start(prepared);
    const std::vector<NetworkObject> networks = targets(prepared.world, prepared.scene);
    if (more) more(prepared);
    add_warnings(prepared, checked);
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
