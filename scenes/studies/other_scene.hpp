#pragma once

#include <optional>
#include <string>
#include <utility>

#include "scenes/job/input/scene_with.hpp"
#include "scenes/studies/signature_scene.hpp"

namespace diurna {

/// Temperatures that need not be solved.
struct GivenTemperatures {
    TemperatureField field;
};

/// A variant of the studied scene with other numbers, solved; its temperatures are stored at every
/// step. Views and shadows that the numbers do not change are those of the study; where heat inputs
/// are equal by content (scenes/job/store/heat_content.hpp) so are the temperatures, and nothing is
/// solved. Must not be moved in memory: its stages refer to it.
struct OtherScene {
    Prepared prepared;
    Stages stages;
    bool solved = false;          // else the temperatures are the study's
    std::string not_converged{};  // "" if the heat balance converged

    /// Throws InputError if the numbers change the number of facets.
    ///
    /// - base: temperatures of the study's own scene; must outlive it
    /// - finer_steps: it differs only in its steps, and starts from the study's state at the start
    ///   of the span, if days before it were solved
    /// - until: instant up to which temperatures are needed; none: to the end of the span
    OtherScene(Scene scene, Study& study, const TemperatureField& base, bool finer_steps = false,
               std::optional<Instant> until = {});
    /// With given temperatures, which are not checked; nothing is solved.
    OtherScene(Scene scene, Study& study, GivenTemperatures given);
    OtherScene(const OtherScene&) = delete;
    OtherScene& operator=(const OtherScene&) = delete;

    const TemperatureField& field() const { return base_ ? *base_ : own_; }
    /// Its own temperatures; nothing if they are the study's. Not to be used afterwards.
    std::optional<TemperatureField> take_field() {
        return base_ ? std::nullopt : std::optional(std::move(own_));
    }

 private:
    const TemperatureField* base_ = nullptr;  // null: its own
    TemperatureField own_{};
};

}  // namespace diurna
