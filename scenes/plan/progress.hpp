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
class Progress {
 public:
    explicit Progress(ProgressStyle style) : style_(style) {}
    ~Progress();

    /// Ends the stage before and begins the next.
    void stage(const std::string& name);
    /// Share of the present stage that is done, 0 to 1. Cheap; may be called from any thread.
    void done(double share);
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

    ProgressStyle style_;
    std::mutex mutex_;
    std::string name_;
    Clock::time_point began_{}, shown_{};
    std::vector<Stage> stages_;
};

}  // namespace diurna
