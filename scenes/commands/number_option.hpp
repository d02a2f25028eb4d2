#pragma once

#include <string>

#include "materials/base/key.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace diurna {

/// Refuses what is not a finite number within the range: "nan", "inf", "1e999", "0x10" and "12,5"
/// too, which CLI11's own checks let pass. For every option that is a number.
///
/// unit  of the range, said in the message: "km"; "" for a pure number
CLI::Option* within(CLI::Option* option, Range range, const std::string& unit = "");

/// The same of whole numbers.
CLI::Option* whole_within(CLI::Option* option, int least, int most);

/// Gives all options of all verbs what they have in common: a value that is not empty (`--out ""`
/// would write into the working folder), and a finite number where one is read.
void check_option_values(CLI::App& app);

}  // namespace diurna
