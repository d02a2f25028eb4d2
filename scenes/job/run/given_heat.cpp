#include "scenes/job/run/given_heat.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "materials/base/error.hpp"
#include "scenes/job/store/heat_inputs.hpp"
#include "scenes/job/store/inputs.hpp"
#include "scenes/job/world/movers.hpp"
#include "thermal/temperature_mesh.hpp"
#include "thermal/temperature_names.hpp"

namespace diurna {

namespace {

namespace fs = std::filesystem;

constexpr float moved_by = 0.05f;  // [m] that places of the same facet may be

[[noreturn]] void refuse(const fs::path& file, const std::string& problem) {
    throw InputError(file.string(), "belongs to another scene: " + problem,
                     "diurna solve SCENE --out FILE.nc computes the temperatures of this scene");
}

/// Refuses where a facet has another name than it has in the scene.
template <class There, class Here>
void check_names(const fs::path& file, const char* what, std::size_t facets, const There& there,
                 const Here& here) {
    std::size_t differ = 0;
    std::string first;
    for (std::size_t f = 0; f < facets; ++f) {
        const std::string expected = flag_word(here(f));
        if (there(f) == expected || differ++ > 0) continue;
        first = fmt::format("found {} \"{}\", expected \"{}\"", what, there(f), expected);
    }
    if (differ > 0) refuse(file, fmt::format("{} on {} of {} facets", first, differ, facets));
}

void check_facets(const Prepared& prepared, const fs::path& file, std::size_t found) {
    const FacetSet& now = prepared.world.surfaces();
    if (found != now.size()) {
        refuse(file,
               fmt::format("found temperatures of {} facets, expected {}", found, now.size()));
    }
    const FacetSet placed =
        prepared.movement.none()
            ? now
            : moved(prepared.world, now, prepared.movement.at_stage.front());  // as in write_heat
    const TemperatureMesh mesh = load_temperature_mesh(file);
    std::size_t elsewhere = 0;
    float most = 0.0f;
    for (std::size_t f = 0; f < found; ++f) {
        const float off = (mesh.facets.centroid[f] - placed.centroid[f]).norm();
        elsewhere += off > moved_by;
        most = std::max(most, off);
    }
    if (elsewhere > 0) {
        refuse(file, fmt::format("{} of {} facets have other places, up to {:.3g} m apart",
                                 elsewhere, found, most));
    }
    if (!mesh.materials.empty()) {
        check_names(
            file, "material", found,
            [&](std::size_t f) { return mesh.materials[index(mesh.facets.material[f])]; },
            [&](std::size_t f) { return prepared.scene.materials[now.material[f]].kind(); });
    }
    if (!mesh.objects.empty()) {
        check_names(
            file, "object", found,
            [&](std::size_t f) { return mesh.objects[std::size_t(mesh.facets.object[f])]; },
            [&](std::size_t f) { return prepared.world.objects[std::size_t(now.object[f])]; });
    }
}

}  // namespace

GivenHeat given_heat(const Prepared& prepared, const std::vector<RunInput>& inputs,
                     const fs::path& file) {
    GivenHeat given{.field = load_temperature_field(file)};
    check_facets(prepared, file, given.field.facets);
    const std::vector<std::string> changed =
        changed_since(temperatures_made_of(file), heat_made_of(prepared.scene, inputs));
    const std::vector<fs::path>& weather = prepared.scene.weather.files;
    const auto is_weather = [&](const fs::path& path) {
        return std::any_of(weather.begin(), weather.end(),
                           [&](const fs::path& one) { return one.lexically_normal() == path; });
    };
    for (const RunInput& input : inputs) {
        const bool differs = std::find(changed.begin(), changed.end(), input.name) != changed.end();
        if (differs && is_weather(input.path)) {
            refuse(file, fmt::format("{} has changed since the temperatures were computed",
                                     input.path.string()));
        }
    }
    if (!changed.empty()) {
        given.warnings.push_back(fmt::format(
            "{}: {} {} changed since these temperatures were computed (changes of observers, bands "
            "and labels in a scene file do not matter); diurna solve recomputes them",
            file.string(), fmt::join(changed, ", "), changed.size() == 1 ? "is" : "are"));
    }
    return given;
}

}  // namespace diurna
