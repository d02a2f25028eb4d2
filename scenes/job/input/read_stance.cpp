#include "scenes/job/input/read_stance.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "terrain/objects/contact_points.hpp"

namespace diurna {

namespace {

/// Whether it would fall over on a slope if nothing held it upright: a mast, a tree, a person.
bool is_slender(const ObjectInput& object) {
    constexpr double most = 3.0;  // its height over the width of what it stands on
    double height = 0.0;
    const MeshFrame frame(*object.mesh, object.placing);
    for (const Eigen::Vector3d& v : object.mesh->vertex) {
        height = std::max(height, frame.place(v).z());
    }
    return height > most * least_width(object.contact);
}

/// Where it touches the ground at too few places to say how it lies: a quarter of its plan's sides
/// each way.
std::vector<Eigen::Vector3d> points_below_plan(const ObjectInput& object) {
    Eigen::AlignedBox3d box;
    const MeshFrame frame(*object.mesh, object.placing);
    for (const Eigen::Vector3d& v : object.mesh->vertex) box.extend(frame.place(v));
    const Eigen::Vector3d half = 0.25 * box.sizes();
    return {{-half.x(), -half.y(), 0.0},
            {half.x(), -half.y(), 0.0},
            {half.x(), half.y(), 0.0},
            {-half.x(), half.y(), 0.0}};
}

}  // namespace

void read_stance(const Section& section, bool of_model, ObjectInput& object) {
    enum class Stands { by_itself, on_slope, upright };
    const Stands stands = section.choice_or(
        "stands",
        "on_slope: its contact points (wheels, tracks, corners) touch the ground, whose slope "
        "gives pitch and roll, also along a trajectory; upright: vertical, such as buildings, "
        "masts and trees; by_itself: on_slope, except for objects over 3 times as high as the base "
        "of their contact points, over 0.5 m above or below the ground (on a trajectory with a "
        "transition up to 1 m), in flight, or a model of a building or mast",
        Stands::by_itself,
        {{"by_itself", Stands::by_itself},
         {"on_slope", Stands::on_slope},
         {"upright", Stands::upright}});
    object.placing.pitch_deg = section.number_or(
        "pitch_deg", "pitch about the middle of its base, front up, instead of the slope's",
        {0.0, "from the ground's slope; 0 with roll_deg"}, {-90.0, 90.0});
    object.placing.roll_deg = section.number_or(
        "roll_deg", "roll about the middle of its base, right side down, instead of the slope's",
        {0.0, "from the ground's slope; 0 with pitch_deg"}, {-180.0, 180.0});
    const bool angles = section.has("pitch_deg") || section.has("roll_deg");
    if (angles && section.has("stands")) {
        section.mistake("stands", "cannot be combined with pitch_deg or roll_deg");
    }
    const bool on_ground = object.stands.over == HeightOver::ground;
    if (stands == Stands::on_slope && !on_ground) {
        section.mistake("stands",
                        "found \"on_slope\" for an object whose height is not above the ground, "
                        "expected height_above_ground_m");
    }
    object.angles_given = angles;
    object.contact = contact_points(*object.mesh, object.placing);
    object.on_slope =
        !angles && on_ground && !object.mesh->vertex.empty() &&
        (stands == Stands::on_slope || (stands == Stands::by_itself && !of_model &&
                                        object.airspeed == 0.0 && !is_slender(object)));
    object.at_any_height = stands == Stands::on_slope;
    constexpr double least = 0.05;  // [m]
    if (object.on_slope && least_width(object.contact) < least) {
        object.contact = points_below_plan(object);
    }
}

}  // namespace diurna
