#pragma once

#include <filesystem>

#include "canopeer/record/yardstick.h"

namespace canopeer::app {

/// Ends the command where the record cannot be read, or is of another mission, world or protocol;
/// one that is not there yet is of any.
void expect_same_world(const std::filesystem::path& record, const Yardstick& found);

/// Puts a yardstick into a record, with the plans it names, which lie in `out`. Where a record of
/// the same world is there already, the better of both best results stays. Ends the command where
/// the record is of another world or contradicts itself then; it is as it was.
void keep_record(const std::filesystem::path& record, const std::filesystem::path& out,
                 const Yardstick& found);

}  // namespace canopeer::app
