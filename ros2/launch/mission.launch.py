"""
Runs a mission on a robot.

ros2 launch canopeer_ros2 mission.launch.py mission:=/my/mission.yaml settings:=/my/settings.yaml rviz:=true
"""

from pathlib import Path

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription, OpaqueFunction
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

SHARE = Path(__file__).resolve().parent.parent
SHOWN = ('occupied_voxels', 'roi_voxels', 'octomap_binary', 'fruits', 'fruit_markers', 'graph', 'path', 'frustum', 'detections')


def start_rviz(context):
    def said(argument):
        return LaunchConfiguration(argument).perform(context)

    if said('rviz') != 'true':
        return []
    node = '/'.join(['', *said('namespace').split('/'), said('name') or 'canopeer']).replace('//', '/')
    return [
        Node(
            package='rviz2',
            executable='rviz2',
            arguments=['-d', said('rviz_config')],
            remappings=[(f'/canopeer/{topic}', said(f'{topic}_topic') or f'{node}/{topic}') for topic in SHOWN],
        )
    ]


def generate_launch_description():
    return LaunchDescription(
        [
            DeclareLaunchArgument('rviz', default_value='false', description='true: RViz with what the mission publishes'),
            DeclareLaunchArgument('rviz_config', default_value=str(SHARE / 'rviz/canopeer.rviz'), description='its configuration'),
            IncludeLaunchDescription(
                PythonLaunchDescriptionSource(str(SHARE / 'launch/canopeer.launch.py')),
                launch_arguments={'command': 'run'}.items(),
            ),
            OpaqueFunction(function=start_rviz),
        ]
    )
