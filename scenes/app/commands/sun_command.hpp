#pragma once

namespace CLI {
class App;
}

namespace diurna {

/// `diurna sun`: azimuth, elevation and distance of the sun at a place and instant.
void add_sun_verb(CLI::App& app);

}  // namespace diurna
