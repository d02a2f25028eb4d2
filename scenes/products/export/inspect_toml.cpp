#include <fmt/format.h>

#include "materials/base/document.hpp"
#include "materials/base/error.hpp"
#include "scenes/products/export/inspect.hpp"

namespace diurna {

Found inspect_toml(const std::filesystem::path& file) {
    const Document document = Document::from_file(file);
    const Section root = document.root();
    const auto of = [&](const char* kind, const std::string& next) {
        return Found{.kind = kind, .fact = {}, .table = {}, .next = next};
    };
    const std::string name = file.string();
    if (root.has("terrain")) {
        return of("scene", fmt::format("diurna check {0}; diurna plan {0}; diurna run {0}", name));
    }
    if (root.has("facet") || (root.has("weather") && root.has("material"))) {
        return of("column", fmt::format("diurna column {} --out FILE.csv", name));
    }
    if (root.has("part")) {
        return of("parts of a target", "use it as part_file of an [[object]] of a scene");
    }
    throw InputError(
        name,
        "is TOML, but not a scene (no [terrain]), column (no [facet]) or target (no [[part]])");
}

}  // namespace diurna
