#include "scenes/products/labels/whole_objects.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "materials/base/units.hpp"
#include "scenes/job/world/some_facets.hpp"
#include "scenes/job/world/upright_box.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

namespace {

void stand(const FacetSet& part, const Labelled& object, const Observer& observer,
           WholeObject& whole) {
    const Eigen::Vector3d front = direction(object.heading_deg, 0.0);
    const Eigen::Vector3d right = direction(object.heading_deg + 90.0, 0.0);
    const UprightBox box = *upright_box(part, part.object.front(), object.heading_deg);
    whole.middle = box.middle;
    whole.length = box.length;
    whole.width = box.width;
    whole.height = box.height;
    whole.heading_deg = object.heading_deg;
    const Eigen::Vector3d to_eye = observer.position - whole.middle;
    whole.range = to_eye.norm();
    const double ahead = to_eye.dot(front), aside = to_eye.dot(right);
    whole.aspect_azimuth_deg = degrees(std::atan2(aside, ahead));
    whole.aspect_elevation_deg = degrees(std::atan2(to_eye.z(), std::hypot(ahead, aside)));
}

}  // namespace

double WholeObject::truncation() const {
    const double all = alone.inside + alone.outside;
    return all > 0.0 ? alone.outside / all : 0.0;
}

double WholeObject::occlusion(double seen) const {
    return alone.inside > seen ? 1.0 - seen / alone.inside : 0.0;
}

std::map<int, WholeObject> whole_objects(const FacetSet& facets, const FacetSet& stands,
                                         const Copies& copies, const std::vector<Labelled>& objects,
                                         const Observer& observer) {
    std::vector<std::vector<std::uint32_t>> of_object(objects.size());
    for (std::uint32_t f = 0; f < facets.size(); ++f) {
        const auto id = static_cast<std::size_t>(facets.object[f]);
        if (id < objects.size() && !objects[id].kind.empty()) of_object[id].push_back(f);
    }
    std::map<int, WholeObject> all;
    const auto add = [&](std::size_t id, const FacetSet& part, const FacetSet& standing) {
        std::vector<std::uint32_t> every(part.size());
        std::iota(every.begin(), every.end(), 0u);
        const std::optional<PictureBox> box = projected_box(observer, part, every);
        if (!box) return;
        WholeObject& whole = all[static_cast<int>(id)];
        whole.box = *box;
        stand(standing, objects[id], observer, whole);
        const bool beside = box->right < 0.0 || box->bottom < 0.0 || box->left > observer.width ||
                            box->top > observer.height;
        if (!beside) whole.alone = seen_alone(observer, RayScene(part), *box);
    };
    for (std::size_t id = 0; id < objects.size(); ++id) {
        if (of_object[id].empty()) continue;
        const FacetSet part = some_facets(facets, of_object[id]);
        // The ground of a large scene is not copied twice.
        if (&stands == &facets) {
            add(id, part, part);
        } else {
            add(id, part, some_facets(stands, of_object[id]));
        }
    }
    for (std::size_t c = 0; c < copies.size(); ++c) {
        const auto id = static_cast<std::size_t>(copies[c].object);
        if (id < objects.size() && !objects[id].kind.empty()) {
            const FacetSet placed = in_place(facets, copies[c]);
            add(id, placed, placed);
        }
    }
    return all;
}

}  // namespace diurna
