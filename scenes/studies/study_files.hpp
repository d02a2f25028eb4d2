#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "materials/base/files_read.hpp"
#include "scenes/report/chart.hpp"

namespace diurna {

/// What a study reports: NAME.csv, NAME.json and NAME.svg.
struct StudyTexts {
    std::string csv, json, svg;
    std::map<std::string, std::string> more{};  // by what follows NAME: "_curves.csv"

    /// What follows NAME, in one line: ".csv, .json, .svg, _curves.csv".
    std::string endings() const;
};

/// Throws InputError where the files of studies of such names cannot be written into a folder, or
/// would take the place of what the scene is made of: before anything is computed.
void check_study_files(const std::filesystem::path& out, const std::vector<std::string>& names,
                       const std::vector<FileRead>& inputs);

/// Makes the folder where there is none. Each file appears whole or not at all.
void write_study_files(const std::filesystem::path& out, const std::string& name,
                       const StudyTexts& texts);

/// A name as a cell of CSV: in quotes where it needs them (RFC 4180), behind an apostrophe where a
/// table would take it for a formula.
std::string csv_cell(const std::string& name);

/// Charts below one another as a file of their own.
std::string stacked_svg(const std::vector<Chart>& charts);

}  // namespace diurna
