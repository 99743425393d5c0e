#pragma once

#include "bound_pool.h"
#include "bound_table.h"

namespace canopeer::app {

/// Plans of one who knows the world, for fruits and for AUC, executed in the simulator into
/// clairvoyant_found_N and clairvoyant_auc_N in the directory, the N-th with what the ones before
/// it missed in mind; a run that is there and whole is not made again. Ends the command after a
/// stop.
void add_clairvoyant(const BoundArguments& arguments, const BoundWorld& world, const ViewPool& pool,
                     BoundResults& results);

/// What no plan can surpass.
void add_upper_bounds(const BoundWorld& world, const ViewPool& pool, BoundResults& results);

}  // namespace canopeer::app
