#include "scenes/studies/study_files.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"

namespace diurna {

namespace fs = std::filesystem;

std::string StudyTexts::endings() const {
    std::string reported = ".csv, .json, .svg";
    for (const auto& [ending, text] : more) reported += ", " + ending;
    return reported;
}

void check_study_files(const fs::path& out, const std::vector<std::string>& names,
                       const std::vector<FileRead>& inputs) {
    if (const std::string why = why_no_output_folder(out); !why.empty()) {
        throw InputError(out.string(), why, "expected a folder or a new name for the results");
    }
    std::error_code none;
    if (!fs::exists(out, none)) return;
    for (const std::string& name : names) {
        for (const char* ending : {".csv", ".json", ".svg"}) {
            check_output_file(out / (name + ending), inputs);
        }
    }
}

void write_study_files(const fs::path& out, const std::string& name, const StudyTexts& texts) {
    fs::create_directories(out);
    write_whole_file(out / (name + ".csv"), texts.csv);
    write_whole_file(out / (name + ".json"), texts.json);
    write_whole_file(out / (name + ".svg"), texts.svg);
    for (const auto& [ending, text] : texts.more) write_whole_file(out / (name + ending), text);
}

std::string csv_cell(const std::string& name) {
    const bool formula = !name.empty() && std::string("=+-@").find(name[0]) != std::string::npos;
    const std::string text = (formula ? "'" : "") + name;
    if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

std::string stacked_svg(const std::vector<Chart>& charts) {
    int width = 0, height = 0;
    std::string inner;
    for (const Chart& chart : charts) {
        inner += fmt::format("<g transform=\"translate(0 {})\">\n{}</g>\n", height, svg(chart));
        width = std::max(width, chart.width);
        height += drawn_height(chart) + 12;
    }
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
        "height=\"{1}\">\n<style>text{{font:12px "
        "sans-serif}}.t{{font-size:15px}}.g{{stroke:#ddd;fill:none}}"
        ".e{{text-anchor:end}}.m{{text-anchor:middle}}</style>\n<rect width=\"100%\" "
        "height=\"100%\" fill=\"#fff\"/>\n{2}</svg>\n",
        width, height, inner);
}

}  // namespace diurna
