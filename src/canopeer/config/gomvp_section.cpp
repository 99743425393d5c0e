#include "canopeer/config/gomvp_section.h"

namespace canopeer {

void read_gomvp(YamlMap gomvp, GomvpOptions& o) {
  o.max_targets = gomvp.integer("max_targets", o.max_targets, 1, 100000);
  o.target_grid_m = gomvp.number("target_grid_m", o.target_grid_m, {0.001, 1.0});
  o.max_candidates = gomvp.integer("max_candidates", o.max_candidates, 1, 100000);
  o.max_views = gomvp.integer("max_views", o.max_views, 1, 1000);
  o.neighbors = gomvp.integer("neighbors", o.neighbors, 1, 1000);
  o.max_nodes = gomvp.integer("max_nodes", o.max_nodes, 0, 100000000);
  o.max_iterations = gomvp.integer("max_iterations", o.max_iterations, 0, 100000000);
  o.replan_share = gomvp.number("replan_share", o.replan_share, {0.01, 1.0});
  o.give_up_after = gomvp.integer("give_up_after", o.give_up_after, 1, 1000000);
  o.roi_weight = gomvp.number("roi_weight", o.roi_weight, {0.001, 1000.0});
  o.occupied_weight = gomvp.number("occupied_weight", o.occupied_weight, {0.001, 1000.0});
  o.border_weight = gomvp.number("border_weight", o.border_weight, {0.001, 1000.0});
  o.shares.roi = gomvp.number("roi_share", o.shares.roi, {0.0, 1.0});
  o.shares.occupied = gomvp.number("occupied_share", o.shares.occupied, {0.0, 1.0});
  o.shares.border = gomvp.number("border_share", o.shares.border, {0.0, 1.0});
  const double sum = o.shares.roi + o.shares.occupied + o.shares.border;
  if (sum < 0.999 || sum > 1.001) gomvp.complain("roi_share", "the three shares must sum to 1");
}

}  // namespace canopeer
