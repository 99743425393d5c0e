#include <gtest/gtest.h>

#include "canopeer/cdr/cdr.h"
#include "canopeer/cdr/message_names.h"
#include "canopeer/cdr/messages/action_types.h"
#include "canopeer/cdr/messages/control_msgs.h"
#include "canopeer/cdr/messages/rcl_interfaces.h"
#include "canopeer/cdr/messages/std_msgs.h"
#include "canopeer/cdr/messages/std_srvs.h"

namespace canopeer::ros {
namespace {

using Trajectory = control_msgs::FollowJointTrajectory;

TEST(MessageNames, AreThoseOfDds) {
  EXPECT_EQ(dds_type<std_msgs::String>(), "std_msgs::msg::dds_::String_");
  EXPECT_EQ(dds_request_type<std_srvs::Trigger>(), "std_srvs::srv::dds_::Trigger_Request_");
  EXPECT_EQ(dds_response_type<std_srvs::Trigger>(), "std_srvs::srv::dds_::Trigger_Response_");
  EXPECT_EQ(dds_request_type<SendGoal<Trajectory>>(),
            "control_msgs::action::dds_::FollowJointTrajectory_SendGoal_Request_");
  EXPECT_EQ(dds_response_type<GetResult<Trajectory>>(),
            "control_msgs::action::dds_::FollowJointTrajectory_GetResult_Response_");
  EXPECT_EQ(dds_type<FeedbackMessage<Trajectory>>(),
            "control_msgs::action::dds_::FollowJointTrajectory_FeedbackMessage_");
}

TEST(Cdr, CountsTheZeroOfATextAndPadsFromBehindTheHeader) {
  std_msgs::Header header;
  header.stamp = {1, 2};
  header.frame_id = "map";
  const Payload expected = {0, 1, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 4, 0, 0, 0, 'm', 'a', 'p', 0};
  EXPECT_EQ(to_cdr(header), expected);
}

TEST(Cdr, WritesNoPaddingBeforeAnEmptySequence) {
  std_msgs::Float64MultiArray empty;
  EXPECT_EQ(to_cdr(empty).size(), 4u + 4 + 4 + 4);
  empty.data = {1.0};
  EXPECT_EQ(to_cdr(empty).size(), 4u + 12 + 4 + 8);
}

TEST(Cdr, KeepsOrderInSequencesOfTruths) {
  rcl_interfaces::ParameterValue value;
  value.bool_array_value = {true, false, false, true, true};
  const auto read = from_cdr<rcl_interfaces::ParameterValue>(to_cdr(value));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->bool_array_value, value.bool_array_value);
}

TEST(Cdr, TakesATextWithoutItsZero) {
  const Payload payload = {0, 1, 0, 0, 0, 0, 0, 0};
  const auto read = from_cdr<std_msgs::String>(payload);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->data, "");
}

TEST(Cdr, SaysWhatIsNoPlainCdr) {
  EXPECT_FALSE(from_cdr<std_msgs::Bool>(Payload{}));
  EXPECT_FALSE(from_cdr<std_msgs::Bool>(Payload{0, 1, 0}));
  // Parameter lists (2, 3) and version 2 of the encoding (6 …) are other languages.
  for (const std::uint8_t kind : Payload{2, 3, 6, 7, 8, 9, 10, 11}) {
    const auto read = from_cdr<std_msgs::Bool>(Payload{0, kind, 0, 0, 1, 0, 0, 0});
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().message, "not plain CDR");
  }
}

TEST(Cdr, ReadsFeedbackThatHasAnIndexBehindTheError) {
  using Feedback = FeedbackMessage<Trajectory>;
  Feedback feedback;
  feedback.feedback.joint_names = {"elbow"};
  feedback.feedback.actual.positions = {0.25};
  // Of control_msgs 6.3: an index behind the error and at the end.
  CdrWriter writer;
  writer(feedback.goal_id);
  auto& now = feedback.feedback;
  writer(now.header, now.joint_names, now.desired, now.actual, now.error, std::int32_t{7});
  writer(now.multi_dof_joint_names, now.multi_dof_desired, now.multi_dof_actual,
         now.multi_dof_error, std::int32_t{7});
  const auto read = from_cdr<Feedback>(writer.take());
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->feedback.actual.positions, std::vector<double>{0.25});
}

}  // namespace
}  // namespace canopeer::ros
