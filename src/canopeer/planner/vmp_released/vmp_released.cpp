#include "canopeer/planner/vmp_released/vmp_released.h"

namespace canopeer {

VmpOptions released_options(VmpOptions options) {
  options.search = VmpOptions::Search::released;
  options.stand_still_s = 5.0;
  options.rest_while_searching = true;
  options.occupied_means_roi = true;
  options.min_nodes = 1;  // it searches after its 5 s whatever the graph is
  options.max_wait_s = 20.0;

  GraphBuilderOptions& builder = options.builder;
  builder.sampler.max_tries = 1;
  builder.sampler.rolls = 1;
  builder.sampler.max_state_checks = 1;
  builder.similarity.published_below = 0.2;
  builder.neighbors = 4;
  builder.keep_unconnected = true;
  builder.batch = 16;               // little work at a time: its steps are dear
  builder.max_idle_batches = 2000;  // it never rests
  return options;
}

std::unique_ptr<Planner> make_vmp_released(const VmpOptions& options) {
  return std::make_unique<VmpPlanner>(released_options(options));
}

}  // namespace canopeer
