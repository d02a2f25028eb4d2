#include "scenes/world/contacts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <variant>

#include "materials/base/error.hpp"
#include "terrain/visibility/touching_facets.hpp"

namespace diurna {

namespace {

bool plain(const ThermalSurface& surface) {
    const auto* room = std::get_if<Interior>(&surface.bottom);
    return !surface.layers.empty() && !surface.snow_albedo && surface.internal_schedule.empty() &&
           !(room && !room->schedule.empty()) &&
           std::holds_alternative<std::monostate>(surface.canopy) &&
           std::all_of(surface.layers.begin(), surface.layers.end(), [](const Layer& layer) {
               return std::holds_alternative<Constant>(layer.law);
           });
}

/// Builds the contacts of one target.
class Contacts {
 public:
    Contacts(const World& world, const Scene& scene, const std::vector<int>& part,
             NetworkObject& object, std::vector<bool>& taken)
        : facets_(world.surfaces()),
          ground_facets_(world.ground_facets),
          materials_(scene.materials),
          part_(part),
          object_(object),
          taken_(taken),
          covered_(object.size(), 0.0) {
        for (std::uint32_t n = 0; n < object.size(); ++n) place_[object.facet[n]] = n;
    }

    void add(const ObjectInput& input, const ContactInput& contact) {
        const std::vector<std::uint32_t> a = of_part(input.target.find_part(contact.part)),
                                         b = contact.on == ground_name
                                                 ? ground()
                                                 : of_part(input.target.find_part(contact.on));
        const std::vector<TouchingFacets> pairs = touching_facets(facets_, a, b, contact.gap);
        if (pairs.empty()) {
            throw InputError(contact.where,
                             fmt::format("object \"{}\": nothing of \"{}\" lies within {:g} m on "
                                         "\"{}\", expected it lower or a larger gap_m",
                                         input.name, contact.part, contact.gap, contact.on));
        }
        for (const TouchingFacets& pair : pairs) join(input, contact, pair);
    }

    /// Closes the arrays once all are there.
    void finish(const ObjectInput& input) {
        HeatNetwork& network = object_.network;
        std::stable_sort(
            network.touch.begin(), network.touch.end(),
            [](const HeatTouch& one, const HeatTouch& other) { return one.facet < other.facet; });
        for (std::size_t n = 0; n < network.facet.size(); ++n) {
            const double share = covered_[n] / network.facet[n].area;
            if (share > 1.05) {
                throw InputError(input.where,
                                 fmt::format("object \"{}\": a facet lies on others by {:.0f} % of "
                                             "its area, expected one thing below it (textured "
                                             "ground has several)",
                                             input.name, 100.0 * share));
            }
            network.facet[n].open = std::max(0.0, 1.0 - share);
        }
    }

 private:
    std::vector<std::uint32_t> of_part(int part) const {
        std::vector<std::uint32_t> all;
        for (std::size_t n = 0; n < part_.size(); ++n) {
            if (part_[n] == part) all.push_back(object_.facet[n]);
        }
        return all;
    }
    std::vector<std::uint32_t> ground() const {
        std::vector<std::uint32_t> all(ground_facets_);
        std::iota(all.begin(), all.end(), 0u);
        return all;
    }
    /// The network's facet of a scene's; ground joins it.
    std::uint32_t place_of(const ObjectInput& input, const ContactInput& contact, std::uint32_t f) {
        const auto [at, is_new] = place_.try_emplace(f, std::uint32_t(object_.size()));
        if (!is_new) return at->second;
        const MaterialId material = facets_.material[f];
        const ThermalSurface& surface = materials_[material].thermal;
        if (taken_[f] || !plain(surface)) {
            throw InputError(
                contact.where,
                taken_[f] ? fmt::format("object \"{}\" lies on a facet of the ground that another "
                                        "object lies on too, expected finer ground there",
                                        input.name)
                          : fmt::format("object \"{}\" lies on {}, which has leaves, snow, water "
                                        "that freezes or a schedule; a contact knows plain layers",
                                        input.name, materials_[material].name));
        }
        taken_[f] = true;
        HeatNetwork& network = object_.network;
        const auto [column, is_kind] =
            column_.try_emplace(material, std::uint32_t(network.column.size()));
        if (is_kind) network.column.push_back(network_column(surface.layers, surface.bottom));
        network.facet.push_back({.column = column->second, .area = double(facets_.area[f])});
        object_.facet.push_back(f);
        object_.back.push_back(no_number);
        object_.inner.push_back(NetworkObject::Inner::nothing);
        covered_.push_back(0.0);
        return at->second;
    }
    void join(const ObjectInput& input, const ContactInput& contact, const TouchingFacets& pair) {
        HeatNetwork& network = object_.network;
        const std::uint32_t edge = network.edges++;
        for (const std::uint32_t f : {pair.a, pair.b}) {
            const std::uint32_t n = place_of(input, contact, f);
            network.touch.push_back({n, edge, 2.0 * contact.film * pair.area});
            covered_[n] += pair.area;
        }
    }

    const FacetSet& facets_;
    std::size_t ground_facets_;
    const MaterialLibrary& materials_;
    const std::vector<int>& part_;
    NetworkObject& object_;
    std::vector<bool>& taken_;
    std::vector<double> covered_;  // (network's facet) [m²]
    std::map<std::uint32_t, std::uint32_t> place_;
    std::map<MaterialId, std::uint32_t> column_;
};

}  // namespace

void join_contacts(const World& world, const Scene& scene, const ObjectInput& input,
                   const std::vector<int>& part, NetworkObject& object, std::vector<bool>& taken) {
    if (input.target.contact.empty()) return;
    Contacts contacts(world, scene, part, object, taken);
    for (const ContactInput& contact : input.target.contact) contacts.add(input, contact);
    contacts.finish(input);
}

}  // namespace diurna
