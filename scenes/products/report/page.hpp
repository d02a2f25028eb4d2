#pragma once

#include <string>
#include <utility>
#include <vector>

namespace diurna {

/// A page's beginning: its title, its styles for screen, phone and paper, links to its sections
/// (id, name), and a policy that allows only page_script() to run, even if other scripts got into
/// the page.
std::string page_begin(const std::string& title,
                       const std::vector<std::pair<std::string, std::string>>& sections);

/// The page's end, with the script.
std::string page_end();

/// The script of the picture series' sliders. The page is complete without
/// sliders.
const std::string& page_script();

/// SHA-256 of page_script() in base64, with which the page permits it (Content Security Policy,
/// W3C).
extern const char* const page_script_digest;

/// A table or chart that may be wider than a phone: scrolls within the page.
std::string wide(const std::string& inner);

}  // namespace diurna
