#include "scenes/products/labels/yolo.hpp"

#include <fmt/format.h>

namespace diurna {

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

}  // namespace diurna
