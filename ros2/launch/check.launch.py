"""
Says what is there and what is missing, before anything moves.

ros2 launch canopeer_ros2 check.launch.py mission:=/my/mission.yaml settings:=/my/settings.yaml
"""

from pathlib import Path

from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource

LAUNCH = Path(__file__).resolve().parent


def generate_launch_description():
    return LaunchDescription(
        [
            IncludeLaunchDescription(
                PythonLaunchDescriptionSource(str(LAUNCH / 'canopeer.launch.py')),
                launch_arguments={'command': 'ros2 check'}.items(),
            )
        ]
    )
