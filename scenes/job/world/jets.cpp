#include "scenes/job/world/jets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <variant>

#include "materials/air/moist_air.hpp"
#include "materials/base/number_of.hpp"
#include "scenes/job/world/joined_columns.hpp"
#include "terrain/objects/placed_mesh.hpp"
#include "terrain/place/trajectory.hpp"
#include "terrain/visibility/ray_scene.hpp"
#include "terrain/visibility/two_sides.hpp"
#include "thermal/surface/hot_jet.hpp"

namespace diurna {

namespace {

/// A jet where it stands in the scene.
struct Placed {
    HotJet jet;
    Eigen::Vector3d outlet, direction;
    double reach;
};

Placed placed(const JetInput& input, const ObjectInput& object, const TargetFacets& target,
              double sea_level_height) {
    const MeshFrame frame(*object.mesh, object.placing);
    Placed placed{
        .jet = {.diameter = input.diameter,
                .speed = input.speed,
                .temperature = std::isnan(input.kelvin) ? JetInput::lump_gas : input.kelvin},
        .outlet = target.pose * frame.place(input.outlet),
        .direction = target.pose.linear() * frame.direction(input.direction),
        .reach = 0.0};
    placed.jet.pressure = standard_pressure(sea_level_height);
    if (std::isnan(input.speed)) placed.jet.speed = speed_of(input.flow, placed.jet);
    placed.reach = jet_reach(placed.jet);
    return placed;
}

/// Places on a triangle, each the middle of as much of it.
std::vector<Eigen::Vector3d> places_on(const std::array<Eigen::Vector3d, 3>& corner, double apart) {
    constexpr int most = 24;
    const double longest = std::max({(corner[1] - corner[0]).norm(), (corner[2] - corner[1]).norm(),
                                     (corner[0] - corner[2]).norm()});
    const int n = std::clamp(int(std::ceil(longest / apart)), 1, most);
    std::vector<Eigen::Vector3d> places;
    const Eigen::Vector3d u = (corner[1] - corner[0]) / n, v = (corner[2] - corner[0]) / n;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; i + j < n; ++j) {
            const Eigen::Vector3d at = corner[0] + i * u + j * v;
            places.push_back(at + (u + v) / 3.0);
            if (i + j + 1 < n) places.push_back(at + 2.0 * (u + v) / 3.0);
        }
    }
    return places;
}

/// What rays find of a jet's way.
class JetRay {
 public:
    JetRay(const RayScene& rays, const FacetSet& facets, const Placed& jet)
        : rays_(rays), facets_(facets), jet_(jet) {
        begin_ = jet.outlet + 0.3 * jet.jet.diameter * jet.direction;
        const Ray axis{.origin = begin_.cast<float>(),
                       .direction = jet.direction.cast<float>(),
                       .far = float(jet.reach)};
        rays.closest(std::span(&axis, 1), std::span(&end_, 1));
    }
    /// The axis ends on something so close to the outlet that it must lie within the mesh.
    bool shut() const { return end_.facet != no_facet && end_.range < 0.5 * jet_.jet.diameter; }
    /// The axis ends on the surface that a facet is of.
    bool meets(const Eigen::Vector3d& middle, const Eigen::Vector3d& normal) const {
        if (end_.facet == no_facet) return false;
        const double range = double(end_.range);
        const Eigen::Vector3d there = begin_ + range * jet_.direction;
        return std::abs(normal.dot(there - middle)) < 0.1 * range &&
               normal.dot(facets_.normal[index(end_.facet)].cast<double>()) > 0.7;
    }
    bool reaches(const Eigen::Vector3d& place, const Eigen::Vector3d& normal) const {
        const Eigen::Vector3d to = place + (2e-3 + 1e-3 * (place - begin_).norm()) * normal;
        const double range = (to - begin_).norm();
        if (range < 1e-6) return true;
        const Ray ray{.origin = begin_.cast<float>(),
                      .direction = ((to - begin_) / range).cast<float>(),
                      .far = float(range)};
        std::uint8_t blocked = 0;
        rays_.occluded(std::span(&ray, 1), std::span(&blocked, 1));
        return blocked == 0;
    }

 private:
    const RayScene& rays_;
    const FacetSet& facets_;
    const Placed& jet_;
    Eigen::Vector3d begin_;
    Hit end_{};
};

/// [W m⁻² K⁻¹] means over a facet: of the film, and of what it brings for each kelvin of the gas.
struct Blown {
    double film = 0.0, heat = 0.0;
};

