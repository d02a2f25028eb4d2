#include "scenes/report/annotations.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "materials/base/files.hpp"
#include "render/picture/exr.hpp"
#include "scenes/plan/frame_files.hpp"

namespace diurna {

std::vector<ObjectMask> object_masks(const Frame& frame) {
    const std::vector<float>& object = frame["object"].pixel;
    const auto at = [&](int column, int row) {
        return static_cast<int>(
            object[std::size_t(row) * std::size_t(frame.width) + std::size_t(column)]);
    };
    std::map<int, ObjectMask> found;
    for (int column = 0; column < frame.width; ++column) {
        for (int row = 0; row < frame.height; ++row) {
            const int id = at(column, row);
            if (id <= 0) continue;
            auto [place, is_new] = found.try_emplace(id, ObjectMask{id, column, row, 1, 1, 0, {}});
            ObjectMask& mask = place->second;
            const int right = std::max(mask.left + mask.width, column + 1);
            const int bottom = std::max(mask.top + mask.height, row + 1);
            mask.left = std::min(mask.left, column);
            mask.top = std::min(mask.top, row);
            mask.width = right - mask.left;
            mask.height = bottom - mask.top;
            ++mask.pixels;
        }
    }
    std::vector<ObjectMask> masks;
    for (auto& [id, mask] : found) {
        bool inside = false;
        std::uint32_t run = 0;
        for (int column = 0; column < frame.width; ++column) {
            for (int row = 0; row < frame.height; ++row) {
                if ((at(column, row) == id) != inside) {
                    mask.runs.push_back(run);
                    run = 0;
                    inside = !inside;
                }
                ++run;
            }
        }
        mask.runs.push_back(run);
        masks.push_back(std::move(mask));
    }
    return masks;
}

void write_annotations(const std::filesystem::path& folder, const std::vector<Annotated>& images,
                       const std::vector<std::string>& object_names) {
    nlohmann::ordered_json coco;
    coco["info"] = {{"description", "diurna " DIURNA_VERSION}, {"version", "1.0"}};
    coco["images"] = nlohmann::json::array();
    coco["annotations"] = nlohmann::json::array();
    coco["categories"] = nlohmann::json::array();
    for (std::size_t i = 1; i < object_names.size(); ++i) {
        coco["categories"].push_back({{"id", i}, {"name", object_names[i]}});
    }
    std::size_t annotation = 0;
    for (std::size_t i = 0; i < images.size(); ++i) {
        const Annotated& image = images[i];
        coco["images"].push_back({{"id", i + 1},
                                  {"file_name", image.file},
                                  {"width", image.width},
                                  {"height", image.height},
                                  {"date_captured", format_instant(image.instant)},
                                  {"observer", image.observer}});
        for (const ObjectMask& mask : *image.masks) {
            coco["annotations"].push_back(
                {{"id", ++annotation},
                 {"image_id", i + 1},
                 {"category_id", mask.object},
                 {"bbox", {mask.left, mask.top, mask.width, mask.height}},
                 {"area", mask.pixels},
                 {"iscrowd", 1},  // what COCO calls a mask given by run lengths
                 {"segmentation", {{"size", {image.height, image.width}}, {"counts", mask.runs}}}});
        }
    }
    write_whole_file(folder / "annotations.json", coco.dump() + "\n");
}

void annotate_frames(const Prepared& prepared, const std::filesystem::path& out) {
    const Scene& scene = prepared.scene;
    std::vector<std::vector<ObjectMask>> masks;  // (observer)
    for (const ObserverInput& observer : scene.observers) {
        const Instant first = prepared.plan.frames.front();
        masks.push_back(object_masks(
            read_exr(out / (frame_base(observer.name, observer.bands.front(), first) + ".exr"))));
    }
    std::vector<Annotated> images;
    for (std::size_t o = 0; o < scene.observers.size(); ++o) {
        const ObserverInput& observer = scene.observers[o];
        for (const Instant instant : prepared.plan.frames) {
            for (const std::string& band : observer.bands) {
                images.push_back({.file = frame_base(observer.name, band, instant) + ".exr",
                                  .instant = instant,
                                  .observer = observer.name,
                                  .width = observer.width,
                                  .height = observer.height,
                                  .masks = &masks[o]});
            }
        }
    }
    write_annotations(out, images, prepared.world.objects);
}

}  // namespace diurna
