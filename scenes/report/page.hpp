#pragma once

#include <string>
#include <utility>
#include <vector>

namespace diurna {

/// A page's beginning: its title, how it looks on a screen, a phone and paper, links to its
/// sections (id, name), and what a browser may run of it: page_script() alone, whatever else
/// might have got into it.
std::string page_begin(const std::string& title,
                       const std::vector<std::pair<std::string, std::string>>& sections);

/// Its end, with the script.
std::string page_end();

/// What moves the sliders of picture_series.hpp. Without it the page has no sliders and is whole.
const std::string& page_script();

/// SHA-256 of page_script() in base64, by which the page allows it (Content Security Policy,
/// W3C).
extern const char* const page_script_digest;

/// A table or chart that may be wider than a phone: scrolls within the page.
std::string wide(const std::string& inner);

}  // namespace diurna
