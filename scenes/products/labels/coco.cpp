#include "scenes/products/labels/coco.hpp"

#include <nlohmann/json.hpp>

#include "materials/base/made_by.hpp"
#include "scenes/products/labels/attribute_json.hpp"

namespace diurna {

namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson contrast_json(const Contrast& contrast) {
    if (!contrast.known) return nullptr;
    return {{"target", contrast.target},
            {"spread", contrast.spread},
            {"background", contrast.background},
            {"difference", contrast.difference()},
            {"rss", contrast.rss()},
            {"background_pixels", contrast.background_pixels}};
}

OrderedJson image_json(const LabelledPicture& picture, std::size_t id) {
    OrderedJson image = {{"id", id},
                         {"file_name", picture.file},
                         {"width", picture.width},
                         {"height", picture.height},
                         {"date_captured", format_instant(picture.instant)},
                         {"observer", picture.observer},
                         {"band", picture.band},
                         {"split", picture.validation ? "validation" : "train"},
                         {"planes", picture.planes},
                         {"scale",
                          {{"bits", picture.bits},
                           {"plane", picture.plane},
                           {"unit", picture.unit},
                           {"zero", picture.scale.zero},
                           {"step", picture.scale.step},
                           {"display_counts", {picture.display.black, picture.display.white}},
                           {"pixels_beyond", picture.beyond}}}};
    image.update(attribute_json(picture.attributes));
    return image;
}

OrderedJson label_json(const LabelBook& book, const LabelledPicture& picture, const Label& label) {
    const ObjectMask& mask = label.mask;
    const Labelled& object = book.objects[std::size_t(mask.object)];
    const WholeObject& whole = label.whole;
    const PictureBox& box = whole.box;
    const OrderedJson runs = {{"size", {picture.height, picture.width}}, {"counts", mask.runs}};
    return {{"category_id", class_index(book.classes, object.kind) + 1},
            {"bbox", {mask.left, mask.top, mask.width, mask.height}},
            {"area", mask.pixels},
            {"iscrowd", object.group ? 1 : 0},
            {"segmentation", runs},
            {"instance", {{"object_id", mask.object}, {"name", object.name}}},
            {"amodal_bbox", {box.left, box.top, box.right - box.left, box.bottom - box.top}},
            {"occlusion", whole.occlusion(double(mask.pixels))},
            {"truncation", whole.truncation()},
            {"pixels_on_target", mask.pixels},
            {"range_m", whole.range},
            {"aspect",
             {{"azimuth_deg", whole.aspect_azimuth_deg},
              {"elevation_deg", whole.aspect_elevation_deg}}},
            {"contrast",
             {{"apparent_temperature_K", contrast_json(label.temperature)},
              {"radiance_W_m2_sr", contrast_json(label.radiance)}}}};
}

}  // namespace

std::string grey_picture_words() {
    return "Value of a pixel = scale.zero + scale.step * count, in scale.unit. 8 bits (labels.bits "
           "= 8, the default): each picture has its own scale, from percentile 1 to percentile 99 "
           "of the pixels that see a surface; values outside the scale have count 0 or 255 "
           "(scale.pixels_beyond), and the EXR (planes) has the true values. 16 bits (labels.bits "
           "= 16): 0.01 K per count from 0 K in every picture; most viewers show these pictures "
           "black, and programs that read only the upper 8 bits get 2 to 10 grey levels: to see "
           "them, stretch scale.display_counts to black and white.";
}

std::string coco_json(const LabelBook& book, const std::vector<const LabelledPicture*>& pictures) {
    OrderedJson coco;
    coco["info"] = {{"description", made_by()},
                    {"version", "1.0"},
                    {"libraries", made_with()},
                    {"grey_pictures", grey_picture_words()}};
    coco["licenses"] = OrderedJson::array();
    coco["images"] = OrderedJson::array();
    coco["annotations"] = OrderedJson::array();
    coco["categories"] = OrderedJson::array();
    for (std::size_t c = 0; c < book.classes.size(); ++c) {
        coco["categories"].push_back(
            {{"id", c + 1}, {"name", book.classes[c]}, {"supercategory", "object"}});
    }
    std::size_t id = 0;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        coco["images"].push_back(image_json(*pictures[i], i + 1));
        for (const Label& label : pictures[i]->labels) {
            OrderedJson entry = {{"id", ++id}, {"image_id", i + 1}};
            entry.update(label_json(book, *pictures[i], label));
            coco["annotations"].push_back(std::move(entry));
        }
    }
    return coco.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace diurna