/// way  null: whatever may stand in it, now or later
Blown blown(const FacetSet& facets, std::size_t f, const Placed& jet, const JetRay* way) {
    const Eigen::Vector3d middle = facets.centroid[f].cast<double>(),
                          normal = facets.normal[f].cast<double>();
    std::array<Eigen::Vector3d, 3> corner;
    double size = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
        corner[c] = facets.vertex[facets.corner[f][c]].cast<double>();
        size = std::max(size, (corner[c] - middle).norm());
    }
    const double away = (middle - jet.outlet).norm();
    if (away - size > jet.reach) return {};
    const double apart = std::max(0.5 * jet.jet.diameter, 0.1 * std::max(0.0, away - size));
    const std::vector<Eigen::Vector3d> places = places_on(corner, apart);
    const bool met = !way || way->meets(middle, normal);
    Blown mean;
    for (const Eigen::Vector3d& place : places) {
        JetFilm film = jet_film(jet.jet, jet.direction, place - jet.outlet, normal, met);
        if (!way && !(film.film > 0.0)) {
            film = jet_film(jet.jet, jet.direction, place - jet.outlet, normal, false);
        }
        if (!(film.film > 0.0) || (way && !way->reaches(place, normal))) continue;
        mean.film += film.film / double(places.size());
        mean.heat += film.film * film.warmth / double(places.size());
    }
    return mean;
}

/// Whose a facet is: which target's, and which of its faces.
struct Owner {
    std::size_t target;
    std::uint32_t facet;
    bool back;
};

class Blowing {
 public:
    Blowing(const World& world, const Scene& scene, std::vector<NetworkObject>& all)
        : world_(world), scene_(scene), all_(all), rays_(world.facets) {
        const std::vector<std::uint32_t> other = other_sides(world.surfaces());
        sided_.assign(world.surfaces().size(), false);
        for (std::size_t f = 0; f < other.size(); ++f) sided_[f] = other[f] != index(no_facet);
        moves_.assign(world.surfaces().size(), false);
        for (std::size_t f = 0; f < moves_.size(); ++f) {
            for (const Mover& mover : world.movers) {
                if (world.surfaces().object[f] == mover.id) moves_[f] = true;
            }
        }
    }

    void add(std::size_t t) {
        const ObjectInput& input = scene_.terrain.objects[world_.targets[t].object];
        for (std::size_t j = 0; j < input.target.jet.size(); ++j) {
            find_owners();
            add(t, j, input, input.target.jet[j]);
        }
    }

 private:
    void find_owners() {
        owner_.clear();
        for (std::size_t t = 0; t < all_.size(); ++t) {
            const NetworkObject& object = all_[t];
            for (std::uint32_t n = 0; n < object.size(); ++n) {
                owner_[object.facet[n]] = {t, n, false};
                if (object.inner[n] == NetworkObject::Inner::back) {
                    owner_[object.back[n]] = {t, n, true};
                }
            }
        }
    }

    void add(std::size_t t, std::size_t j, const ObjectInput& input, const JetInput& reported) {
        const FacetSet& facets = world_.surfaces();
        const Placed jet = placed(reported, input, world_.targets[t], world_.sea_level_height);
        const JetRay way(rays_, world_.facets, jet);
        const bool goes = !input.trajectory.empty();
        const std::string who = fmt::format("the jet \"{}\" of \"{}\"", reported.name, input.name);
        if (way.shut()) {
            all_[t].notes.push_back(
                who + " is blocked at its outlet, by its own mesh or by a surface close to it");
        }
        struct Found {
            std::uint32_t facet;
            Blown by;
        };
        std::vector<Found> found;
        std::size_t left_out = 0;
        std::set<std::string> reasons;  // of those
        double area = 0.0, heat = 0.0, left_area = 0.0;
        for (std::uint32_t f = 0; f < facets.size(); ++f) {
            const auto owner = owner_.find(f);
            const bool owned = owner != owner_.end();
            Blown by = blown(facets, f, jet, &way);
            // Where things go, a facet is the target's in every stage or in none.
            const bool joins = !owned && !world_.movers.empty() && !goes &&
                               blown(facets, f, jet, nullptr).heat > 0.0;
            if (!(by.heat > 0.0) && !joins) continue;
            const char* const why_not =
                not_heated(t, reported, goes, f, owned ? &owner->second : nullptr);
            if (why_not != nullptr) {
                if (!(by.heat > 0.0)) continue;
                ++left_out;
                left_area += double(facets.area[f]);
                reasons.insert(why_not);
                continue;
            }
            found.push_back({f, by});
            heat += by.heat * double(facets.area[f]);
            area += by.heat > 0.0 ? double(facets.area[f]) : 0.0;
        }
        const double has = heat_flow(jet.jet), share = heat / has;
        JoinedColumns column(facets, scene_.materials, all_[t]);
        std::map<std::size_t, std::size_t> place;  // (target) its jet
        place[t] = j;
        for (const Found& one : found) {
            const auto owner = owner_.find(one.facet);
            const Owner of =
                owner != owner_.end() ? owner->second : Owner{t, column.place_of(one.facet), false};
            const auto [at, is_new] = place.try_emplace(of.target, all_[of.target].jet.size());
            if (is_new) {
                all_[of.target].jet.push_back(
                    {.kelvin = reported.kelvin, .lump = no_number, .hours = all_[t].jet[j].hours});
            }
            all_[of.target].jet[at->second].face.push_back(
                {of.facet, of.back, one.by.film, one.by.heat / std::max(1.0, share)});
        }
        tell(t, who, area, share, has);
        if (left_out > 0) {
            all_[t].notes.push_back(fmt::format("{} does not heat {} ({:.1f} m2) in its path: {}",
                                                who, number_of(left_out, "facet"), left_area,
                                                fmt::join(reasons, "; ")));
        }
    }

