#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scenes/report/facet_groups.hpp"
#include "thermal/temperature_field.hpp"
#include "thermal/temperature_mesh.hpp"

namespace diurna {

/// The temperatures of a run's folder and the triangles they are of.
struct RunHeat {
    std::filesystem::path file;  // temperatures.nc
    TemperatureField field;
    TemperatureMesh mesh;
};

/// Reads `temperatures.nc` of a run's folder. Throws InputError where it is none or has none.
RunHeat load_run_heat(const std::filesystem::path& folder);

/// Instants, and the temperature of every facet at each of them.
struct HeatAt {
    Instant when;
    std::vector<float> kelvin;  // (facet)
};
HeatAt heat_at(const RunHeat& heat, Instant when);

/// Instants asked for ("2026-07-15T16:00:00Z", "...-04:00"), ascending, once each; between kept
/// ones temperatures are on the straight line. Throws InputError for one beyond the kept ones.
std::vector<Instant> asked_instants(const RunHeat& heat, std::span<const std::string> texts);
/// From the first kept one on every hour.
std::vector<Instant> every_hour(const RunHeat& heat);

/// Facets of one material or object.
struct NamedGroup {
    std::string kind;  // "material", "object"
    FacetGroup group;
};

/// All that have facets, materials first, in the order of the file; of those that share a name,
/// such as both sides of a sheet, one. None where the file names none.
std::vector<NamedGroup> all_groups(const TemperatureMesh& mesh);

/// Those asked for ("material:grass", "object:hangar"); of none all. Names are those of the file.
/// Throws InputError with the nearest name for one that has no facet.
std::vector<NamedGroup> named_groups(const RunHeat& heat, std::span<const std::string> asked);

}  // namespace diurna
