#include "scenes/job/plan/memory_limit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

#include "materials/base/error.hpp"

namespace diurna {

namespace {

/// The number of a file that holds one; < 0: none.
double number_in(const char* file) {
    std::ifstream stream(file);
    double number = -1.0;
    return stream >> number ? number : -1.0;
}

/// Of /proc/meminfo, in kB there [bytes]; < 0: none.
double available() {
    std::ifstream stream("/proc/meminfo");
    std::string line;
    while (std::getline(stream, line)) {
        std::istringstream words(line);
        std::string name;
        double kilobytes = 0.0;
        if (words >> name >> kilobytes && name == "MemAvailable:") return 1024.0 * kilobytes;
    }
    return -1.0;
}

}  // namespace

double bytes_reported(const std::string& text) {
    double number = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const std::string unit(end, text.data() + text.size());
    const double scale = unit == "M" ? 1e6 : unit == "G" ? 1e9 : unit == "T" ? 1e12 : 0.0;
    if (error != std::errc{} || scale == 0.0 || !(number * scale >= 1e6) || number > 1e6) {
        throw InputError("--max-memory",
                         fmt::format("found '{}', expected a number with M, G or T: 6.5G", text));
    }
    return number * scale;
}

std::string memory_in_words(double bytes) {
    return bytes < 1e9 ? fmt::format("{:.0f} MB", bytes / 1e6)
                       : fmt::format("{:.1f} GB", bytes / 1e9);
}

double free_memory() {
    double free = available();
    if (free < 0.0) return 0.0;
    const double most = number_in("/sys/fs/cgroup/memory.max");  // "max": no number
    const double used = number_in("/sys/fs/cgroup/memory.current");
    if (most >= 0.0 && used >= 0.0) free = std::min(free, std::max(0.0, most - used));
    return 0.9 * free;
}

void check_memory(const Plan& plan, double limit) {
    const bool asked = limit > 0.0;
    const double most = asked ? limit : free_memory();
    if (most == 0.0 || plan.memory <= most) return;
    throw InputError(
        asked ? "--max-memory" : "memory",
        fmt::format(
            "the plan needs {} ({} facets, {} steps, {:.3g} pixels), but {} {}",
            memory_in_words(plan.memory), plan.facets, plan.steps.size() - 1, double(plan.pixels),
            asked ? "--max-memory permits" : "90 % of the free memory is", memory_in_words(most)),
        "use a coarser ground (terrain.tolerance_m, largest_edge_m), smaller pictures or a longer "
        "time.step_s, or raise --max-memory");
}

}  // namespace diurna
