#pragma once

#include <tuple>

#include "canopeer/cdr/messages/action_types.h"
#include "canopeer/cdr/messages/control_msgs.h"
#include "canopeer/cdr/messages/diagnostic_msgs.h"
#include "canopeer/cdr/messages/nav_msgs.h"
#include "canopeer/cdr/messages/octomap_msgs.h"
#include "canopeer/cdr/messages/rcl_interfaces.h"
#include "canopeer/cdr/messages/rmw_dds_common.h"
#include "canopeer/cdr/messages/rosgraph_msgs.h"
#include "canopeer/cdr/messages/std_srvs.h"
#include "canopeer/cdr/messages/tf2_msgs.h"
#include "canopeer/cdr/messages/vision_msgs.h"
#include "canopeer/cdr/messages/visualization_msgs.h"

namespace canopeer::ros {

/// All that is sent as a whole.
using AllMessages = std::tuple<
    std_msgs::String, std_msgs::Bool, std_msgs::Float64, std_msgs::Float64MultiArray,
    geometry_msgs::PoseStamped, geometry_msgs::PoseArray, geometry_msgs::Point32,
    sensor_msgs::Image, sensor_msgs::CompressedImage, sensor_msgs::CameraInfo,
    sensor_msgs::JointState, sensor_msgs::PointCloud2, tf2_msgs::TFMessage,
    trajectory_msgs::JointTrajectory, trajectory_msgs::MultiDOFJointTrajectory,
    SendGoal<control_msgs::FollowJointTrajectory>::Request,
    SendGoal<control_msgs::FollowJointTrajectory>::Response,
    GetResult<control_msgs::FollowJointTrajectory>::Request,
    GetResult<control_msgs::FollowJointTrajectory>::Response,
    FeedbackMessage<control_msgs::FollowJointTrajectory>, action_msgs::GoalStatusArray,
    action_msgs::CancelGoal::Request, action_msgs::CancelGoal::Response, std_srvs::Trigger::Request,
    std_srvs::Trigger::Response, std_srvs::SetBool::Request, rcl_interfaces::Log,
    rcl_interfaces::ParameterEvent, rcl_interfaces::GetParameters::Request,
    rcl_interfaces::GetParameters::Response, rcl_interfaces::GetParameterTypes::Response,
    rcl_interfaces::SetParameters::Request, rcl_interfaces::SetParameters::Response,
    rcl_interfaces::SetParametersAtomically::Response, rcl_interfaces::ListParameters::Request,
    rcl_interfaces::ListParameters::Response, rcl_interfaces::DescribeParameters::Response,
    visualization_msgs::MarkerArray, vision_msgs::Detection3DArray,
    diagnostic_msgs::DiagnosticArray, rosgraph_msgs::Clock, octomap_msgs::Octomap, nav_msgs::Path,
    rmw_dds_common::ParticipantEntitiesInfo<rmw_dds_common::kHumbleGid>,
    rmw_dds_common::ParticipantEntitiesInfo<rmw_dds_common::kIronGid>>;

/// `visit(message)` with an empty one of each.
template <class Visit>
void for_each_message(Visit visit) {
  std::apply([&](auto... messages) { (visit(messages), ...); }, AllMessages());
}

}  // namespace canopeer::ros
