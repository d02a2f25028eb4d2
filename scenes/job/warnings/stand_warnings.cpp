#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "materials/base/number_of.hpp"
#include "scenes/job/warnings/scene_warnings.hpp"
#include "scenes/job/world/stance.hpp"
#include "scenes/job/world/structures.hpp"
#include "terrain/objects/contact_points.hpp"

namespace diurna {

namespace {

constexpr double allowed_gap = 0.2;       // [m] of gaps and burial
constexpr double near_ground = 0.5;       // [m] above it
constexpr std::size_t course_poses = 16;  // of a course, evenly
constexpr std::size_t most_stands = 10;

/// Heights [m] of an object's contact points above what is below them.
struct ContactHeights {
    double lowest = 0.0, highest = 0.0;  // below the ground: negative
    double worst() const { return std::max(-lowest, highest); }
};

/// - own: what of the scene is the object itself
class ContactRays {
 public:
    ContactRays(const Prepared& prepared, ObjectId own) : prepared_(prepared), own_(own) {}

    ContactHeights heights(const std::vector<Eigen::Vector3d>& contact,
                           const Eigen::Isometry3d& pose) const {
        Eigen::Vector3d middle = Eigen::Vector3d::Zero();
        for (const Eigen::Vector3d& at : contact) middle += at / double(contact.size());
        ContactHeights found{1e30, -1e30};
        for (const Eigen::Vector3d& at : contact) {
            const Eigen::Vector3d inside = at + 0.01 * (middle - at);  // not along a wall
            const double height = height_of((pose * inside).cast<float>());
            found.lowest = std::min(found.lowest, height);
            found.highest = std::max(found.highest, height);
        }
        return found;
    }

 private:
    enum class Met { nothing, own, ground, other };
    Met met(const Hit& hit) const {
        if (hit.facet == no_facet) return Met::nothing;
        const World& world = prepared_.world;
        if (hit.copy != no_copy) {
            return prepared_.rays.copies()[hit.copy].object == own_ ? Met::own : Met::other;
        }
        if (index(hit.facet) < world.ground_facets) return Met::ground;
        return world.facets.object[index(hit.facet)] == own_ ? Met::own : Met::other;
    }

    /// The first that is not the object itself, and its distance.
    std::pair<Met, double> beyond_itself(Eigen::Vector3f from, const Eigen::Vector3f& way) const {
        constexpr int layers = 32;
        double passed = 0.0;
        for (int layer = 0; layer < layers; ++layer) {
            const Ray ray{.origin = from, .near = 1e-3f, .direction = way};
            Hit hit;
            prepared_.rays.closest({&ray, 1}, {&hit, 1});
            const Met what = met(hit);
            if (what == Met::nothing) break;
            passed += double(hit.range);
            if (what != Met::own) return {what, passed};
            from += hit.range * way;
        }
        return {Met::nothing, 0.0};
    }

    double height_of(const Eigen::Vector3f& at) const {
        const auto [above, up] = beyond_itself(at, Eigen::Vector3f::UnitZ());
        if (above == Met::ground) return -up;
        const auto [below, down] = beyond_itself(at, -Eigen::Vector3f::UnitZ());
        return below == Met::nothing ? 0.0 : down;
    }

