from setuptools import setup

setup(
    name="image_gray_processor",
    version="0.1.0",
    packages=["image_gray_processor"],  # the folder with the node's file
    data_files=[  # other files, and where they are installed
        # the marker, by which ROS finds the package
        ("share/ament_index/resource_index/packages", ["resource/image_gray_processor"]),
        ("share/image_gray_processor", ["package.xml"]),
        ("share/image_gray_processor/launch", ["launch/image_gray_processor.launch.py"]),
    ],
    entry_points={
        # what `ros2 run` starts: EXECUTABLE = PACKAGE.FILE:FUNCTION
        "console_scripts": [
            "image_gray_processor = image_gray_processor.image_gray_processor:main",
        ],
    },
)
