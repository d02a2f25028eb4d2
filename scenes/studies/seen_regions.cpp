#include "scenes/studies/seen_regions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "materials/base/error.hpp"
#include "materials/radiation/planck.hpp"
#include "render/view/cast_view.hpp"
#include "scenes/job/run/picture.hpp"

namespace diurna {

namespace {

/// Facets, and objects in whose copies' place they are, that a region is made of.
class Membership {
 public:
    Membership(const Prepared& prepared, const RegionInput& region)
        : region_(region),
          surfaces_(prepared.world.surfaces()),
          wanted_material_(prepared.scene.materials.size(), 1) {
        const World& world = prepared.world;
        const MaterialLibrary& materials = prepared.scene.materials;
        if (region.kind == RegionInput::Kind::material) {
            for (std::size_t m = 0; m < materials.size(); ++m) {
                wanted_material_[m] = materials[MaterialId(m)].kind() == region.material ? 1 : 0;
            }
            return;
        }
        const auto found = std::find(world.objects.begin(), world.objects.end(), region.object);
        object_ = static_cast<ObjectId>(found - world.objects.begin());
        if (region.kind != RegionInput::Kind::part) return;
        std::fill(wanted_material_.begin(), wanted_material_.end(), 0);
        for (const TargetFacets& target : world.targets) {
            if (target.id != object_) continue;
            const auto& parts = prepared.scene.terrain.objects[target.object].target.part;
            for (const auto& [material, part] : target.part) {
                if (parts[part].name == region.part) wanted_material_[index(material)] = 1;
            }
        }
    }

    bool has(SurfaceId surface, std::uint32_t copy, const Copies& copies) const {
        const bool material = wanted_material_[index(surfaces_.material[index(surface)])] != 0;
        if (region_.kind == RegionInput::Kind::material) return material;
        const ObjectId object =
            copy == no_copy ? surfaces_.object[index(surface)] : copies[copy].object;
        return object == object_ && material;
    }

 private:
    const RegionInput& region_;
    const FacetSet& surfaces_;
    std::vector<std::uint8_t> wanted_material_;
    ObjectId object_{};
};

std::vector<std::uint32_t> rectangle(const RegionInput& region, int width) {
    std::vector<std::uint32_t> pixels;
    const auto [left, top, wide, high] = region.pixels;
    for (int row = top; row < top + high; ++row) {
        for (int column = left; column < left + wide; ++column) {
            pixels.push_back(static_cast<std::uint32_t>(row * width + column));
        }
    }
    return pixels;
}

}  // namespace

View first_seen(const Prepared& prepared, const Series& series) {
    if (series.secondary_rays.empty()) return series.view;
    return cast_view(prepared.rays, prepared.world.surfaces(), series.observer, series.sampling);
}

std::vector<SurfaceId> surfaces_of(const Prepared& prepared, const RegionInput& region) {
    std::vector<SurfaceId> found;
    if (region.kind == RegionInput::Kind::pixels) return found;
    const Membership member(prepared, region);
    const std::size_t facets = prepared.world.surfaces().size();
    for (std::size_t f = 0; f < facets; ++f) {
        const SurfaceId surface = surface_id(f);
        if (member.has(surface, no_copy, prepared.world.copies)) found.push_back(surface);
    }
    return found;
}

std::vector<float> region_cover(const View& view, const Prepared& prepared,
                                const RegionInput& region) {
    std::vector<float> cover(view.pixels(), 0.0f);
    if (region.kind == RegionInput::Kind::pixels) {
        for (const std::uint32_t p : rectangle(region, view.width)) cover[p] = 1.0f;
        return cover;
    }
    const Membership member(prepared, region);
    for (std::size_t p = 0; p < view.pixels(); ++p) {
        for (std::uint32_t s = view.row[p]; s < view.row[p + 1]; ++s) {
            const std::uint32_t target = view.sighting[s].target;
            if (!member.has(view.surface[target], view.copy_of(target), view.copies)) continue;
            cover[p] += view.sighting[s].weight;
        }
    }
    return cover;
}

std::vector<std::vector<std::uint32_t>> filled_pixels(const Prepared& prepared,
                                                      std::size_t observer,
                                                      const std::vector<RegionInput>& asked,
                                                      int samples) {
    constexpr float whole = 0.999f;
    const View view =
        cast_view(prepared.rays, prepared.world.surfaces(), prepared.sequences[observer].at(0),
                  {.samples = samples,
                   .seed = prepared.scene.seed,
                   .texture_levels = &prepared.world.texture_levels,
                   .asked = {}});
    std::vector<std::vector<std::uint32_t>> pixels(asked.size());
    for (std::size_t r = 0; r < asked.size(); ++r) {
        const std::vector<float> cover = region_cover(view, prepared, asked[r]);
        for (std::size_t p = 0; p < cover.size(); ++p) {
            if (cover[p] >= whole) pixels[r].push_back(static_cast<std::uint32_t>(p));
        }
        if (!pixels[r].empty()) continue;
        throw InputError(asked[r].where,
                         fmt::format("no pixel of \"{}\" is filled by \"{}\" alone",
                                     prepared.scene.observers[observer].name, asked[r].name),
                         "move the observer nearer, or use more pixels");
    }
    return pixels;
}

SeenRegions::SeenRegions(const SceneStage& stage, std::size_t observer,
                         const std::vector<RegionInput>& asked,
                         const std::vector<std::string>& bands, const TemperatureField& field,
                         int samples)
    : stage_(stage),
      field_(field),
      input_(stage.prepared.scene.observers[observer]),
      pose_(stage.prepared.sequences[observer].at(0)),
      pixel_(filled_pixels(stage.prepared, observer, asked, samples)) {
    input_.samples = samples;
    input_.bands = bands;
    input_.cubes.clear();
    input_.instruments.clear();
    input_.adaptive.reset();
    input_.terms = false;
    input_.surfaces = 0;
    std::vector<std::uint8_t> needed(std::size_t(pose_.width) * std::size_t(pose_.height), 0);
    for (const auto& region : pixel_) {
        for (const std::uint32_t p : region) needed[p] = 1;
    }
    series_ = std::make_unique<Series>(
        cast_series(stage.prepared, input_, pose_, field.instant, stage.views, field, needed));
}

const std::vector<double>& SeenRegions::apparent(Instant when) const {
    {
        const std::lock_guard lock(keeping_);
        if (const auto known = known_.find(when); known != known_.end()) return known->second;
    }
    const Picture picture = picture_at(stage_.prepared, *series_, stage_.views, field_, when);
    std::vector<double> kelvin;
    for (const std::vector<std::uint32_t>& region : pixel_) {
        for (const Band& band : series_->bands) {
            const std::vector<float>& radiance = picture.frame["radiance." + band.name].pixel;
            double sum = 0.0;
            for (const std::uint32_t p : region) sum += double{radiance[p]};
            kelvin.push_back(brightness_temperature(band, sum / double(region.size())));
        }
    }
    const std::lock_guard lock(keeping_);
    return known_.try_emplace(when, std::move(kelvin)).first->second;
}

}  // namespace diurna
