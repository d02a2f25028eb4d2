#include "scenes/job/world/contacts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "materials/base/error.hpp"
#include "scenes/job/world/joined_columns.hpp"
#include "terrain/visibility/touching_facets.hpp"

namespace diurna {

namespace {

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
          column_(world.surfaces(), scene.materials, object),
          covered_(object.size(), 0.0) {}

    void add(const ObjectInput& input, const ContactInput& contact) {
        const std::vector<std::uint32_t> a = of_part(input.target.find_part(contact.part)),
                                         b = contact.on == ground_name
                                                 ? ground()
                                                 : of_part(input.target.find_part(contact.on));
        const std::vector<TouchingFacets> pairs = touching_facets(facets_, a, b, contact.gap);
        if (pairs.empty()) {
            throw InputError(contact.where,
                             fmt::format("object \"{}\": no facet of \"{}\" is within {:g} m of "
                                         "\"{}\", expected a lower place or a larger gap_m",
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
                throw InputError(
                    input.where,
                    fmt::format(
                        "object \"{}\": a facet lies on several surfaces, one by {:.0f} % of its "
                        "area, expected one surface below it (textured ground has several)",
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
        if (column_.has(f)) return column_.place_of(f);
        const Material& material = materials_[facets_.material[f]];
        if (taken_[f] || !plain_layers(material.thermal)) {
            throw InputError(
                contact.where,
                taken_[f]
                    ? fmt::format("object \"{}\" lies on a ground facet that carries another "
                                  "object, expected finer ground there",
                                  input.name)
                    : fmt::format("object \"{}\" lies on {}, which has leaves, snow, water that "
                                  "freezes or a schedule; a contact supports plain layers only",
                                  input.name, material.name));
        }
        taken_[f] = true;
        covered_.push_back(0.0);
        return column_.place_of(f);
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
    JoinedColumns column_;
    std::vector<double> covered_;  // (network's facet) [m²]
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
