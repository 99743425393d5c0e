#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/cdr/cdr.h"

// A DDS domain as bytes: topics, samples, who else is there. Only participant.cpp and the room
// `fast` know the DDS library. Names here are DDS names ("rt/joint_states"); node.h has ROS names.

namespace canopeer::ros {

/// Quality of service, as far as ROS 2 uses it. The history keeps the last `depth`.
struct Qos {
  bool reliable = true;
  bool transient_local = false;  ///< who comes late gets the last ones
  int depth = 10;
};
inline constexpr Qos kDefaultQos{};
inline constexpr Qos kSensorQos{false, false, 5};
inline constexpr Qos kServiceQos{true, false, 10};
inline constexpr Qos kLatchedQos{true, true, 1};
inline constexpr Qos kTfQos{true, false, 100};

using ParticipantId = std::array<std::uint8_t, 12>;  ///< GUID prefix
using VendorId = std::array<std::uint8_t, 2>;
using Guid = std::array<std::uint8_t, 16>;                    ///< prefix, then entity
inline constexpr const char* kUserData = "source=canopeer;";  ///< some peers warn where none is
[[nodiscard]] ParticipantId participant_of(const Guid& guid);

/// The ROS middleware of a peer, told by its vendor id: services are said differently.
enum class Rmw { unknown, fastrtps, cyclonedds };

/// Another participant in the domain.
struct Peer {
  ParticipantId id{};
  VendorId vendor{};
  std::string name;
  std::string user_data;  ///< ROS puts "enclave=/;" there, Iron and later also "typehash"
  std::chrono::steady_clock::time_point since;  ///< when it was first heard of
  [[nodiscard]] Rmw rmw() const;
  /// "eProsima Fast DDS", "Eclipse Cyclone DDS", or the two octets.
  [[nodiscard]] std::string vendor_name() const;
};

/// A writer or reader of somebody else.
struct Endpoint {
  Guid guid{};
  bool writer = false;
  std::string topic;
  std::string type;
  Qos qos;  ///< depth is not told
  std::string user_data;
};

inline constexpr std::int64_t kUnknownSequence = -(std::int64_t{1} << 32);
/// Which sample of which writer.
struct SampleIdentity {
  Guid writer{};
  std::int64_t sequence = 0;
};

/// What a reader gets.
struct Sample {
  Payload payload;
  SampleIdentity identity;
  std::optional<SampleIdentity> related;  ///< rmw_fastrtps: whose request this answers, or where
                                          ///< the answer is read
};

/// Thread-safe. Goes before its participant.
class Writer {
 public:
  virtual ~Writer() = default;
  [[nodiscard]] virtual Guid guid() const = 0;
  /// Its identity; the error: the queue was full for a second.
  [[nodiscard]] virtual Expected<SampleIdentity> write(
      std::span<const std::uint8_t> payload, const std::optional<SampleIdentity>& related = {}) = 0;
  /// The readers it reaches.
  [[nodiscard]] virtual std::vector<Guid> matched() const = 0;
};

/// Its callback runs in a thread of the participant's, one sample at a time, and stops for good
/// before the destructor returns. While it runs nothing else is told: it must not wait for
/// anybody's answer, nor destroy its reader. What comes meanwhile waits: the last `depth` samples
/// where they may get lost, 1000 where not, `max_payload` octets at most. Goes before its
/// participant.
class Reader {
 public:
  virtual ~Reader() = default;
  [[nodiscard]] virtual Guid guid() const = 0;
  /// The writers it hears.
  [[nodiscard]] virtual std::vector<Guid> matched() const = 0;
};

/// Which domain, which networks, how much at once.
struct ParticipantOptions {
  std::string name = "canopeer";
  int domain = 0;                       ///< 0 … 232
  std::vector<std::string> interfaces;  ///< IPv4 addresses; empty: loopback only; "any": all
  std::vector<std::string> peers;       ///< IPv4 addresses asked besides multicast
  bool shared_memory = false;           ///< between equal versions of the DDS library only
  std::size_t max_payload = 64u << 20;  ///< octets; what is longer is dropped and counted
  [[nodiscard]] Expected<void> validate() const;
};

/// Thread-safe. Loopback only unless told otherwise.
class Participant {
 public:
  virtual ~Participant() = default;
  [[nodiscard]] static Expected<std::unique_ptr<Participant>> join(
      const ParticipantOptions& options);
  [[nodiscard]] virtual ParticipantId id() const = 0;
  /// `on_match` is called after readers came or went, in the thread that calls those of readers,
  /// not after the writer's destructor.
  [[nodiscard]] virtual Expected<std::unique_ptr<Writer>> writer(
      const std::string& topic, const std::string& type, const Qos& qos,
      const std::string& user_data = kUserData, std::function<void()> on_match = {}) = 0;
  [[nodiscard]] virtual Expected<std::unique_ptr<Reader>> reader(
      const std::string& topic, const std::string& type, const Qos& qos,
      std::function<void(Sample&&)> on_sample, const std::string& user_data = kUserData) = 0;
  [[nodiscard]] virtual std::vector<Peer> peers() const = 0;
  [[nodiscard]] virtual std::optional<Peer> peer(const ParticipantId& id) const = 0;
  [[nodiscard]] virtual std::vector<Endpoint> endpoints() const = 0;
  [[nodiscard]] virtual std::optional<Endpoint> endpoint(const Guid& guid) const = 0;
  [[nodiscard]] virtual Rmw rmw_of(const ParticipantId& peer) const = 0;
  /// Samples that were too long, since this participant joined, by all participants of the process;
  /// counted a moment after they came.
  [[nodiscard]] virtual std::int64_t dropped() const = 0;
};

/// "Fast DDS 2.9.1", as built in.
[[nodiscard]] std::string dds_library();

}  // namespace canopeer::ros
