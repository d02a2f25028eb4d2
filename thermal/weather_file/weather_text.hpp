#pragma once

#include <filesystem>
#include <string>

namespace diurna {

/// The member of a zip archive that is weather as text: the only .epw, else the only file named
/// .csv, .dat or .tab; "" if it is no archive, a spreadsheet, or an archive without exactly one
/// such file. Archives of EPW also hold a .ddy, .stat and others.
std::string weather_member(const std::filesystem::path& file);

/// The text of a weather file, or of that member.
std::string weather_text(const std::filesystem::path& file);

}  // namespace diurna
