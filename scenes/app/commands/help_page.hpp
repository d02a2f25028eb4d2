#pragma once

#include <memory>

namespace CLI {
class App;
class FormatterBase;
}  // namespace CLI

namespace diurna {

/// Sorts the verbs of the program into groups by job ("Prepare a scene", "Compute", ...).
void group_verbs(CLI::App& app);

/// Prints `diurna --help` on one screen: usage, then each group with its verbs, one line each.
std::shared_ptr<CLI::FormatterBase> help_page();

}  // namespace diurna
