#include "scenes/job/plan/stage_id.hpp"

namespace diurna {

std::string name_of(StageId stage) {
    switch (stage) {
        case StageId::terrain:
            return "terrain";
        case StageId::sky_view:
            return "sky view";
        case StageId::shadows:
            return "shadows";
        case StageId::heat_balance:
            return "heat balance";
        case StageId::surface_check:
            return "surface check";
        case StageId::write_temperatures:
            return "write temperatures";
        case StageId::views:
            return "views";
        case StageId::frames:
            return "frames";
        case StageId::instruments:
            return "instruments";
        case StageId::labels:
            return "labels";
        case StageId::report:
            return "report";
        case StageId::named:
            return "part";
    }
    return "";
}

std::string name_of(StageId stage, const std::string& what) {
    if (stage == StageId::named) return what;
    if (what.empty()) return name_of(stage);
    return (stage == StageId::views ? "cast view" : name_of(stage)) + " of " + what;
}

}  // namespace diurna
