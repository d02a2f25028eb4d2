#include "materials/air/sounding_levels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace diurna {

namespace {

struct Level {
    double height, pressure;
};

/// The longest run of levels, not all neighbours, that rises in height and falls in pressure.
std::vector<std::size_t> longest_ascent(const std::vector<Level>& levels) {
    constexpr auto none = static_cast<std::size_t>(-1);
    std::vector<std::size_t> length(levels.size(), 1), before(levels.size(), none);
    std::size_t last = 0;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        for (std::size_t k = i; k-- > 0;) {  // of runs as long, the one of nearest levels
            const bool follows =
                levels[k].height < levels[i].height && levels[k].pressure > levels[i].pressure;
            if (!follows || length[k] + 1 <= length[i]) continue;
            length[i] = length[k] + 1;
            before[i] = k;
            if (length[k] == k + 1) break;  // no longer one is possible
        }
        if (length[i] > length[last]) last = i;
    }
    std::vector<std::size_t> run;
    for (std::size_t i = last; i != none; i = before[i]) run.push_back(i);
    std::reverse(run.begin(), run.end());
    return run;
}

}  // namespace

std::string leave_out_bounces(CsvTable& table, std::size_t height, std::size_t pressure,
                              double most) {
    constexpr std::size_t always_allowed = 3;
    std::vector<Level> levels;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        double z = 0.0, p = 0.0;
        if (!parse_number(table.rows[row][height], z) ||
            !parse_number(table.rows[row][pressure], p)) {
            return "";
        }
        levels.push_back({z, p});
    }
    const std::vector<std::size_t> run = longest_ascent(levels);
    const std::size_t left_out = levels.size() - run.size();
    if (left_out == 0 ||
        left_out > std::max(always_allowed, std::size_t(most * double(levels.size()))) ||
        run.size() < 2) {
        return "";
    }
    std::size_t first = 0;
    while (first < run.size() && run[first] == first) ++first;
    std::string note = fmt::format(
        "{}: {} of {} levels are skipped because pressure does not decrease or height does not "
        "increase (the first: line {})",
        table.path.string(), left_out, levels.size(),
        table.line[std::min(first, table.line.size() - 1)]);
    CsvTable kept = table;
    kept.rows.clear();
    kept.line.clear();
    for (const std::size_t row : run) {
        kept.rows.push_back(table.rows[row]);
        kept.line.push_back(table.line[row]);
    }
    table = std::move(kept);
    return note;
}

}  // namespace diurna
