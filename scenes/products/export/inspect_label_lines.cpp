#include <algorithm>
#include <sstream>

#include "materials/base/csv.hpp"
#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "scenes/products/export/inspect.hpp"

namespace diurna {

namespace {

std::vector<std::string> words_of_line(const std::string& line) {
    std::istringstream in(line);
    std::vector<std::string> words;
    for (std::string word; in >> word;) words.push_back(word);
    return words;
}

/// Whether the words from `first` on are numbers.
bool label_numbers(const std::vector<std::string>& words, std::size_t first) {
    double ignored = 0.0;
    return std::all_of(words.begin() + std::ptrdiff_t(first), words.end(),
                       [&](const std::string& word) { return parse_number(word, ignored); });
}

bool is_picture(const std::string& name) {
    return name.ends_with(".png") || name.ends_with(".tif");
}

}  // namespace

Found inspect_label_lines(const std::filesystem::path& file) {
    std::istringstream in(read_text(file));
    long long lines = 0, yolo = 0, kitti = 0, pictures = 0;
    for (std::string line; std::getline(in, line);) {
        const std::vector<std::string> words = words_of_line(line);
        if (words.empty()) continue;
        ++lines;
        yolo += words.size() == 5 && label_numbers(words, 0);
        kitti += words.size() == 15 && label_numbers(words, 1);
        pictures += words.size() == 1 && is_picture(words[0]);
    }
    const auto of = [&](const char* kind, const char* what, const char* next) {
        return Found{.kind = kind, .fact = {{what, {lines}}}, .table = {}, .next = next};
    };
    if (lines > 0 && yolo == lines) {
        return of("labels (YOLO)", "boxes", "data.yaml in the parent folder names the classes");
    }
    if (lines > 0 && kitti == lines) {
        return of("labels (KITTI)", "objects", "calib/ beside it has the camera of the same name");
    }
    if (lines > 0 && pictures == lines) {
        return of("list of pictures", "pictures", "data.yaml beside it names the lists");
    }
    throw InputError(file.string(),
                     "is text, but not boxes of YOLO or KITTI and not a list of pictures");
}

}  // namespace diurna
