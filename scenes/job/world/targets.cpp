#include "scenes/job/world/targets.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <variant>

#include "materials/base/error.hpp"
#include "scenes/job/world/contacts.hpp"
#include "scenes/job/world/jets.hpp"
#include "scenes/job/world/objects.hpp"
#include "terrain/visibility/two_sides.hpp"

namespace diurna {

namespace {

constexpr double held_spread = 1e4;      // of a held inner face's own along the sheet
constexpr double held_film = 1e5;        // [W m⁻² K⁻¹] to what a part is held at
constexpr double air_heat = 1.2 * 1006;  // [J m⁻³ K⁻¹] of air indoors

/// What is held on all its inner face is so at its edges too, and takes no half facet of the way.
void hold_edges(NetworkColumn& column) {
    column.spread[column.grid.size() == 1 ? 0 : 1] *= held_spread;
}

/// A part of the mesh as the target has it; one that no table names conducts, and no more.
const PartInput& part_input(const ObjectInput& input, std::size_t part) {
    static const PartInput plain{};
    const int named = input.target.part_of[part];
    return named < 0 ? plain : input.target.part[std::size_t(named)];
}

void refuse_beyond_network(const ObjectInput& input, std::size_t part,
                           const ThermalSurface& surface) {
    const bool linear =
        std::all_of(surface.layers.begin(), surface.layers.end(),
                    [](const Layer& layer) { return std::holds_alternative<Constant>(layer.law); });
    const auto* room = std::get_if<Interior>(&surface.bottom);
    const bool scheduled = !surface.internal_schedule.empty() || (room && !room->schedule.empty());
    if (linear && !scheduled && !surface.layers.empty() && !surface.snow_albedo &&
        std::holds_alternative<std::monostate>(surface.canopy)) {
        return;
    }
    throw InputError(input.where,
                     fmt::format("object \"{}\": the material of its part \"{}\" is {}, which has "
                                 "leaves, snow, water that freezes or a schedule; parts support "
                                 "plain layers, with heat by their own `hours`",
                                 input.name, part_input(input, part).name, input.material[part]));
}

/// Builds the network of one target.
class Builder {
 public:
    Builder(const World& world, const Scene& scene, const TargetFacets& target)
        : facets_(world.surfaces()),
          materials_(scene.materials),
          target_(target),
          input_(scene.terrain.objects[target.object]),
          utc_offset_(scene.time.utc_offset) {
        object_.name = input_.name;
    }

    /// taken  (facet of the scene) that a target has
    NetworkObject build(const World& world, const Scene& scene, std::vector<bool>& taken) {
        add_lumps();
        add_facets();
        join_edges();
        furnish_enclosures();
        add_sources();
        add_jets();
        refuse_closed_lumps();
        std::vector<int> part;
        for (const std::size_t of : part_) part.push_back(input_.target.part_of[of]);
        join_contacts(world, scene, input_, part, object_, taken);
        return std::move(object_);
    }

 private:
    HeatNetwork& network() { return object_.network; }
    ClockHours hours(const std::vector<ClockHours::Window>& windows) const {
        return {windows, utc_offset_};
    }
    std::uint32_t add_lump(HeatLump lump) {
        network().lump.push_back(lump);
        return std::uint32_t(network().lump.size() - 1);
    }
    std::uint32_t given_lump(double kelvin, const std::vector<ClockHours::Window>& windows) {
        const std::uint32_t lump = add_lump({.fixed = true});
        object_.given.push_back({lump, kelvin, hours(windows)});
        return lump;
    }

    void add_lumps() {
        lump_of_[outdoors_name] = given_lump(not_given, {});
        for (const EnclosureInput& room : input_.target.enclosure) {
            const std::uint32_t air = add_lump({.capacity = air_heat * room.volume});
            lump_of_[room.name] = air;
            star_of_[room.name] = add_lump({});
            const double leak = room.air_changes * room.volume * air_heat / 3600.0;
            network().link.push_back({air, lump_of_[outdoors_name], leak});
        }
        for (const LumpInput& lump : input_.target.lump) {
            if (!std::isnan(lump.kelvin)) {
                lump_of_[lump.name] = given_lump(lump.kelvin, lump.hours);
                continue;
            }
            const std::uint32_t at = add_lump({.capacity = lump.capacity});
            lump_of_[lump.name] = at;
            if (lump.watts != 0.0) {
                object_.source.push_back(
                    {.lump = at, .watts = lump.watts, .hours = hours(lump.hours)});
            }
        }
        for (const StreamInput& stream : input_.target.stream) {
            network().stream.push_back(
                {lump_of_[stream.from], lump_of_[stream.to], stream.conductance});
        }
    }

