#include "scenes/labels/text_labels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/view/pixel_rays.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

namespace {

/// An angle brought to −π to π.
double turned(double angle) { return std::remainder(angle, 2.0 * std::numbers::pi); }

int occlusion_level(double share) { return share <= 0.05 ? 0 : share <= 0.5 ? 1 : 2; }

std::string one_word(std::string kind) {
    std::replace(kind.begin(), kind.end(), ' ', '_');
    return kind;
}

}  // namespace

std::string yolo_text(const LabelBook& book, const LabelledPicture& picture) {
    std::string text;
    for (const Label& label : picture.labels) {
        const Labelled& object = book.objects[std::size_t(label.mask.object)];
        if (object.group) continue;
        const ObjectMask& mask = label.mask;
        text +=
            fmt::format("{} {:.6f} {:.6f} {:.6f} {:.6f}\n", class_index(book.classes, object.kind),
                        (mask.left + 0.5 * mask.width) / picture.width,
                        (mask.top + 0.5 * mask.height) / picture.height,
                        double(mask.width) / picture.width, double(mask.height) / picture.height);
    }
    return text;
}

std::string yolo_data(const LabelBook& book) {
    std::string text = "path: .\ntrain: train.txt\nval: validation.txt\nnames:\n";
    for (std::size_t c = 0; c < book.classes.size(); ++c) {
        text += fmt::format("  {}: \"{}\"\n", c, book.classes[c]);
    }
    return book.classes.empty() ? text.replace(text.find("names:"), 6, "names: {}") : text;
}

std::string kitti_text(const LabelBook& book, const LabelledPicture& picture,
                       const Observer& observer) {
    const PixelRays eye = pixel_rays(observer);
    std::string text;
    for (const Label& label : picture.labels) {
        const Labelled& object = book.objects[std::size_t(label.mask.object)];
        const ObjectMask& mask = label.mask;
        const WholeObject& whole = label.whole;
        const Eigen::Vector3d bottom =
            whole.middle - Eigen::Vector3d(0.0, 0.0, 0.5 * whole.height) - observer.position;
        const Eigen::Vector3d front = direction(whole.heading_deg, 0.0);
        const double x = bottom.dot(eye.right), y = bottom.dot(eye.down), z = bottom.dot(eye.axis);
        const double rotation = std::atan2(-front.dot(eye.axis), front.dot(eye.right));
        text += fmt::format(
            "{} {:.2f} {} {:.4f} {:.2f} {:.2f} {:.2f} {:.2f} {:.3f} {:.3f} {:.3f} {:.3f} {:.3f} "
            "{:.3f} {:.4f}\n",
            object.group ? "DontCare" : one_word(object.kind), whole.truncation(),
            occlusion_level(whole.occlusion(double(mask.pixels))),
            turned(rotation - std::atan2(x, z)), double(mask.left), double(mask.top),
            double(mask.left + mask.width - 1), double(mask.top + mask.height - 1), whole.height,
            whole.width, whole.length, x, y, z, rotation);
    }
    return text;
}

}  // namespace diurna
