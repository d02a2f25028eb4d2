#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/view/observer.hpp"
#include "scenes/job/input/read_signature.hpp"
#include "scenes/job/plan/progress.hpp"
#include "scenes/job/run/given_heat.hpp"
#include "scenes/job/run/stages.hpp"
#include "scenes/job/store/stage_store.hpp"
#include "scenes/job/world/upright_box.hpp"
#include "thermal/solve/solve_span.hpp"
#include "thermal/temperature_field.hpp"

namespace diurna {

/// (facet) The largest share of any of a study's pictures that it fills.
using SeenShare = std::function<std::vector<float>()>;

/// A scene prepared for studies of single objects.
class Study {
 public:
    explicit Study(Scene scene, ProgressTo progress);

    const Scene& scene() const { return prepared_.scene; }
    const Stages& stages() const { return stages_; }
    Progress& progress() { return progress_; }
    /// Counts the solves of the heat balance for progress: "solve 3 of 8". `total` includes that of
    /// the scene itself.
    void count_solves(std::size_t total) { solves_ = total; }
    /// Another one begins, or is not needed.
    void next_solve();
    void skip_solve() { ++solve_; }
    /// Stages that its variants share.
    const std::shared_ptr<const StageStore>& store() const { return store_; }
    /// heat_content() of its scene.
    const std::string& content();
    /// Of its heat balance, the first guess of its variants; empty if it was not solved here or
    /// would take more than a gigabyte.
    const SpanCourse& course() const { return course_; }
    /// Temperatures from a file of the same scene or, if it is "", from the heat balance. If facets
    /// of the file have a representative's temperature, and this changes the study's pictures by
    /// more than tolerance_K, all facets are solved instead; a note reports either. Throws
    /// InputError for a file of other facets, and for invalid targets, before anything is
    /// solved.
    ///
    /// - seen: evaluated for such a file only
    TemperatureField heat(const std::filesystem::path& file,
                          const std::vector<StudiedObject>& studied, const SeenShare& seen);
    /// The same for studies of the whole span.
    TemperatureField heat(const std::filesystem::path& file, const SeenShare& seen);
    /// The same where every facet has to be solved.
    TemperatureField whole_heat(const std::filesystem::path& file);
    /// Notes on scene and temperatures for the report.
    const std::vector<std::string>& notes() const { return notes_; }
    /// "" if the heat balance converged.
    const std::string& not_converged() const { return not_converged_; }

 private:
    TemperatureField solve();
    TemperatureField taken(GivenHeat given);

    Progress progress_;
    Prepared prepared_;
    std::shared_ptr<const StageStore> store_;
    Stages stages_;
    std::size_t solves_ = 0, solve_ = 0;  // in all, and the number of the present one
    std::string content_{};               // "": not computed yet
    SpanCourse course_{};
    std::vector<std::string> notes_;
    std::string not_converged_;
};

/// An object that is studied, at an instant.
struct StudiedTarget {
    SceneStage stage;
    ObjectId id{};
    double heading_deg = 0.0;
    UprightBox box;
    double radius = 0.0;  // [m] from the box's middle to its corner
    double lowest = 0.0;  // [m] up
};

/// Throws InputError for one without surface, and while anything is moving.
StudiedTarget studied_target(const Stages& stages, const StudiedObject& studied, Instant when);

/// An object in one plane of a picture. A pixel counts for the share of it that the object covers,
/// so that mixed pixels at its edges are included.
struct ObjectFigures {
    double covered = 0.0;      // pixels
    double difference = 0.0;   // mean over them minus the background's
    double spread = 0.0;       // standard deviation over pixels that it fills completely
    double background = 0.0;   // mean; 0 if none is visible
    double least_width = 0.0;  // pixels, of the upright box around it in the picture
    std::size_t background_pixels = 0;

    bool known() const { return covered > 0.0 && background_pixels > 0; }
    /// √(difference² + spread²): the root sum square contrast (Ratches and others 1975).
    double rss() const;
};

/// Contents of a close picture of an object: planes of its bands, and masks.
struct CloseUp {
    Frame frame;
    std::vector<float> cover;          // (pixel) share that the object fills
    std::vector<std::uint8_t> around;  // (pixel) 1: its background

    ObjectFigures figures(const std::string& plane) const;
};

/// Renders it from `eye`, looking at the object's middle. The background is the pixels of the
/// picture without any part of the object that see a surface from its front and, for parallel rays,
/// do not begin lower than the object (in the ground).
CloseUp close_up(const StudiedTarget& target, const Observer& eye,
                 const std::vector<std::string>& bands, int samples, const TemperatureField& field,
                 Instant when);

}  // namespace diurna
