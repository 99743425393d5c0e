// A robot on Cyclone DDS: repeats texts, turns booleans round, follows trajectories of one joint,
// "elbow", for as long as their last point says. Ends with its standard input.

#include <poll.h>

#include <chrono>
#include <optional>
#include <vector>

#include "cyclone.h"
#include "ros_types.h"

namespace {

using Clock = std::chrono::steady_clock;
using Text = std_msgs_msg_dds__String_;
using TurnRequest = std_srvs_srv_dds__SetBool_Request_;
using TurnResponse = std_srvs_srv_dds__SetBool_Response_;
using CancelRequest = action_msgs_srv_dds__CancelGoal_Request_;
using CancelResponse = action_msgs_srv_dds__CancelGoal_Response_;
using GoalInfo = action_msgs_msg_dds__GoalInfo_;
using GoalStatus = action_msgs_msg_dds__GoalStatus_;
using GoalStatusArray = action_msgs_msg_dds__GoalStatusArray_;
using GoalRequest = control_msgs_action_dds__FollowJointTrajectory_SendGoal_Request_;
using GoalResponse = control_msgs_action_dds__FollowJointTrajectory_SendGoal_Response_;
using ResultRequest = control_msgs_action_dds__FollowJointTrajectory_GetResult_Request_;
using ResultResponse = control_msgs_action_dds__FollowJointTrajectory_GetResult_Response_;
using FeedbackMessage = control_msgs_action_dds__FollowJointTrajectory_FeedbackMessage_;

constexpr std::uint8_t kExecuting = 2;
constexpr std::uint8_t kSucceeded = 4;
constexpr std::uint8_t kCanceled = 5;

char kNothing[] = "";
char kElbow[] = "elbow";

class Echo {
 public:
  explicit Echo(dds_entity_t participant)
      : in_(cyclone::reader(participant, "rt/to_cyclone", std_msgs_msg_dds__String__desc)),
        out_(cyclone::writer(participant, "rt/from_cyclone", std_msgs_msg_dds__String__desc)) {
    const auto latched = cyclone::writer(participant, "rt/cyclone_description",
                                         std_msgs_msg_dds__String__desc, {true, {}});
    char text[] = "a robot";
    const Text description{text};
    dds_write(latched, &description);
  }
  void step() const {
    cyclone::take<Text>(in_, [&](Text& text) { dds_write(out_, &text); });
  }

 private:
  dds_entity_t in_;
  dds_entity_t out_;
};

class Turner {
 public:
  explicit Turner(dds_entity_t participant)
      : in_(cyclone::reader(participant, "rq/cyclone/turnRequest",
                            std_srvs_srv_dds__SetBool_Request__desc,
                            {false, "serviceid=1.2.3.4.5.6.7.8.9.a.b.c.d.e.f.1;"})),
        out_(cyclone::writer(participant, "rr/cyclone/turnReply",
                             std_srvs_srv_dds__SetBool_Response__desc,
                             {false, "serviceid=1.2.3.4.5.6.7.8.9.a.b.c.d.e.f.1;"})) {}
  void step() const {
    cyclone::take<TurnRequest>(in_, [&](TurnRequest& request) {
      char text[] = "turned";
      const TurnResponse response{request.client, request.number, !request.data, text};
      dds_write(out_, &response);
    });
  }

 private:
  dds_entity_t in_;
  dds_entity_t out_;
};

class Arm {
 public:
  explicit Arm(dds_entity_t participant) {
    const std::string base = "/cyclone_arm/follow_joint_trajectory/_action/";
    const auto serve = [&](const char* name, const dds_topic_descriptor_t& request,
                           const dds_topic_descriptor_t& response, const std::string& mark) {
      const cyclone::Profile profile{false,
                                     "serviceid=" + mark + ".2.3.4.5.6.7.8.9.a.b.c.d.e.f.2;"};
      return Service{cyclone::reader(participant, "rq" + base + name + "Request", request, profile),
                     cyclone::writer(participant, "rr" + base + name + "Reply", response, profile)};
    };
    send_goal_ =
        serve("send_goal", control_msgs_action_dds__FollowJointTrajectory_SendGoal_Request__desc,
              control_msgs_action_dds__FollowJointTrajectory_SendGoal_Response__desc, "a");
    get_result_ =
        serve("get_result", control_msgs_action_dds__FollowJointTrajectory_GetResult_Request__desc,
              control_msgs_action_dds__FollowJointTrajectory_GetResult_Response__desc, "b");
    cancel_goal_ = serve("cancel_goal", action_msgs_srv_dds__CancelGoal_Request__desc,
                         action_msgs_srv_dds__CancelGoal_Response__desc, "c");
    feedback_ =
        cyclone::writer(participant, "rt" + base + "feedback",
                        control_msgs_action_dds__FollowJointTrajectory_FeedbackMessage__desc);
    status_ = cyclone::writer(participant, "rt" + base + "status",
                              action_msgs_msg_dds__GoalStatusArray__desc, {true, {}});
    say_status();
  }

