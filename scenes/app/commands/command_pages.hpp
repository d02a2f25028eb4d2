#pragma once

#include <string>

namespace CLI {
class App;
}

namespace diurna {

/// The manual page of the program in the language of man(7): every verb of `app` with its
/// arguments, exit codes, environment.
std::string man_page(const CLI::App& app, const std::string& version);

/// A bash script that completes verbs, their options and options' words; file names
/// elsewhere.
std::string bash_completion(const CLI::App& app);

}  // namespace diurna
