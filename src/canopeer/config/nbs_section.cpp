#include "canopeer/config/nbs_section.h"

#include <map>

namespace canopeer {

void read_nbs(YamlMap nbs, NbsOptions& o) {
  o.beam = nbs.integer("beam", o.beam, 1, 100000);
  o.max_expansions = nbs.integer("max_expansions", o.max_expansions, 1, 10000000);
  o.max_views = nbs.integer("max_views", o.max_views, 1, 1000);
  o.horizon_s = nbs.number("horizon_s", o.horizon_s, {0.1, 36000.0});
  o.promise = nbs.number("promise", o.promise, {0.0, 100.0});
  o.early = nbs.boolean("early", o.early);
  o.replan_every_view = nbs.boolean("replan_every_view", o.replan_every_view);
}

void read_nbv(YamlMap nbv, NbvOptions& o) {
  const std::map<std::string, NbvGain> gains = {{"uvc", NbvGain::uvc},
                                                {"uvpc", NbvGain::uvpc},
                                                {"oae", NbvGain::oae},
                                                {"osamcep", NbvGain::osamcep}};
  o.gain = gains.at(nbv.choice("gain", "uvpc", {"uvc", "uvpc", "oae", "osamcep"}));
  o.views = nbv.integer("views", o.views, 1, 100000);
  o.distance_weight = nbv.number("distance_weight", o.distance_weight, {0.0, 100.0});
  o.visibility_cell_m = nbv.number("visibility_cell_m", o.visibility_cell_m, {0.001, 1.0});
  o.max_plans = nbv.integer("max_plans", o.max_plans, 1, 1000);
  o.motion.max_iterations = nbv.integer("max_iterations", o.motion.max_iterations, 1, 10000000);
}

}  // namespace canopeer
