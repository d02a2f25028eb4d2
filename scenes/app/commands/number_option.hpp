#pragma once

#include <string>

#include "materials/base/key.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace diurna {

/// Refuses anything but a finite number within the range: also "nan", "inf", "1e999", "0x10" and
/// "12,5", which CLI11's own checks accept. For every option that is a number.
///
/// unit  of the range, for the message: "km"; "" for a pure number
CLI::Option* within(CLI::Option* option, Range range, const std::string& unit = "");

/// The same of whole numbers.
CLI::Option* whole_within(CLI::Option* option, int least, int most);

/// Adds checks to all options of all verbs: a value must not be empty (`--out ""` would write into
/// the working folder), and numbers must be finite.
void check_option_values(CLI::App& app);

}  // namespace diurna
