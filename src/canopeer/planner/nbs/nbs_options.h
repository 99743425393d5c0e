#pragma once

namespace canopeer {

/// How node-wise beam search looks for a path; what views see and how long they take is VMP's
/// (VmpOptions::path_search).
struct NbsOptions {
  int beam = 8;              ///< B: partial paths kept per node
  int max_expansions = 600;  ///< partial paths extended in one search
  int max_views = 8;         ///< longest path looked at
  /// It looks no farther ahead, nor beyond the segment's end. Of what lies farther off the map will
  /// say something else by then; tried: 10, 4, 2.5 s (docs/method.md).
  double horizon_s = 2.5;
  /// Weight of what the frontier promises in a partial path's value; 0: its gain alone.
  double promise = 0.5;
  /// A view's gain counts in proportion to the time that is left then: soon is better than late.
  bool early = false;
  bool replan_every_view = true;  ///< false: paths are followed up to VMP's look-ahead
};

}  // namespace canopeer
