from setuptools import setup

setup(
    name="image_edge_detection",
    version="0.1.0",
    packages=["image_edge_detection"],  # the folder with the node's file
    data_files=[  # other files, and where they are installed
        ("share/ament_index/resource_index/packages", ["resource/image_edge_detection"]),  # the marker
        ("share/image_edge_detection", ["package.xml"]),
        ("share/image_edge_detection/launch", ["launch/image_edge_detection.launch.py"]),
    ],
    entry_points={
        "console_scripts": [  # what `ros2 run` starts: EXECUTABLE = PACKAGE.FILE:FUNCTION
            "image_edge_detection = image_edge_detection.image_edge_detection:main",
        ],
    },
)
