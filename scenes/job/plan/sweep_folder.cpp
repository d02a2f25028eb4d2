#include "scenes/job/plan/sweep_folder.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

namespace diurna {

namespace fs = std::filesystem;

namespace {

/// The first folder in `folder`/`group`, by name, that holds `record`; "" without any.
fs::path first_with(const fs::path& folder, const char* group, const char* record) {
    fs::path first;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder / group, none)) {
        if (!fs::is_regular_file(entry.path() / record, none)) continue;
        if (first.empty() || entry.path() < first) first = entry.path();
    }
    return first;
}

/// Without the separator at the end, so that its parent is the folder around it.
fs::path trimmed(const fs::path& folder) {
    const fs::path whole = fs::absolute(folder).lexically_normal();
    return whole.has_filename() ? whole : whole.parent_path();
}

/// The heat balance of a variant by its record (scenes/app/sweep/records.hpp); "" where it has
/// none.
std::string recorded_heat(const fs::path& variant) {
    std::ifstream file(variant / "variant.json");
    const std::string text(std::istreambuf_iterator<char>(file), {});
    const std::size_t key = text.find("\"heat\"");
    const std::size_t begin = key == text.npos ? key : text.find('"', key + 6);
    const std::size_t end = begin == text.npos ? begin : text.find('"', begin + 1);
    return end == text.npos ? "" : text.substr(begin + 1, end - begin - 1);
}

}  // namespace

std::string variant_hint(const fs::path& folder) {
    const fs::path variant = first_with(folder, "variants", "variant.json");
    if (variant.empty()) return "";
    return fmt::format("it is the folder of a sweep: name a variant's folder, such as {}",
                       variant.string());
}

std::string heat_hint(const fs::path& folder) {
    std::error_code none;
    const bool variant = fs::is_regular_file(folder / "variant.json", none);
    const fs::path heat = variant ? sweep_around(folder) / "heat" / recorded_heat(folder)
                                  : first_with(folder, "heat", "temperatures.nc");
    if (heat.empty()) return "";
    return variant ? fmt::format("it is a variant of a sweep, whose temperatures are in {}",
                                 heat.string())
                   : fmt::format(
                         "it is the folder of a sweep: name a folder of temperatures, such "
                         "as {}",
                         heat.string());
}

fs::path sweep_around(const fs::path& folder) {
    std::error_code none;
    const fs::path inner = trimmed(folder);
    const std::string group = inner.parent_path().filename().string();
    const bool variant = group == "variants" && fs::is_regular_file(inner / "variant.json", none);
    const bool heat = group == "heat" && fs::is_regular_file(inner / "done.json", none);
    if (!variant && !heat) return {};
    const fs::path named = folder.lexically_normal();
    const fs::path around = (named.has_filename() ? named : named.parent_path()) / ".." / "..";
    const fs::path sweep = around.lexically_normal();
    return sweep.has_filename() || sweep == "." ? sweep : sweep.parent_path();
}

bool is_sweep_folder(const fs::path& folder) {
    return !first_with(folder, "variants", "variant.json").empty() ||
           !first_with(folder, "heat", "done.json").empty() ||
           !first_with(folder, "heat", "temperatures.nc").empty();
}

}  // namespace diurna
