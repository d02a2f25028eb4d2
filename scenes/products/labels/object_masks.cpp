#include "scenes/products/labels/object_masks.hpp"

#include <algorithm>
#include <map>

namespace diurna {

namespace {

/// A mask that grows down the columns.
struct Growing {
    ObjectMask mask;
    std::size_t counted = 0;  // pixels that the runs tell of so far

    explicit Growing(int object) : mask{object, 1 << 30, 1 << 30, 0, 0, 0, {}} {}

    void add(int column, int row, std::size_t at) {
        if (mask.runs.empty() || counted != at) {
            mask.runs.push_back(static_cast<std::uint32_t>(at - counted));
            mask.runs.push_back(0);
        }
        ++mask.runs.back();
        counted = at + 1;
        // Right and bottom edges until the end.
        mask.left = std::min(mask.left, column);
        mask.top = std::min(mask.top, row);
        mask.width = std::max(mask.width, column + 1);
        mask.height = std::max(mask.height, row + 1);
        ++mask.pixels;
    }
    void finish(std::size_t pixels) {
        if (counted < pixels) mask.runs.push_back(static_cast<std::uint32_t>(pixels - counted));
        mask.width -= mask.left;
        mask.height -= mask.top;
    }
};

}  // namespace

std::vector<ObjectMask> object_masks(const Frame& frame, const std::string& band) {
    const std::vector<float>& object = frame["object"].pixel;
    const Plane* behind = frame.find("object_behind." + band);
    std::map<int, Growing> found;
    std::size_t at = 0;
    for (int column = 0; column < frame.width; ++column) {
        for (int row = 0; row < frame.height; ++row, ++at) {
            const std::size_t p = std::size_t(row) * std::size_t(frame.width) + std::size_t(column);
            const int front = static_cast<int>(object[p]);
            const int next = behind ? static_cast<int>(behind->pixel[p]) : -1;
            for (const int id : {front, next == front ? -1 : next}) {
                if (id > 0) found.try_emplace(id, id).first->second.add(column, row, at);
            }
        }
    }
    std::vector<ObjectMask> masks;
    for (auto& [id, growing] : found) {
        growing.finish(frame.pixels());
        masks.push_back(std::move(growing.mask));
    }
    return masks;
}

std::vector<std::uint8_t> pixels_of(const ObjectMask& mask, int width, int height) {
    std::vector<std::uint8_t> in(std::size_t(width) * std::size_t(height), 0);
    std::size_t at = 0;
    bool inside = false;
    for (const std::uint32_t run : mask.runs) {
        for (std::uint32_t i = 0; inside && i < run; ++i) {
            const std::size_t column = (at + i) / std::size_t(height);
            const std::size_t row = (at + i) % std::size_t(height);
            in[row * std::size_t(width) + column] = 1;
        }
        at += run;
        inside = !inside;
    }
    return in;
}

}  // namespace diurna
