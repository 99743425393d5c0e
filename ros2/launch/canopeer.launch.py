"""
Starts one command of Canopeer as a ROS 2 node. The other launch files include this one.

Every argument that is left empty is as the settings file, the mission or the program say.
"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

# Name of the argument: what it is.
PLAIN = {
    'command': 'run, ros2 check or ros2 robot',
    'mission': 'mission file, or the name of one that comes with the program',
    'out': 'folder for the results',
    'planner': 'vmp, rvp, coverage, random, …',
    'seed': 'of everything random',
    'set': 'more settings, as "key=value key=value"',
    'options': 'more options of the command, as "--this --that value"',
    'name': 'of the node; empty: canopeer',
    'namespace': 'of the node',
}

# Name of the argument: the key it sets, what it is.
SETTINGS = {
    'settings': ('ros2', 'file of the robot\'s settings (share/canopeer_ros2/settings, or yours)'),
    'robot': ('robot', 'robot.yaml, in place of the mission\'s'),
    'interfaces': ('ros2.interfaces', 'IPv4 addresses of this machine to speak on; "any"; empty: loopback only'),
    'peers': ('ros2.peers', 'IPv4 addresses that are asked besides multicast'),
    'use_sim_time': ('ros2.use_sim_time', 'true: time is that of /clock'),
    'dry_run': ('ros2.dry_run', 'true: plans and publishes, never moves'),
    'confirm': ('ros2.confirm', 'true: every motion is asked for'),
    'trajectory_action': ('ros2.arm.action', 'FollowJointTrajectory of the arm'),
    'joint_states': ('ros2.arm.joint_states', 'topic of joint states'),
    'safety_mode': ('ros2.arm.safety_mode', 'topic of the safety mode (UR)'),
    'speed_scale': ('ros2.arm.speed_scale', 'share of the velocity limits, 0 … 1'),
    'color': ('ros2.camera.color', 'topic of colour images'),
    'depth': ('ros2.camera.depth', 'topic of depth images, aligned to colour'),
    'camera_info': ('ros2.camera.info', 'topic of the camera\'s intrinsics'),
    'points': ('ros2.camera.points', 'topic of an organised cloud, in place of the three above'),
    'labels': ('ros2.camera.labels', 'topic of label images of your own detector'),
    'confidences': ('ros2.camera.confidences', 'topic of its confidences'),
    'pose': ('ros2.camera.pose', 'joint_states or tf: what the camera\'s pose comes from'),
    'trolley': ('ros2.trolley.kind', 'fixed, trajectory, topics or manual'),
    'trolley_action': ('ros2.trolley.action', 'FollowJointTrajectory of the trolley'),
}

# What the node publishes under its own name, `~/…`. Argument `fruits_topic` renames `~/fruits`.
OUTPUTS = (
    'occupied_voxels', 'roi_voxels', 'octomap_binary', 'octomap_full', 'fruits', 'fruit_markers',
    'graph', 'path', 'frustum', 'detections', 'progress',
)  # fmt: skip


def start(context):
    def said(argument):
        return LaunchConfiguration(argument).perform(context)

    arguments = said('command').split() + [said('mission')]
    if said('command') == 'run':
        arguments += ['--site', 'ros2']
    for option in ('out', 'planner', 'seed'):
        if said(option):
            arguments += [f'--{option}', said(option)]
    for argument, (key, _) in SETTINGS.items():
        if said(argument):
            arguments += ['--set', f'{key}={said(argument)}']
    for setting in said('set').split():
        arguments += ['--set', setting]
    arguments += said('options').split()
    return [
        Node(
            package='canopeer_ros2',
            executable='canopeer',
            name=said('name') or None,
            namespace=said('namespace') or None,
            arguments=arguments,
            remappings=[(f'~/{out}', said(f'{out}_topic')) for out in OUTPUTS if said(f'{out}_topic')],
            output='screen',
            emulate_tty=True,
        )
    ]


def generate_launch_description():
    about = {**PLAIN, **{argument: what for argument, (_, what) in SETTINGS.items()}}
    about.update({f'{out}_topic': f'another name for ~/{out}' for out in OUTPUTS})
    defaults = {'command': 'run', 'mission': 'smoke'}
    return LaunchDescription(
        [
            DeclareLaunchArgument(argument, default_value=defaults.get(argument, ''), description=what)
            for argument, what in about.items()
        ]
        + [OpaqueFunction(function=start)]
    )