    const Prepared& prepared_;
    ObjectId own_;
};

/// Whether a trajectory leads over the ground, never far above it.
bool leads_on_ground(const Scene& scene, const ObjectInput& object) {
    const TrajectoryInput& way = *find_trajectory(scene.trajectories, object.trajectory);
    return way.heights == HeightOver::ground &&
           std::all_of(way.way.place.begin(), way.way.place.end(),
                       [](const Eigen::Vector3d& at) { return std::abs(at.z()) <= near_ground; });
}

std::size_t course_step(std::size_t count) {
    return std::max<std::size_t>(1, (count + course_poses - 1) / course_poses);
}

/// Where an object is in turn: where it stands, or along its course in stages and pictures.
std::vector<Eigen::Isometry3d> course_of(const Prepared& prepared, std::size_t object) {
    for (std::size_t m = 0; m < prepared.world.movers.size(); ++m) {
        if (prepared.world.movers[m].object != object) continue;
        std::vector<Eigen::Isometry3d> all;
        for (const auto* of : {&prepared.movement.at_stage, &prepared.movement.at_frame}) {
            for (std::size_t i = 0; i < of->size(); i += course_step(of->size())) {
                all.push_back((*of)[i][m]);
            }
        }
        return all;
    }
    return {stance_in(prepared.scene.terrain.objects[object].placing).pose()};
}

/// Whether its pitch and roll are given, by its keys or by the log of its trajectory.
bool turned_by_input(const Scene& scene, const ObjectInput& object) {
    return object.angles_given ||
           (!object.trajectory.empty() &&
            !find_trajectory(scene.trajectories, object.trajectory)->way.attitude.empty());
}

/// Of an object that its given pitch and roll turn into the ground: on its side or its roof its
/// lowest points are not its contact points. None where it stands well.
std::optional<Mistake> turn_warning(const Prepared& prepared, std::size_t o) {
    const Scene& scene = prepared.scene;
    const ObjectInput& object = scene.terrain.objects[o];
    if (!turned_by_input(scene, object)) return std::nullopt;
    const bool goes = !object.trajectory.empty(),
               on_ground = !goes && object.stands.over == HeightOver::ground;
    const double meant = on_ground ? std::max(0.0, -object.stands.metres) : 0.0;
    const ContactRays rays(prepared, object_id(scene, o));
    double depth = 0.0;
    for (const Eigen::Isometry3d& pose : course_of(prepared, o)) {
        const auto lowest = contact_points(*object.mesh, object.placing, pose.linear());
        depth = std::max(depth, -rays.heights(lowest, pose).lowest);
    }
    if (depth <= allowed_gap + meant) return std::nullopt;
    return Mistake{
        fmt::format("{}: object.{}", scene.file.string(), object.name),
        fmt::format("is buried up to {:.2f} m in the ground{}: pitch and roll turn it about the "
                    "middle of its base, whose height is the given one (limit {:g} m)",
                    depth, goes ? " along its trajectory" : "", allowed_gap),
        fmt::format("increase its height by {:.2f} m, or give the pitch and roll of the ground's "
                    "slope",
                    depth - meant)};
}

/// Of one object; none where it stands well.
std::optional<Mistake> stand_warning(const Prepared& prepared, std::size_t o) {
    const Scene& scene = prepared.scene;
    const ObjectInput& object = scene.terrain.objects[o];
    if (object.airspeed > 0.0 || object.contact.empty()) return std::nullopt;
    if (auto turned = turn_warning(prepared, o)) return turned;
    const bool goes = !object.trajectory.empty();
    if (!goes && object.stands.over != HeightOver::ground) return std::nullopt;
    const bool may_float =
        goes ? !leads_on_ground(scene, object) : object.stands.metres > near_ground;
    const double meant = goes ? 0.0 : object.stands.metres;
    const ContactRays rays(prepared, object_id(scene, o));
    std::optional<ContactHeights> worst;
    for (const Eigen::Isometry3d& pose : course_of(prepared, o)) {
        const ContactHeights found = rays.heights(object.contact, pose);
        const bool deep = -found.lowest > allowed_gap + std::max(0.0, -meant),
                   high = !may_float && found.highest > allowed_gap + std::max(0.0, meant);
        if ((deep || high) && (!worst || found.worst() > worst->worst())) worst = found;
    }
    if (!worst) return std::nullopt;
    const std::string remedy =
        goes || object.on_slope
            ? "the ground below it is uneven: choose another place, or set pitch_deg and roll_deg"
        : object.angles_given
            ? "pitch_deg and roll_deg do not match the ground's slope: remove them, or choose "
              "another place_m"
            : "stands = \"on_slope\" tilts it with the ground; for an upright object lower it by "
              "height_above_ground_m or choose another place_m";
    return Mistake{fmt::format("{}: object.{}", scene.file.string(), object.name),
                   fmt::format("its contact points (wheels, corners) are buried up to {:.2f} m in "
                               "the ground and float up to {:.2f} m above it{} (limit {:g} m)",
                               std::max(0.0, -worst->lowest), std::max(0.0, worst->highest),
                               goes ? " along its trajectory" : "", allowed_gap),
                   remedy};
}

}  // namespace

std::vector<Mistake> stand_warnings(const Prepared& prepared) {
    std::vector<Mistake> warnings;
    std::size_t found = 0;
    for (std::size_t o = 0; o < prepared.scene.terrain.objects.size(); ++o) {
        std::optional<Mistake> warning = stand_warning(prepared, o);
        if (warning && ++found <= most_stands) warnings.push_back(std::move(*warning));
    }
    if (found > most_stands) {
        warnings.push_back({prepared.scene.file.string(),
                            fmt::format("{} in the ground or floating above it by more than {:g} m",
                                        number_of(found - most_stands, "more object is buried",
                                                  "more objects are buried"),
                                        allowed_gap),
                            ""});
    }
    return warnings;
}

}  // namespace diurna
