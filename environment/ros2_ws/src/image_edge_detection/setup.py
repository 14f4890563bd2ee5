from setuptools import setup

setup(
    name="image_edge_detection",
    version="0.1.0",
    packages=["image_edge_detection"],  # the folder with the node's file
    data_files=[  # other files, and where they are installed
        # the marker, by which ROS finds the package
        ("share/ament_index/resource_index/packages", ["resource/image_edge_detection"]),
        ("share/image_edge_detection", ["package.xml"]),
        ("share/image_edge_detection/launch", ["launch/image_edge_detection.launch.py"]),
    ],
    entry_points={
        # what `ros2 run` starts: EXECUTABLE = PACKAGE.FILE:FUNCTION
        "console_scripts": [
            "image_edge_detection = image_edge_detection.image_edge_detection:main",
        ],
    },
)
