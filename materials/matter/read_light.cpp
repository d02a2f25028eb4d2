#include "materials/matter/read_light.hpp"

#include <algorithm>
#include <initializer_list>
#include <variant>

#include "materials/matter/net_optics.hpp"
#include "materials/matter/read_finish.hpp"
#include "materials/matter/read_optics.hpp"

namespace diurna {

namespace {

bool has_any(const Section& section, std::initializer_list<const char*> keys) {
    return std::any_of(keys.begin(), keys.end(), [&](const char* key) { return section.has(key); });
}

/// What lets rays go on: panes, and nets, whose spectra become the whole net's.
///
/// cover  of the net that the strips are of, 1 of what is none
void read_openings(const Section& section, double cover, Material& material) {
    material.see_through =
        section.flag_or("see_through", "rays pass through it according to its transmittance: panes",
                        material.see_through);
    const auto* glossy = std::get_if<Glossy>(&material.finish);
    if (section.has("cover")) {
        cover = section.number(
            "cover", "a net of which this share is strips of the material; the rest is open",
            {0.0, 1.0});
        if (glossy && glossy->waves) {
            section.mistake(
                "cover", "cannot be combined with finish.kind = \"waves\": water has no open share",
                "remove one of them");
        }
        material.see_through = true;
        open_up(cover, material);
    } else if (cover != 1.0) {
        open_up(cover, material);
    }
    if (material.see_through && material.transmittance.empty()) {
        section.mistake("see_through",
                        "needs a transmittance or a cover: the material lets no light through");
    }
}

}  // namespace

void read_light(const Section& section, bool fresh, Material& material) {
    const bool anew = fresh || has_any(section, {"reflectance", "transmittance", "finish"});
    const bool means = has_any(section, {"albedo", "emissivity"});
    const bool strips = anew || means || section.has("cover");
    const double cover = strips ? material.cover : 1.0;
    if (strips) take_strips(material);
    if (anew || means) read_optics(section, fresh, material);
    read_finish(section, anew, material);
    read_openings(section, cover, material);
}

}  // namespace diurna
