#include "world_builder.h"

#include <chrono>
#include <utility>

#include "canopeer/run/simulation_site.h"
#include "exit_status.h"
#include "import_line.h"

namespace canopeer::app {

ImportedScene build_world_or_stop(const WorldSource& source, std::uint64_t seed,
                                  const std::optional<DetectorOptions>& detector) {
  ImportLine line(false);
  auto built = build_world_saying(source, seed, callbacks_for_people(line, false),
                                  detector ? &*detector : nullptr);
  line.clear();
  return value_or_stop(std::move(built), kBadInput);
}

}  // namespace canopeer::app
