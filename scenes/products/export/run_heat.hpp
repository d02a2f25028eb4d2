#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scenes/charts/facet_groups.hpp"
#include "thermal/temperature_field.hpp"
#include "thermal/temperature_mesh.hpp"

namespace diurna {

/// The temperatures of a run's folder and their triangles.
struct RunHeat {
    std::filesystem::path file;  // temperatures.nc
    TemperatureField field;
    TemperatureMesh mesh;
};

/// Reads `temperatures.nc` of a run's folder. Throws InputError without such a
/// file.
RunHeat load_run_heat(const std::filesystem::path& folder);

/// Which part of the facets has a representative's temperature, and how far that is from their own,
/// in one line; "" if all facets were solved.
std::string represented_note(const RunHeat& heat);

/// Instants, and the temperature of every facet at each of them.
struct HeatAt {
    Instant when;
    std::vector<float> kelvin;  // (facet)
};
HeatAt heat_at(const RunHeat& heat, Instant when);

/// The requested instants ("2026-07-15T16:00:00Z", "...-04:00"), ascending, without
/// duplicates; linear between stored instants. Throws InputError for one outside the stored
/// span.
std::vector<Instant> asked_instants(const RunHeat& heat, std::span<const std::string> texts);
/// Every hour from the first stored instant.
std::vector<Instant> every_hour(const RunHeat& heat);

/// Facets of one material or object.
struct NamedGroup {
    std::string kind;  // "material", "object"
    FacetGroup group;
};

/// All that have facets, materials first, in the order of the file; groups with the same name, such
/// as both sides of a sheet, are merged. None if the file names none.
std::vector<NamedGroup> all_groups(const TemperatureMesh& mesh);

/// The requested ones ("material:grass", "object:hangar"); all if none is requested. Names are
/// those of the file. Throws InputError with the nearest name for one that has no facet.
std::vector<NamedGroup> named_groups(const RunHeat& heat, std::span<const std::string> asked);

}  // namespace diurna
