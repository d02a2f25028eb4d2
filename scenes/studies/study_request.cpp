#include "scenes/studies/study_request.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "scenes/job/store/digest.hpp"
#include "scenes/job/store/inputs.hpp"

namespace diurna {

SceneWith StudyRequest::scene_with() const { return reads_scene(scene, settings, allow_outside); }

void check_asked(const StudyRequest& request, const Scene& scene, const char* kind,
                 const std::vector<std::string>& names, const char* more) {
    if (names.empty()) {
        throw InputError(scene.file.string(),
                         fmt::format("no table [[{}]], expected at least one", kind));
    }
    if (request.out.empty()) return;
    std::vector<std::string> files = names;
    if (more != nullptr) {
        for (const std::string& name : names) files.push_back(name + more);
    }
    check_study_files(request.out, files, merged(scene.files, named_inputs(scene)));
}

void finish_findings(const StudyRequest& request, StudyFindings& findings) {
    using OrderedJson = nlohmann::ordered_json;
    const OrderedJson made_from{{"scene", request.scene.filename().string()},
                                {"settings", request.settings},
                                {"heat_sha256", sha256(request.read().said_but_for_pictures)}};
    for (StudyFinding& one : findings.finding) {
        OrderedJson json = OrderedJson::parse(one.texts.json);
        json["made_from"] = made_from;
        one.texts.json = json.dump(1, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
        if (!request.out.empty()) write_study_files(request.out, one.name, one.texts);
    }
}

std::vector<std::string> joined(std::vector<std::string> notes,
                                const std::vector<std::string>& more) {
    notes.insert(notes.end(), more.begin(), more.end());
    return notes;
}

}  // namespace diurna
