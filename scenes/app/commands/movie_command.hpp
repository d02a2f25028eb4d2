#pragma once

namespace CLI {
class App;
}

namespace diurna {

/// `diurna movie FOLDER`: a run's pictures as MP4.
void add_movie_verb(CLI::App& app);

}  // namespace diurna
