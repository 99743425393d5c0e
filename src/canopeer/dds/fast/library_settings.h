#pragma once

#include <atomic>
#include <cstdint>
#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>

#include "canopeer/dds/fast/fast_dds.h"

namespace canopeer::ros {

/// Networks, peers, how soon others notice that this participant was killed.
[[nodiscard]] fast::DomainParticipantQos participant_qos(const ParticipantOptions& options);

/// Readers and writers in one process talk as those in two do. The library's short cut between
/// them calls readers within writers' locks.
void no_short_cuts();

/// Samples that were too long, of all participants of the process. Takes the library's log, which
/// there is one of in a process, off the terminal.
[[nodiscard]] std::atomic<std::int64_t>& too_long_count();

}  // namespace canopeer::ros
