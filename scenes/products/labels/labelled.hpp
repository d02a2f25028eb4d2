#pragma once

#include <string>
#include <vector>

#include "scenes/job/input/scene.hpp"
#include "scenes/job/world/world.hpp"

/// Names and classes of a scene's objects in labels.
namespace diurna {

struct Labelled {
    std::string name;          // in the scene file
    std::string kind;          // its class; "": the ground, which has no labels
    double heading_deg = 0.0;  // of its front, a rectangle's length; clockwise from north
    bool group = false;        // several things under one name: the buildings of [[shapes]]
};

/// (ObjectId)
std::vector<Labelled> labelled_objects(const Scene& scene, const World& world);

/// Every class of a scene once, in alphabetical order.
std::vector<std::string> class_list(const std::vector<Labelled>& objects);
/// Its place in that list.
std::size_t class_index(const std::vector<std::string>& classes, const std::string& kind);

}  // namespace diurna
