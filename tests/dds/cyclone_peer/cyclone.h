#pragma once

#include <dds/dds.h>

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>

// The little of Cyclone DDS's C interface that the peer of the tests needs.

namespace cyclone {

inline dds_entity_t made(dds_entity_t entity, const char* what) {
  if (entity >= 0) return entity;
  std::fprintf(stderr, "%s: %s\n", what, dds_strretcode(-entity));
  std::exit(2);
}

/// Loopback only, peers found by asking: lo has no multicast on most machines.
inline dds_entity_t join(int domain) {
  static constexpr const char* kSettings =
      "<CycloneDDS><Domain id=\"any\">"
      "<General><Interfaces><NetworkInterface address=\"127.0.0.1\"/></Interfaces>"
      "<AllowMulticast>false</AllowMulticast></General>"
      "<Discovery><ParticipantIndex>auto</ParticipantIndex>"
      "<MaxAutoParticipantIndex>30</MaxAutoParticipantIndex>"
      "<Peers><Peer address=\"127.0.0.1\"/></Peers></Discovery>"
      "</Domain></CycloneDDS>";
  const auto id = static_cast<dds_domainid_t>(domain);
  made(dds_create_domain(id, kSettings), "domain");
  return made(dds_create_participant(id, nullptr, nullptr), "participant");
}

struct Profile {
  bool latched = false;
  std::string user_data = {};
};

class Settings {
 public:
  explicit Settings(const Profile& profile) : qos_(dds_create_qos()) {
    dds_qset_writer_data_lifecycle(qos_, false);
    dds_qset_reliability(qos_, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
    const int depth = profile.latched ? 1 : 10;
    dds_qset_history(qos_, DDS_HISTORY_KEEP_LAST, depth);
    if (profile.latched) {
      dds_qset_durability(qos_, DDS_DURABILITY_TRANSIENT_LOCAL);
      dds_qset_durability_service(qos_, 0, DDS_HISTORY_KEEP_LAST, depth, -1, -1, -1);
    }
    if (!profile.user_data.empty()) {
      dds_qset_userdata(qos_, profile.user_data.data(), profile.user_data.size());
    }
  }
  ~Settings() { dds_delete_qos(qos_); }
  Settings(const Settings&) = delete;
  Settings& operator=(const Settings&) = delete;
  [[nodiscard]] const dds_qos_t* get() const { return qos_; }

 private:
  dds_qos_t* qos_;
};

inline dds_entity_t topic(dds_entity_t participant, const std::string& name,
                          const dds_topic_descriptor_t& type) {
  return made(dds_create_topic(participant, &type, name.c_str(), nullptr, nullptr), "topic");
}
inline dds_entity_t writer(dds_entity_t participant, const std::string& name,
                           const dds_topic_descriptor_t& type, const Profile& profile = {}) {
  return made(dds_create_writer(participant, topic(participant, name, type),
                                Settings(profile).get(), nullptr),
              "writer");
}
inline dds_entity_t reader(dds_entity_t participant, const std::string& name,
                           const dds_topic_descriptor_t& type, const Profile& profile = {}) {
  return made(dds_create_reader(participant, topic(participant, name, type),
                                Settings(profile).get(), nullptr),
              "reader");
}

/// Takes what has come, one after the other.
template <class T>
void take(dds_entity_t reader, const std::function<void(T&)>& on_sample) {
  void* samples[1] = {};
  dds_sample_info_t info;
  while (dds_take(reader, samples, &info, 1, 1) > 0) {
    if (info.valid_data) on_sample(*static_cast<T*>(samples[0]));
    dds_return_loan(reader, samples, 1);
    samples[0] = nullptr;
  }
}

inline bool has_match(dds_entity_t writer, dds_entity_t reader) {
  dds_publication_matched_status_t there{};
  dds_subscription_matched_status_t back{};
  dds_get_publication_matched_status(writer, &there);
  dds_get_subscription_matched_status(reader, &back);
  return there.current_count > 0 && back.current_count > 0;
}

}  // namespace cyclone
