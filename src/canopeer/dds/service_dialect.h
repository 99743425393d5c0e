#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>

#include "canopeer/base/expected.h"
#include "canopeer/cdr/cdr.h"
#include "canopeer/dds/participant.h"

// How rmw_cyclonedds says whose request a payload is: 16 octets before the members. rmw_fastrtps
// says it beside the payload, in SampleIdentity.

namespace canopeer::ros {

/// How to speak to all `servers` of a service. The error: there is none, one whose middleware
/// speaks in neither way, or some of both.
[[nodiscard]] Expected<Rmw> dialect_of(const std::set<Rmw>& servers);

/// What rmw_cyclonedds puts before a request and its answer.
struct RequestHead {
  std::uint64_t client = 0;
  std::int64_t sequence = 0;
  [[nodiscard]] bool operator==(const RequestHead&) const = default;
};

[[nodiscard]] Payload with_head(const Payload& body, const RequestHead& head);

/// A message behind such a head.
struct HeadAndBody {
  RequestHead head;
  Payload body;
};
/// Nothing: too short for a head.
[[nodiscard]] std::optional<HeadAndBody> split_head(Payload&& payload);

/// "clientid=1.2.f…;" with 16 octets drawn anew: rmw_cyclonedds finds a client's reader and writer
/// (key "clientid"), or a server's ("serviceid"), by it.
[[nodiscard]] std::string new_pair_mark(const std::string& key);
/// The value of `key` in "key=value;…", or nothing.
[[nodiscard]] std::string user_data_value(const std::string& user_data, const std::string& key);

}  // namespace canopeer::ros
