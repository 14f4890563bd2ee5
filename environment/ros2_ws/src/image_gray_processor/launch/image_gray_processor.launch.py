"""ros2 launch image_gray_processor image_gray_processor.launch.py"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

TOPIC = "/kachaka/front_camera/image_raw"


def generate_launch_description():
    return LaunchDescription(
        [
            DeclareLaunchArgument("topic", default_value=TOPIC, description="topic of the camera"),
            Node(
                package="image_gray_processor",
                executable="image_gray_processor",
                output="screen",
                remappings=[(TOPIC, LaunchConfiguration("topic"))],
            ),
        ]
    )