    /// Why a facet cannot have the jet's film; null if it can.
    const char* not_heated(std::size_t t, const JetInput& reported, bool goes, std::uint32_t f,
                           const Owner* owner) const {
        if (owner && owner->target == t) return nullptr;
        if (goes) return "the jet of a moving object heats that object only";
        if (owner) {
            return reported.lump.empty() ? nullptr
                                         : "they belong to another target, but the jet's "
                                           "temperature is that of a lump";
        }
        if (sided_[f]) return "they have a back side";
        if (moves_[f]) return "they move by themselves";
        const ThermalSurface& surface = scene_.materials[world_.surfaces().material[f]].thermal;
        if (plain_layers(surface)) return nullptr;
        if (!std::holds_alternative<std::monostate>(surface.canopy)) return "they have leaves";
        if (surface.snow_albedo) return "they have snow";
        if (surface.layers.empty()) return "they have no layers";
        const bool constant = std::all_of(
            surface.layers.begin(), surface.layers.end(),
            [](const Layer& layer) { return std::holds_alternative<Constant>(layer.law); });
        return constant ? "they follow a schedule"
                        : "properties of their layers change with temperature or water";
    }

    void tell(std::size_t t, const std::string& who, double area, double share, double has) {
        if (area == 0.0) {
            all_[t].notes.push_back(who + " reaches no surface that it can heat");
            return;
        }
        all_[t].notes.push_back(fmt::format(
            "{} transfers up to {:.3g} % of its {:.3g} W/K to {:.2g} m2{}", who,
            100.0 * std::min(1.0, share), has, area,
            share > 1.0
                ? fmt::format(", after reduction from {:.2g} times the available heat flow", share)
                : std::string()));
    }

    const World& world_;
    const Scene& scene_;
    std::vector<NetworkObject>& all_;
    RayScene rays_;
    std::vector<bool> sided_, moves_;  // (facet)
    std::map<std::uint32_t, Owner> owner_;
};

/// Plumes of pictures are given by themselves: one at an outlet should not be warmer than its gas.
void compare_plumes(const World& world, const Scene& scene, std::vector<NetworkObject>& all) {
    for (std::size_t t = 0; t < all.size(); ++t) {
        const ObjectInput& input = scene.terrain.objects[world.targets[t].object];
        for (const JetInput& reported : input.target.jet) {
            const Placed jet = placed(reported, input, world.targets[t], world.sea_level_height);
            for (const PlumeInput& plume : scene.plumes) {
                const double away = (plume.place - jet.outlet.head<2>()).norm();
                if (away > plume.radius + jet.jet.diameter) continue;
                if (!(plume.temperature > jet.jet.temperature) || !reported.lump.empty()) continue;
                all[t].notes.push_back(fmt::format(
                    "the plume \"{}\" has {:g} K at the outlet of the jet \"{}\" of {:g} K",
                    plume.name, plume.temperature, reported.name, reported.kelvin));
            }
        }
    }
}

}  // namespace

std::vector<GroundPatch> jet_patches(const ObjectInput& object, double over_ground) {
    std::vector<GroundPatch> patches;
    if (!object.trajectory.empty()) return patches;
    TargetFacets target{.object = 0, .id = {}};
    target.pose.linear() = attitude(object.placing.heading_deg, 0.0, 0.0).toRotationMatrix();
    target.pose.translation() = Eigen::Vector3d(object.place.x(), object.place.y(), over_ground);
    for (const JetInput& reported : object.target.jet) {
        const Placed jet = placed(reported, object, target, 0.0);
        const double range = -jet.outlet.z() / std::min(-1e-9, jet.direction.z());
        if (!(range > 0.0 && range < jet.reach)) continue;
        const Eigen::Vector2d middle = (jet.outlet + range * jet.direction).head<2>();
        const double diameter = std::max(reported.diameter, range / 12.0);
        constexpr double least = 0.03;  // [m]
        for (const auto& [half, edge] : {std::pair{8.0, 2.0}, {3.0, 0.8}}) {
            GroundPatch patch{.ring = {}, .largest_edge = std::max(least, edge * diameter)};
            for (const auto& [x, y] :
                 {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
                patch.ring.push_back(middle + half * diameter * Eigen::Vector2d(x, y));
            }
            patches.push_back(std::move(patch));
        }
    }
    return patches;
}

void blow(const World& world, const Scene& scene, std::vector<NetworkObject>& all) {
    const bool any = std::any_of(all.begin(), all.end(),
                                 [](const NetworkObject& object) { return !object.jet.empty(); });
    if (!any) return;
    Blowing blowing(world, scene, all);
    for (std::size_t t = 0; t < all.size(); ++t) blowing.add(t);
    compare_plumes(world, scene, all);
}

}  // namespace diurna