  void step() {
    cyclone::take<GoalRequest>(send_goal_.in, [&](GoalRequest& request) { take_goal(request); });
    cyclone::take<CancelRequest>(cancel_goal_.in, [&](CancelRequest& request) { cancel(request); });
    cyclone::take<ResultRequest>(get_result_.in,
                                 [&](ResultRequest& request) { waiting_.push_back(request); });
    if (goal_ && goal_->state == kExecuting && Clock::now() >= goal_->due) end(kSucceeded);
    if (goal_ && goal_->state != kExecuting) answer_waiting();
  }

 private:
  struct Service {
    dds_entity_t in = 0;
    dds_entity_t out = 0;
  };
  struct Goal {
    GoalInfo info{};
    std::uint8_t state = kExecuting;
    Clock::time_point due;
  };

  void take_goal(const GoalRequest& request) {
    const auto& trajectory = request.goal.trajectory;
    const bool accepted = trajectory.joint_names._length == 1 &&
                          std::string(trajectory.joint_names._buffer[0]) == kElbow &&
                          trajectory.points._length > 0;
    const GoalResponse response{request.client, request.number, accepted, {}};
    dds_write(send_goal_.out, &response);
    if (!accepted) return;
    const auto& last = trajectory.points._buffer[trajectory.points._length - 1].time_from_start;
    goal_ = Goal{
        {request.goal_id, {1, 0}},
        kExecuting,
        Clock::now() + std::chrono::seconds(last.sec) + std::chrono::nanoseconds(last.nanosec)};
    say_status();
    say_feedback();
  }
  void cancel(const CancelRequest& request) {
    CancelResponse response{};
    response.client = request.client;
    response.number = request.number;
    if (goal_ && goal_->state == kExecuting) {
      response.goals_canceling._buffer = &goal_->info;
      response.goals_canceling._length = response.goals_canceling._maximum = 1;
      dds_write(cancel_goal_.out, &response);
      end(kCanceled);
    } else {
      response.return_code = 3;
      dds_write(cancel_goal_.out, &response);
    }
  }
  void end(std::uint8_t state) {
    goal_->state = state;
    say_status();
  }
  void answer_waiting() {
    for (const ResultRequest& request : waiting_) {
      char text[] = "cyclone got there";
      const ResultResponse response{request.client, request.number, goal_->state, {0, text}};
      dds_write(get_result_.out, &response);
    }
    waiting_.clear();
  }
  void say_status() {
    GoalStatus status{};
    GoalStatusArray all{};
    if (goal_) {
      status = {goal_->info, goal_->state};
      all.status_list._buffer = &status;
      all.status_list._length = all.status_list._maximum = 1;
    }
    dds_write(status_, &all);
  }
  void say_feedback() {
    char* names[] = {kElbow};
    FeedbackMessage message{};
    message.goal_id = goal_->info.goal_id;
    message.feedback.header.frame_id = kNothing;
    message.feedback.joint_names._buffer = names;
    message.feedback.joint_names._length = message.feedback.joint_names._maximum = 1;
    dds_write(feedback_, &message);
  }

  Service send_goal_;
  Service get_result_;
  Service cancel_goal_;
  dds_entity_t feedback_ = 0;
  dds_entity_t status_ = 0;
  std::optional<Goal> goal_;
  std::vector<ResultRequest> waiting_;
};

bool input_ended() {
  pollfd input{0, POLLIN, 0};
  return poll(&input, 1, 1) > 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const dds_entity_t participant = cyclone::join(std::atoi(argv[1]));
  const Echo echo(participant);
  const Turner turner(participant);
  Arm arm(participant);
  while (!input_ended()) {
    echo.step();
    turner.step();
    arm.step();
  }
  return 0;
}
