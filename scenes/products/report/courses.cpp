#include "scenes/products/report/courses.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scenes/charts/curves.hpp"
#include "scenes/charts/facet_groups.hpp"
#include "scenes/products/report/group_days.hpp"

namespace diurna {

namespace {

constexpr std::size_t most_objects = 12;  // whose parts are reported

}  // namespace

std::string courses(const Prepared& prepared, const TemperatureField& field) {
    const FacetSet& facets = prepared.world.surfaces();
    const std::vector<DiurnalCurve> materials =
        diurnal_curves(field, facets, material_groups(facets, prepared.scene.materials));
    std::optional<DiurnalCurve> around;
    for (const DiurnalCurve& curve : materials) {
        if (curve.name == prepared.scene.terrain.default_material) around = curve;
    }
    const GroupDays days{prepared, field.instant, around};
    std::string out = "<h2>Temperatures over the day</h2>\n" + between_instants(field.instant);
    out +=
        "<h3>Materials</h3>\n" +
        group_days(days, "Surface temperature by material, mean over area", "material", materials);
    const std::vector<FacetGroup> objects = object_groups(prepared);
    if (objects.size() > 1) {
        out += "<h3>Ground, buildings and objects</h3>\n";
        if (const std::size_t copies = prepared.world.copies.size(); copies > 0) {
            out += fmt::format(
                "<p class=\"key\">{} copies share the temperatures of their representatives.</p>\n",
                copies);
        }
        out += group_days(days, "Surface temperature by object, mean over area", "object",
                          diurnal_curves(field, facets, objects));
    }
    const std::vector<ObjectParts> parts = part_groups(prepared);
    for (std::size_t i = 0; i < std::min(parts.size(), most_objects); ++i) {
        out += i == 0 ? "<h3>Parts of objects</h3>\n" : "";
        out += group_days(days, parts[i].object + ": its parts, mean over area", "part",
                          diurnal_curves(field, facets, parts[i].part));
    }
    if (parts.size() > most_objects) {
        out += fmt::format("<p class=\"key\">The first {} of {} objects with several parts.</p>\n",
                           most_objects, parts.size());
    }
    return out;
}

}  // namespace diurna
