// Somebody on Cyclone DDS who uses what Canopeer serves: calls /turn twenty times, has joint
// "elbow" moved, and another motion cancelled. Says what came of it, line by line.

#include <array>
#include <chrono>
#include <random>

#include "cyclone.h"
#include "ros_types.h"

namespace {

using Clock = std::chrono::steady_clock;
using CancelRequest = action_msgs_srv_dds__CancelGoal_Request_;
using CancelResponse = action_msgs_srv_dds__CancelGoal_Response_;
using FeedbackMessage = control_msgs_action_dds__FollowJointTrajectory_FeedbackMessage_;
using GoalRequest = control_msgs_action_dds__FollowJointTrajectory_SendGoal_Request_;
using GoalResponse = control_msgs_action_dds__FollowJointTrajectory_SendGoal_Response_;
using ResultRequest = control_msgs_action_dds__FollowJointTrajectory_GetResult_Request_;
using ResultResponse = control_msgs_action_dds__FollowJointTrajectory_GetResult_Response_;
using TurnRequest = std_srvs_srv_dds__SetBool_Request_;
using TurnResponse = std_srvs_srv_dds__SetBool_Response_;

constexpr std::chrono::seconds kDeadline{30};

void pause() { dds_sleepfor(DDS_MSECS(1)); }

/// A client in the manner of rmw_cyclonedds.
template <class Request, class Response>
class Client {
 public:
  Client(dds_entity_t participant, const std::string& service,
         const dds_topic_descriptor_t& request, const dds_topic_descriptor_t& response) {
    std::random_device random;
    std::string mark = "clientid=";
    for (int i = 0; i < 16; ++i) mark += (i == 0 ? "" : ".") + std::to_string(random() % 10);
    const cyclone::Profile profile{false, mark + ";"};
    out_ = cyclone::writer(participant, "rq" + service + "Request", request, profile);
    in_ = cyclone::reader(participant, "rr" + service + "Reply", response, profile);
    dds_get_instance_handle(out_, &own_);
  }
  void wait() const {
    for (const auto end = Clock::now() + kDeadline; !cyclone::has_match(out_, in_); pause()) {
      if (Clock::now() > end) fail("no server");
    }
  }
  template <class OnResponse>
  void call(Request request, OnResponse on_response) {
    request.client = own_;
    request.number = ++number_;
    dds_write(out_, &request);
    bool answered = false;
    for (const auto end = Clock::now() + kDeadline; !answered; pause()) {
      cyclone::take<Response>(in_, [&](Response& response) {
        if (response.client != own_ || response.number != number_) return;
        answered = true;
        on_response(response);
      });
      if (!answered && Clock::now() > end) fail("no answer");
    }
  }

 private:
  static void fail(const char* what) {
    std::printf("%s\n", what);
    std::exit(1);
  }
  dds_entity_t out_ = 0;
  dds_entity_t in_ = 0;
  std::uint64_t own_ = 0;
  std::int64_t number_ = 0;
};

void turn(dds_entity_t participant) {
  Client<TurnRequest, TurnResponse> client(participant, "/turn",
                                           std_srvs_srv_dds__SetBool_Request__desc,
                                           std_srvs_srv_dds__SetBool_Response__desc);
  client.wait();
  int turned = 0;
  for (int i = 0; i < 20; ++i) {
    TurnRequest request{};
    request.data = i % 2 == 0;
    client.call(request, [&](const TurnResponse& response) {
      if (response.success != request.data) ++turned;
    });
  }
  std::printf("turned %d\n", turned);
}

/// A goal with `count` points for joint "elbow"; its memory is static.
GoalRequest new_goal(std::uint32_t count) {
  static char elbow[] = "elbow";
  static char nothing[] = "";
  static char* names[] = {elbow};
  static double position[] = {0.5};
  static std::array<trajectory_msgs_msg_dds__JointTrajectoryPoint_, 20000> points;
  for (std::uint32_t i = 0; i < count; ++i) {
    points[i] = {};
    points[i].positions._buffer = position;
    points[i].positions._length = points[i].positions._maximum = 1;
    points[i].time_from_start.sec = 1;
  }
  std::random_device random;
  GoalRequest request{};
  for (auto& octet : request.goal_id.uuid) octet = static_cast<std::uint8_t>(random());
  auto& trajectory = request.goal.trajectory;
  trajectory.header.frame_id = nothing;
  request.goal.multi_dof_trajectory.header.frame_id = nothing;
  trajectory.joint_names._buffer = names;
  trajectory.joint_names._length = trajectory.joint_names._maximum = 1;
  trajectory.points._buffer = points.data();
  trajectory.points._length = trajectory.points._maximum = count;
  return request;
}

void move(dds_entity_t participant) {
  const std::string base = "/arm/follow_joint_trajectory/_action/";
  Client<GoalRequest, GoalResponse> send(
      participant, base + "send_goal",
      control_msgs_action_dds__FollowJointTrajectory_SendGoal_Request__desc,
      control_msgs_action_dds__FollowJointTrajectory_SendGoal_Response__desc);
  Client<ResultRequest, ResultResponse> result(
      participant, base + "get_result",
      control_msgs_action_dds__FollowJointTrajectory_GetResult_Request__desc,
      control_msgs_action_dds__FollowJointTrajectory_GetResult_Response__desc);
  Client<CancelRequest, CancelResponse> cancel(participant, base + "cancel_goal",
                                               action_msgs_srv_dds__CancelGoal_Request__desc,
                                               action_msgs_srv_dds__CancelGoal_Response__desc);
  const auto feedback =
      cyclone::reader(participant, "rt" + base + "feedback",
                      control_msgs_action_dds__FollowJointTrajectory_FeedbackMessage__desc);
  send.wait();
  result.wait();
  cancel.wait();
  const auto start = [&](std::uint32_t points) {
    const GoalRequest goal = new_goal(points);
    send.call(goal, [&](const GoalResponse& response) {
      std::printf("goal of %u points %s\n", points, response.accepted ? "accepted" : "rejected");
    });
    return goal;
  };
  const auto tell_result = [&](const GoalRequest& goal) {
    ResultRequest request{};
    request.goal_id = goal.goal_id;
    result.call(request, [](const ResultResponse& response) {
      std::printf("result %d %s\n", response.status, response.result.error_string);
    });
  };
  start(0);
  tell_result(start(20000));
  int heard = 0;
  cyclone::take<FeedbackMessage>(feedback, [&](FeedbackMessage&) { ++heard; });
  std::printf("feedback %s\n", heard > 0 ? "heard" : "missed");

  const GoalRequest second = start(1);
  CancelRequest request{};
  request.goal_info.goal_id = second.goal_id;
  cancel.call(request, [](const CancelResponse& response) {
    std::printf("cancelling %u\n", response.goals_canceling._length);
  });
  tell_result(second);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const dds_entity_t participant = cyclone::join(std::atoi(argv[1]));
  turn(participant);
  move(participant);
  return 0;
}
