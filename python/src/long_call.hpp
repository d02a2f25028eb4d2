#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <optional>

#include "scenes/plan/progress.hpp"

namespace diurna::python {

/// Does work that may take long on a thread of its own and comes back when it is done. Meanwhile
/// other threads of Python go on, and the caller looks for Ctrl-C ten times a second and reports
/// `progress`, here and with the interpreter held, of stages and shares. A KeyboardInterrupt, or
/// what `progress` raises, gives the work up (materials/base/giving_up.hpp) and is raised when it
/// has ended. Throws what the work throws.
///
/// - work: touches nothing of Python
/// - progress: None or a callable that takes (stage, share)
void long_call(const pybind11::object& progress,
               const std::function<void(const ProgressTo&)>& work);

/// The same of work that returns something.
template <class Work>
auto found_by_long_call(const pybind11::object& progress, const Work& work) {
    std::optional<decltype(work(ProgressTo{}))> found;
    long_call(progress, [&](const ProgressTo& to) { found.emplace(work(to)); });
    return std::move(*found);
}

}  // namespace diurna::python