    void add_facets() {
        const std::vector<std::uint32_t> other = other_sides(facets_);
        std::map<std::pair<std::size_t, MaterialId>, std::uint32_t> column_of;
        for (std::uint32_t f = 0; f < facets_.size(); ++f) {
            if (facets_.object[f] != target_.id) continue;
            const auto part = target_.part.find(facets_.material[f]);
            if (part == target_.part.end()) continue;  // the other side of one that is there
            const ThermalSurface& surface = materials_[facets_.material[f]].thermal;
            const PartInput& of = part_input(input_, part->second);
            // Of a sheet with a room behind, the back is as warm as that, and no part of it.
            const bool sided = !other.empty() && other[f] != index(no_facet) && surface.back;
            const bool alone = of.inside.empty();
            using Inner = NetworkObject::Inner;
            const Inner inner = !alone         ? Inner::nothing
                                : sided        ? Inner::back
                                : surface.back ? Inner::air
                                               : Inner::nothing;
            const auto [place, is_new] = column_of.try_emplace(
                {part->second, facets_.material[f]}, std::uint32_t(network().column.size()));
            if (is_new) {
                const bool closed = alone && inner == Inner::nothing;
                network().column.push_back(network_column(
                    surface.layers, closed ? surface.bottom : FixedFlux{0.0}, {.deepest = 1e9}));
                if (!std::isnan(of.kelvin) && of.hours.empty()) {
                    hold_edges(network().column.back());
                }
            }
            network().facet.push_back({.column = place->second, .area = double(facets_.area[f])});
            object_.facet.push_back(f);
            object_.back.push_back(sided ? other[f] : no_number);
            object_.inner.push_back(inner);
            part_.push_back(part->second);
        }
    }

    /// Corners of the mesh within a tenth of a millimetre are one.
    std::uint32_t corner_at(std::uint32_t vertex) {
        constexpr double apart = 1e-4;  // [m], and the size of the cells they are sought in
        const Eigen::Vector3d at = facets_.vertex[vertex].cast<double>();
        const Eigen::Vector3d cell = (at / apart).array().floor();
        const auto key = [&](int x, int y, int z) {
            return std::array<std::int64_t, 3>{
                std::int64_t(cell.x()) + x, std::int64_t(cell.y()) + y, std::int64_t(cell.z()) + z};
        };
        for (int n = 0; n < 27; ++n) {
            const auto found = corner_.find(key(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1));
            if (found == corner_.end()) continue;
            for (const auto& [number, place] : found->second) {
                if ((place - at).norm() <= apart) return number;
            }
        }
        corner_[key(0, 0, 0)].push_back({corners_, at});
        return corners_++;
    }

    void join_edges() {
        using Edge = std::tuple<std::uint32_t, std::uint32_t, int, std::size_t>;
        std::map<Edge, std::uint32_t> edge_of;
        constexpr std::size_t common = ~std::size_t{0};
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> shared, of_closed;
        for (std::size_t n = 0; n < object_.size(); ++n) {
            NetworkFacet& facet = network().facet[n];
            const std::uint32_t f = object_.facet[n];
            std::array<std::uint32_t, 3> corner{};
            std::array<double, 3> side{};
            for (int s = 0; s < 3; ++s) {
                const std::uint32_t v = facets_.corner[f][s];
                corner[s] = corner_at(v);
                side[s] = double((facets_.vertex[facets_.corner[f][(s + 1) % 3]] -
                                  facets_.vertex[facets_.corner[f][(s + 2) % 3]])
                                     .norm());
            }
            facet.sideways = sideways_flow(side, facet.area);
            for (int s = 0; s < 3; ++s) {
                const std::pair<std::uint32_t, std::uint32_t> ends =
                    std::minmax(corner[(s + 1) % 3], corner[(s + 2) % 3]);
                ++shared[ends];
                if (object_.back[n] == no_number) ++of_closed[ends];
            }
            const bool welded = part_input(input_, part_[n]).welded;
            for (int end = 0; end < 2; ++end) {
                // Less than a twentieth of a W/m² for a kelvin is no way for heat.
                const double spread = network().column[facet.column].spread[end];
                if (spread < 0.05 * facet.area) continue;
                for (int s = 0; s < 3; ++s) {
                    const auto [a, b] = std::minmax(corner[(s + 1) % 3], corner[(s + 2) % 3]);
                    facet.edge[end][s] = edge_of
                                             .try_emplace({a, b, end, welded ? common : part_[n]},
                                                          std::uint32_t(edge_of.size()))
                                             .first->second;
                }
            }
        }
        network().edges = std::uint32_t(edge_of.size());
        for (const auto& [ends, count] : of_closed) {
            object_.loose_edges += shared[ends] == 1 ? 1 : 0;
        }
    }

