#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render/view/observer.hpp"
#include "scenes/input/read_signature.hpp"
#include "scenes/plan/progress.hpp"
#include "scenes/run/stages.hpp"
#include "scenes/world/upright_box.hpp"
#include "thermal/temperature_field.hpp"

namespace diurna {

/// A scene made ready for studies of single objects.
class Study {
 public:
    explicit Study(Scene scene, ProgressTo progress);

    const Scene& scene() const { return prepared_.scene; }
    const Stages& stages() const { return stages_; }
    Progress& progress() { return progress_; }
    /// Temperatures of a file of the same scene or, where it is "", those the heat balance finds.
    /// Throws InputError for a file of other facets, and for what is studied where it cannot be,
    /// before anything is solved.
    TemperatureField heat(const std::filesystem::path& file,
                          const std::vector<StudiedObject>& studied);
    /// The same of studies of the whole span.
    TemperatureField heat(const std::filesystem::path& file);
    /// What is to be reported of scene and temperatures.
    const std::vector<std::string>& notes() const { return notes_; }
    /// "" where the heat balance has converged.
    const std::string& not_converged() const { return not_converged_; }

 private:
    Progress progress_;
    Prepared prepared_;
    Stages stages_;
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

/// Throws InputError for one without surface, and while anything is on its way.
StudiedTarget studied_target(const Stages& stages, const StudiedObject& studied, Instant when);

/// What a picture shows of an object in one of its planes. A pixel counts for the share of it that
/// the object covers, so that what edges mix is not lost.
struct ObjectFigures {
    double covered = 0.0;      // pixels
    double difference = 0.0;   // mean over them less the background's
    double spread = 0.0;       // standard deviation over pixels that it fills
    double background = 0.0;   // mean; 0 where there is none to be seen
    double least_width = 0.0;  // pixels, of the upright box around it in the picture
    std::size_t background_pixels = 0;

    bool known() const { return covered > 0.0 && background_pixels > 0; }
    /// √(difference² + spread²): the root sum square contrast (Ratches and others 1975).
    double rss() const;
};

/// What a close picture of an object is made of: planes of its bands, and what counts.
struct CloseUp {
    Frame frame;
    std::vector<float> cover;          // (pixel) share that the object fills
    std::vector<std::uint8_t> around;  // (pixel) 1: its background

    ObjectFigures figures(const std::string& plane) const;
};

/// Takes it from `eye`, looking at the object's middle. The background are the pixels of the
/// picture in which nothing of the object is, and which see a surface from its front or, of
/// parallel rays, do not begin lower than the object does (in the ground).
CloseUp close_up(const StudiedTarget& target, const Observer& eye,
                 const std::vector<std::string>& bands, int samples, const TemperatureField& field,
                 Instant when);

}  // namespace diurna
