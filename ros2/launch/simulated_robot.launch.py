"""
The simulated glasshouse of a mission as a robot: controllers, joint states, tf, camera, trolley.

ros2 launch canopeer_ros2 simulated_robot.launch.py mission:=smoke
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
                launch_arguments={'command': 'ros2 robot'}.items(),
            )
        ]
    )
