#include "scenes/studies/study_request.hpp"

#include <fmt/format.h>

#include "scenes/job/input/scene_file.hpp"

namespace diurna {

Scene StudyRequest::read_with(const std::vector<std::string>& more) const {
    return read_scene(scene, joined(settings, more), allow_outside);
}

SceneWith StudyRequest::scene_with() const {
    return [this](const std::vector<std::string>& more) { return read_with(more); };
}

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
    check_study_files(request.out, files, scene.files);
}

void write_findings(const StudyRequest& request, const StudyFindings& findings) {
    if (request.out.empty()) return;
    for (const StudyFinding& one : findings.finding) {
        write_study_files(request.out, one.name, one.texts);
    }
}

std::vector<std::string> joined(std::vector<std::string> notes,
                                const std::vector<std::string>& more) {
    notes.insert(notes.end(), more.begin(), more.end());
    return notes;
}

}  // namespace diurna
