from setuptools import setup

setup(
    name="image_gray_processor",
    version="0.1.0",
    packages=["image_gray_processor"],  # the folder with the node's file
    data_files=[  # other files, and where they are installed
        ("share/ament_index/resource_index/packages", ["resource/image_gray_processor"]),  # the marker
        ("share/image_gray_processor", ["package.xml"]),
        ("share/image_gray_processor/launch", ["launch/image_gray_processor.launch.py"]),
    ],
    entry_points={
        "console_scripts": [  # what `ros2 run` starts: EXECUTABLE = PACKAGE.FILE:FUNCTION
            "image_gray_processor = image_gray_processor.image_gray_processor:main",
        ],
    },
)
