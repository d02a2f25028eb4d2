#include "scenes/job/plan/picture_work.hpp"

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "render/rays/lobe.hpp"
#include "scenes/job/plan/plan_costs.hpp"
#include "scenes/job/plan/seen_pixels.hpp"

namespace diurna {

namespace {

constexpr double planes_of_picture = 14.0;  // of truth, beside those of its bands

/// Pixels of a picture that send rays on, mean over an observer's views.
struct Onward {
    double followed = 0.0;  // one by one: off water and smooth mirrors, through panes and nets
    double all = 0.0;       // these, and paints whose gloss is summed over a lobe
};

bool follows_rays(const Material& material) {
    const auto* const gloss = std::get_if<Glossy>(&material.finish);
    return material.see_through ||
           (gloss != nullptr && (gloss->waves || gloss->roughness < least_lobe));
}

/// Facets of copies that send rays on, in their places.
FacetSet copied_facets(const Scene& scene, const World& world) {
    FacetSet there;
    const FacetSet& facets = world.facets;
    for (std::size_t c = 0; c < world.copies.size(); ++c) {
        const Copy& copy = world.copies[c];
        for (std::uint32_t f = copy.first; f < copy.first + copy.facets; ++f) {
            if (!scene.materials[facets.material[f]].needs_rays()) continue;
            there.material.push_back(facets.material[f]);
            there.area.push_back(facets.area[f]);
            there.centroid.push_back((copy.pose * facets.centroid[f].cast<double>()).cast<float>());
            there.normal.push_back(
                (copy.pose.linear() * facets.normal[f].cast<double>()).cast<float>());
        }
    }
    return there;
}

Onward onward_pixels(const Scene& scene, const World& world, const Sequence& sequence) {
    if (sequence.pose.empty()) return {};
    const auto with = [&](const auto& has) {
        std::vector<bool> of(scene.materials.size());
        for (std::size_t i = 0; i < of.size(); ++i) {
            of[i] = has(scene.materials[MaterialId{static_cast<std::uint16_t>(i)}]);
        }
        return of;
    };
    const std::vector<bool> followed = with(follows_rays),
                            all = with([](const Material&m) { return m.needs_rays(); });
    const FacetSet copies = copied_facets(scene, world);
    const std::size_t count = std::min(most_poses, sequence.pose.size());
    Onward mean;
    for (std::size_t k = 0; k < count; ++k) {
        const Observer& pose = sequence.pose[k * sequence.pose.size() / count];
        const auto pixels = [&](const std::vector<bool>& of) {
            const auto counts = [&](MaterialId id) { return of[index(id)]; };
            return (seen_pixels(pose, world.facets, counts) + seen_pixels(pose, copies, counts)) /
                   double(count);
        };
        mean.followed += pixels(followed);
        mean.all += pixels(all);
    }
    return mean;
}

double channels_of(const Scene& scene, const std::string& cube) {
    const auto at = std::find_if(scene.cubes.begin(), scene.cubes.end(),
                                 [&](const CubeInput& one) { return one.name == cube; });
    return at == scene.cubes.end() ? 0.0 : double(at->channels);
}

}  // namespace

PictureWork picture_work(const Scene& scene, const World& world,
                         std::span<const Sequence> sequences) {
    PictureWork work;
    for (std::size_t o = 0; o < scene.observers.size(); ++o) {
        const ObserverInput& observer = scene.observers[o];
        const double pixels = double(observer.width) * observer.height;
        const double bands = double(observer.bands.size());
        const double frames = double(observer.frames.size());
        double channels = 0.0;
        for (const std::string& cube : observer.cubes) channels += channels_of(scene, cube);
        work.pictures += bands * frames;
        work.pixels += pixels * bands * frames;
        work.channel_pictures += channels * frames;
        work.channel_pixels += pixels * channels * frames;
        const double planes = planes_of_picture + bands * (observer.terms ? 8.0 : 2.0);
        const double behind = scene.plumes.empty() ? 0.0 : 64.0 * observer.samples;
        work.largest_view =
            std::max(work.largest_view,
                     pixels * (plan_costs.view_pixel + behind + plan_costs.plane_value * planes +
                               plan_costs.channel_value * channels));
        if (o >= sequences.size()) continue;
        const Onward onward = onward_pixels(scene, world, sequences[o]);
        const bool by_need = observer.adaptive || (observer.samples >= 4 && observer.surfaces == 0);
        work.followed_rays += onward.followed * double(sequences[o].pose.size()) *
                              observer.samples * (by_need ? plan_costs.samples_by_need : 1.0);
        work.onward += std::sqrt(onward.all) * frames * bands;
    }
    return work;
}

}  // namespace diurna
