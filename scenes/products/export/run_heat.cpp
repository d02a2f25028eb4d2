#include "scenes/products/export/run_heat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "materials/base/error.hpp"
#include "scenes/job/plan/sweep_folder.hpp"

namespace diurna {

namespace {

/// One group for each name that has facets; of names that stand there twice one.
void add_groups(const std::string& kind, const std::vector<std::string>& names,
                const std::vector<std::size_t>& number, std::vector<NamedGroup>& all) {
    if (names.empty()) return;
    std::vector<std::size_t> place(names.size());
    std::vector<NamedGroup> found;
    for (std::size_t n = 0; n < names.size(); ++n) {
        const auto same = std::find(names.begin(), names.end(), names[n]);
        const auto first = static_cast<std::size_t>(same - names.begin());
        place[n] = first == n ? found.size() : place[first];
        if (first == n) found.push_back({kind, {names[n], {}}});
    }
    for (std::size_t f = 0; f < number.size(); ++f) {
        found[place[number[f]]].group.facet.push_back(static_cast<std::uint32_t>(f));
    }
    for (NamedGroup& one : found) {
        if (!one.group.facet.empty()) all.push_back(std::move(one));
    }
}

}  // namespace

RunHeat load_run_heat(const std::filesystem::path& folder) {
    if (!std::filesystem::is_directory(folder)) throw InputError(folder.string(), "no such folder");
    const std::filesystem::path file = folder / "temperatures.nc";
    if (!std::filesystem::is_regular_file(file)) {
        throw InputError(folder.string(), "has no temperatures.nc, expected the folder of a run",
                         heat_hint(folder));
    }
    RunHeat heat{file, load_temperature_field(file), load_temperature_mesh(file)};
    if (heat.field.facets != heat.mesh.facets.size()) {
        throw InputError(file.string(), "has different numbers of temperatures and facets");
    }
    return heat;
}

std::string represented_note(const RunHeat& heat) {
    const TemperatureField& field = heat.field;
    if (field.solved_as.empty()) return "";
    std::size_t count = 0;
    double own = 0.0, all = 0.0;
    for (std::size_t f = 0; f < field.facets; ++f) {
        const double area = heat.mesh.facets.area[f];
        all += area;
        if (field.solved_as[f] == f) continue;
        ++count;
        own += area;
    }
    return fmt::format(
        "{} of {} facets, {:.3g} % of the area, have a representative's temperature{}; "
        "exact = true in the scene solves all facets",
        count, field.facets, all > 0.0 ? 100.0 * own / all : 0.0,
        field.representative_rms > 0.0
            ? fmt::format(", which differs from their own by {:.2g} K rms",
                          field.representative_rms)
            : "");
}

HeatAt heat_at(const RunHeat& heat, Instant when) { return {when, heat.field.interpolate(when)}; }

std::vector<Instant> asked_instants(const RunHeat& heat, std::span<const std::string> texts) {
    const std::vector<Instant>& kept = heat.field.instant;
    std::vector<Instant> all;
    for (const std::string& text : texts) {
        const Instant when = parse_instant(text, "--at");
        if (when < kept.front() || when > kept.back()) {
            throw InputError(
                "--at", fmt::format("found {}, but {} has {} to {}", text, heat.file.string(),
                                    format_instant(kept.front()), format_instant(kept.back())));
        }
        all.push_back(when);
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

std::vector<Instant> every_hour(const RunHeat& heat) {
    std::vector<Instant> all;
    for (Instant when = heat.field.instant.front(); when <= heat.field.instant.back();
         when = later(when, 3600.0)) {
        all.push_back(when);
    }
    return all;
}

std::vector<NamedGroup> all_groups(const TemperatureMesh& mesh) {
    std::vector<std::size_t> material, object;
    for (const MaterialId m : mesh.facets.material) material.push_back(index(m));
    for (const ObjectId o : mesh.facets.object) object.push_back(static_cast<std::size_t>(o));
    std::vector<NamedGroup> all;
    add_groups("material", mesh.materials, material, all);
    add_groups("object", mesh.objects, object, all);
    return all;
}

std::vector<NamedGroup> named_groups(const RunHeat& heat, std::span<const std::string> asked) {
    std::vector<NamedGroup> all = all_groups(heat.mesh);
    if (all.empty()) throw InputError(heat.file.string(), "has no names of materials and objects");
    if (asked.empty()) return all;
    std::vector<std::string> known;
    for (const NamedGroup& one : all) known.push_back(one.kind + ":" + one.group.name);
    std::vector<NamedGroup> some;
    for (const std::string& name : asked) {
        const auto found = std::find(known.begin(), known.end(), name);
        if (found == known.end()) refuse_word("--of", name, known);
        some.push_back(all[static_cast<std::size_t>(found - known.begin())]);
    }
    return some;
}

}  // namespace diurna