    /// The plane that an inner face lies in, by the nearest of 26 directions.
    int direction_of(std::size_t n) const {
        const Eigen::Vector3f normal = facets_.normal[object_.facet[n]];
        int direction = 0;
        for (int axis = 0; axis < 3; ++axis) {
            constexpr float slant = 0.38f;
            const int part = normal[axis] > slant ? 2 : normal[axis] < -slant ? 0 : 1;
            direction = 3 * direction + part;
        }
        return direction;
    }
    double inner_emissivity(std::size_t n) const {
        const PartInput& part = part_input(input_, part_[n]);
        if (!std::isnan(part.inner_emissivity)) return part.inner_emissivity;
        const ThermalSurface& surface = materials_[facets_.material[object_.facet[n]]].thermal;
        return surface.back ? surface.back->emissivity : surface.emissivity;
    }

    void furnish_enclosures() {
        for (const EnclosureInput& room : input_.target.enclosure) {
            std::vector<double> area(27, 0.0);
            NetworkObject::Sunlit sunlit;
            std::vector<std::uint32_t> inside;
            for (std::uint32_t n = 0; n < object_.size(); ++n) {
                if (part_input(input_, part_[n]).inside != room.name) continue;
                inside.push_back(n);
                area[std::size_t(direction_of(n))] += network().facet[n].area;
                const ThermalSurface& surface =
                    materials_[facets_.material[object_.facet[n]]].thermal;
                if (surface.solar_transmittance > 0.0) {
                    sunlit.pane.push_back(n);
                    sunlit.transmittance.push_back(surface.solar_transmittance);
                } else {
                    sunlit.behind.push_back(n);
                }
            }
            const std::vector<double> factor = carroll_factors(area);
            for (const std::uint32_t n : inside) {
                NetworkFacet& facet = network().facet[n];
                facet.lump[behind_air] = lump_of_[room.name];
                facet.lump[behind_star] = star_of_[room.name];
                facet.film = room.film;
                facet.radiant =
                    radiant_share(factor[std::size_t(direction_of(n))], inner_emissivity(n));
            }
            if (!sunlit.pane.empty()) object_.sunlit.push_back(std::move(sunlit));
        }
    }

    std::vector<std::uint32_t> facets_of(const PartInput& part) const {
        std::vector<std::uint32_t> all;
        for (std::uint32_t n = 0; n < object_.size(); ++n) {
            if (&part_input(input_, part_[n]) == &part) all.push_back(n);
        }
        return all;
    }
    double area_of(const std::vector<std::uint32_t>& facets) {
        double area = 0.0;
        for (const std::uint32_t n : facets) area += network().facet[n].area;
        return area;
    }
    void touch(const std::vector<std::uint32_t>& facets, std::uint32_t lump, double film,
               const std::string& where) {
        for (const std::uint32_t n : facets) {
            NetworkFacet& facet = network().facet[n];
            if (facet.lump[behind_touched] != no_number) {
                throw InputError(where,
                                 "connects to a part that already touches another surface, "
                                 "expected one link or temperature_K per part");
            }
            facet.lump[behind_touched] = lump;
            facet.contact = film;
        }
    }

    void add_sources() {
        for (const PartInput& part : input_.target.part) {
            const std::vector<std::uint32_t> facets = facets_of(part);
            if (facets.empty()) continue;
            if (!std::isnan(part.kelvin)) {
                touch(facets, given_lump(part.kelvin, part.hours), held_film, part.where);
            }
            const double watts = part.watts + part.watts_m2 * area_of(facets);
            if (watts != 0.0) {
                object_.source.push_back(
                    {.facet = facets, .watts = watts, .hours = hours(part.hours)});
            }
        }
        for (const LinkInput& link : input_.target.link) {
            const int part = input_.target.find_part(link.b);
            if (part < 0) {
                network().link.push_back({lump_of_[link.a], lump_of_[link.b], link.conductance});
                continue;
            }
            const std::vector<std::uint32_t> facets =
                facets_of(input_.target.part[std::size_t(part)]);
            touch(facets, lump_of_[link.a],
                  std::isnan(link.film) ? link.conductance / area_of(facets) : link.film,
                  link.where);
        }
    }

