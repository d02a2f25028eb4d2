#include "scenes/job/warnings/scene_warnings.hpp"

#include <algorithm>

namespace diurna {

std::vector<Mistake> scene_warnings(const Prepared& prepared) {
    std::vector<Mistake> all = prepared.warnings;
    for (auto of : {place_warnings, shape_warnings, land_cover_warnings, object_warnings,
                    stand_warnings, view_warnings, clock_warnings, light_warnings, step_warnings}) {
        for (Mistake& warning : of(prepared)) all.push_back(std::move(warning));
    }
    return all;
}

std::vector<std::string> as_lines(const std::vector<Mistake>& warnings) {
    std::vector<std::string> lines;
    for (const Mistake& warning : warnings) {
        const std::string line = warning.line();
        if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
    }
    return lines;
}

}  // namespace diurna
