#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <optional>

#include "scenes/job/plan/progress.hpp"

namespace diurna::python {

/// Runs long work on a thread of its own and returns when it has ended. Other threads of Python
/// run meanwhile. Ten times a second the caller checks for Ctrl-C and passes on the progress
/// reported since, with the interpreter's lock held. A KeyboardInterrupt, or whatever `progress`
/// raises, asks the work to stop (materials/base/giving_up.hpp) and is raised once it has. Throws
/// what the work throws.
///
/// - progress: None, or a callable that takes (stage, share from 0 to 1)
/// - work: must not touch Python objects
void long_call(const pybind11::object& progress,
               const std::function<void(const ProgressTo&)>& work);

/// The same for work that returns a value.
template <class Work>
auto result_of_long_call(const pybind11::object& progress, const Work& work) {
    std::optional<decltype(work(ProgressTo{}))> result;
    long_call(progress, [&](const ProgressTo& to) { result.emplace(work(to)); });
    return std::move(*result);
}

}  // namespace diurna::python
