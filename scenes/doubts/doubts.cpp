#include "scenes/doubts/doubts.hpp"

#include <algorithm>

namespace diurna {

std::vector<Mistake> doubts(const Prepared& prepared) {
    std::vector<Mistake> all = prepared.warnings;
    for (auto of :
         {place_doubts, shape_doubts, object_doubts, stand_doubts, view_doubts, clock_doubts}) {
        for (Mistake& doubt : of(prepared)) all.push_back(std::move(doubt));
    }
    return all;
}

std::vector<std::string> as_lines(const std::vector<Mistake>& doubts) {
    std::vector<std::string> lines;
    for (const Mistake& doubt : doubts) {
        const std::string line = doubt.line();
        if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
    }
    return lines;
}

}  // namespace diurna