    /// What blows, and when; where is found once all targets are there (scenes/job/world/jets.hpp).
    void add_jets() {
        for (const JetInput& jet : input_.target.jet) {
            object_.jet.push_back({.kelvin = jet.kelvin,
                                   .lump = jet.lump.empty() ? no_number : lump_of_[jet.lump],
                                   .hours = hours(jet.hours)});
        }
    }

    /// Throws InputError where heat in a lump or an enclosure has no way to a face or outdoors.
    void refuse_closed_lumps() {
        std::vector<bool> leads(network().lump.size());
        for (std::size_t k = 0; k < leads.size(); ++k) leads[k] = network().lump[k].fixed;
        for (const NetworkFacet& facet : network().facet) {
            const std::array<double, behinds> by{facet.film, facet.radiant, facet.contact};
            for (std::size_t b = 0; b < behinds; ++b) {
                if (facet.lump[b] != no_number && by[b] > 0.0) leads[facet.lump[b]] = true;
            }
        }
        for (std::size_t round = 0; round < leads.size(); ++round) {
            for (const HeatLink& link : network().link) {
                if (link.conductance == 0.0) continue;
                leads[link.a] = leads[link.b] = leads[link.a] || leads[link.b];
            }
            for (const HeatStream& stream : network().stream) {
                if (leads[stream.from] && stream.conductance > 0.0) leads[stream.to] = true;
            }
        }
        for (const auto& [name, lump] : lump_of_) {
            const std::uint32_t number = lump;
            const bool heated = std::any_of(
                object_.source.begin(), object_.source.end(),
                [&](const NetworkObject::Source& source) { return source.lump == number; });
            if (leads[lump] || (!heated && network().lump[lump].capacity > 0.0)) continue;
            throw InputError(input_.where,
                             fmt::format("object \"{}\": '{}' has no heat path, expected a link, a "
                                         "stream or a part that faces it",
                                         input_.name, name));
        }
    }

    const FacetSet& facets_;
    const MaterialLibrary& materials_;
    const TargetFacets& target_;
    const ObjectInput& input_;
    double utc_offset_;
    NetworkObject object_;
    std::vector<std::size_t> part_;  // (network's facet) of the mesh
    std::map<std::string, std::uint32_t> lump_of_, star_of_;
    std::map<std::array<std::int64_t, 3>, std::vector<std::pair<std::uint32_t, Eigen::Vector3d>>>
        corner_;  // by cell
    std::uint32_t corners_ = 0;
};

/// Reports hours of which none is within the span.
void tell_idle(const ObjectInput& input, const TimeInput& time, NetworkObject& object) {
    const auto tell = [&](const char* what, const std::string& name,
                          const std::vector<ClockHours::Window>& windows) {
        const ClockHours hours{windows, time.utc_offset};
        if (windows.empty() || hours.mean(time.start, time.end()) > 0.0) return;
        object.notes.push_back(
            fmt::format("no hour of the {} \"{}\" of \"{}\" is within the span: it has no effect",
                        what, name, input.name));
    };
    for (const PartInput& part : input.target.part) tell("part", part.name, part.hours);
    for (const LumpInput& lump : input.target.lump) tell("lump", lump.name, lump.hours);
    for (const JetInput& jet : input.target.jet) tell("jet", jet.name, jet.hours);
}

}  // namespace

TargetFacets target_facets(const ObjectInput& input, std::size_t object, ObjectId id,
                           const MaterialLibrary& materials) {
    TargetFacets target{.object = object, .id = id};
    const std::vector<std::string> names = materials.names();
    for (std::size_t part = 0; part < input.material.size(); ++part) {
        const std::string own = part_material_name(input, part);
        for (const std::string& name : {own, own + " (sheet)"}) {
            if (std::find(names.begin(), names.end(), name) == names.end()) continue;
            target.part[materials.find(name)] = part;
            refuse_beyond_network(input, part, materials[materials.find(name)].thermal);
        }
    }
    return target;
}

std::vector<NetworkObject> targets(const World& world, const Scene& scene) {
    std::vector<NetworkObject> all;
    std::vector<bool> taken(world.surfaces().size());
    for (const TargetFacets& target : world.targets) {
        all.push_back(Builder(world, scene, target).build(world, scene, taken));
        tell_idle(scene.terrain.objects[target.object], scene.time, all.back());
    }
    blow(world, scene, all);
    return all;
}

}  // namespace diurna
