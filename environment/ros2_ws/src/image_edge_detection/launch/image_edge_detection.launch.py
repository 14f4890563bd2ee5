"""ros2 launch image_edge_detection image_edge_detection.launch.py low:=40"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue

TOPIC = "/kachaka/front_camera/image_raw"


def generate_launch_description():
    return LaunchDescription(
        [
            DeclareLaunchArgument("topic", default_value=TOPIC, description="topic of the camera"),
            DeclareLaunchArgument("low", default_value="50", description="lower threshold of Canny"),
            DeclareLaunchArgument("high", default_value="150", description="upper threshold of Canny"),
            Node(
                package="image_edge_detection",
                executable="image_edge_detection",
                output="screen",
                remappings=[(TOPIC, LaunchConfiguration("topic"))],
                parameters=[
                    {
                        "low": ParameterValue(LaunchConfiguration("low"), value_type=int),
                        "high": ParameterValue(LaunchConfiguration("high"), value_type=int),
                    }
                ],
            ),
        ]
    )
