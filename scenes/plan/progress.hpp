#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <vector>

namespace diurna {

enum class ProgressStyle { bar, lines, json, silent };

/// A bar on a terminal, plain lines elsewhere.
ProgressStyle default_progress_style();

/// Tells on stderr what a job is doing and how far it is, and keeps the seconds each stage took.
/// Elsewhere than on a terminal (`lines`): a line when a stage ends; before that one for each tenth
/// that is done, where these are two seconds apart, and what it works on after ten seconds without
/// another line.
class Progress {
 public:
    explicit Progress(ProgressStyle style) : style_(style) {}
    ~Progress();

    /// Ends the stage before and begins the next.
    void stage(const std::string& name);
    /// Share of the present stage that is done, 0 to 1. Cheap; may be called from any thread.
    void done(double share);
    /// What the present stage works on, in a few words; shown while it takes long.
    void doing(const std::string& what);
    /// A line of its own, at once: what somebody should know before it is done.
    void tell(const std::string& note);
    /// Counts seconds of the present stage as a stage of their own, before it.
    void set_apart(const std::string& name, double seconds);
    /// Ends the last stage.
    void finish();

    struct Stage {
        std::string name;
        double seconds;
    };
    const std::vector<Stage>& stages() const { return stages_; }

 private:
    using Clock = std::chrono::steady_clock;
    void show(double share, bool ended);
    bool due(double share) const;

    ProgressStyle style_;
    std::mutex mutex_;
    std::string name_, doing_;
    double share_ = 0.0;  // as told last
    int tenths_ = 0;      // of the present stage that have been shown as lines
    Clock::time_point began_{}, shown_{};
    std::vector<Stage> stages_;
};

}  // namespace diurna
