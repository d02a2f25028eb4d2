#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "materials/base/files_read.hpp"
#include "scenes/charts/chart.hpp"

namespace diurna {

/// Results of a study: NAME.csv, NAME.json and NAME.svg.
struct StudyTexts {
    std::string csv, json, svg;
    std::map<std::string, std::string> more{};  // by their ending after NAME: "_curves.csv"

    /// The endings after NAME, in one line: ".csv, .json, .svg, _curves.csv".
    std::string endings() const;
};

/// Throws InputError if the files of studies of such names cannot be written into a folder, or
/// would overwrite an input of the scene: before anything is computed.
void check_study_files(const std::filesystem::path& out, const std::vector<std::string>& names,
                       const std::vector<FileRead>& inputs);

/// Creates the folder if necessary. Each file is written whole or not at all.
void write_study_files(const std::filesystem::path& out, const std::string& name,
                       const StudyTexts& texts);

/// A name as a cell of CSV: in quotes if necessary (RFC 4180), with an apostrophe in front if a
/// spreadsheet would read it as a formula.
std::string csv_cell(const std::string& name);

/// Charts below one another in a separate file.
std::string stacked_svg(const std::vector<Chart>& charts);

}  // namespace diurna
