#pragma once

#include <cstdint>
#include <string>
#include <string_view>

// Humble and Jazzy have the same layout.

namespace canopeer::ros::std_srvs {

/// What has no members in ROS is one octet on the wire.
struct NoMembers {
  std::uint8_t structure_needs_at_least_one_member{};
  template <class Archive>
  void visit(Archive& a) {
    a(structure_needs_at_least_one_member);
  }
};

struct Trigger {
  static constexpr std::string_view kType = "std_srvs/srv/Trigger";
  using Request = NoMembers;
  struct Response {
    bool success{};
    std::string message;
    template <class Archive>
    void visit(Archive& archive) {
      archive(success, message);
    }
  };
};

struct SetBool {
  static constexpr std::string_view kType = "std_srvs/srv/SetBool";
  struct Request {
    bool data{};
    template <class Archive>
    void visit(Archive& archive) {
      archive(data);
    }
  };
  struct Response {
    bool success{};
    std::string message;
    template <class Archive>
    void visit(Archive& archive) {
      archive(success, message);
    }
  };
};

struct Empty {
  static constexpr std::string_view kType = "std_srvs/srv/Empty";
  using Request = NoMembers;
  using Response = NoMembers;
};

}  // namespace canopeer::ros::std_srvs
